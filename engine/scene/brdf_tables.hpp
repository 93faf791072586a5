/// The tables of all materials as one buffer, as shaders read them (shaders/glsl/common/table.glsl).
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace lobe {

/// Gives each material that has a table the place of its first row; equal tables share one.
void placeTables(std::vector<Material>& materials);

/// Rows of all tables together, of four numbers.
size_t tableRows(const std::vector<Material>& materials);

/// All tables one after the other, each at its place.
std::vector<float> gatherTables(const std::vector<Material>& materials);

}  // namespace lobe
