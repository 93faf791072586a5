/// A material's parameters as uniforms, by the names that generated GLSL gives them.
#pragma once

#include <span>

#include "gl/program.hpp"
#include "shading/brdf.hpp"

namespace lobe {

/// Sets uParam_NAME for every parameter that the program uses; the program must be in use.
void setParameters(const gl::Program& program, const Brdf& brdf, std::span<const double> values);

}  // namespace lobe
