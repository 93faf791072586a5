/// "generated/material.glsl": the part of a program that depends on which model and which textures a material
/// has. Written from the registry and the plan, so a parameter is declared in one place only.
#pragma once

#include <string>

#include "plan/plan.hpp"

namespace lobe {

/// For surface programs (G-buffer, forward): uniforms, texture fetches, surface_*() functions, G-buffer
/// outputs.
std::string surfaceMaterialGlsl(const FramePlan& plan, const SurfaceFeatures& features);

/// For programs that need no more of a masked surface than where it has holes: surface_alpha().
std::string coverageGlsl(const SurfaceFeatures& features);

/// For screen programs (lights, AOVs): gbuffer_read_params(), from the G-buffer, the material table and
/// uniforms.
std::string screenMaterialGlsl(const FramePlan& plan, const PlannedBrdf& brdf);

/// Texels a row of the material table (RGBA32F): the widest model's perMaterial parameters.
int materialTableStride(const FramePlan& plan);

/// One material's row: its perMaterial values in order, padded to the stride with zeros.
std::vector<float> materialTableRow(const FramePlan& plan, const Material& material);

}  // namespace lobe
