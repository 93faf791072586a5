/// Which vertices are the same, bit for bit, in some of their attributes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace lobe {

/// For each vertex the lowest one with equal data: `words` has `width` 32-bit words a vertex. -0 equals 0
/// where the words were made by weldWord().
std::vector<uint32_t> weld(std::span<const uint32_t> words, size_t width);

uint32_t weldWord(float value);

/// weld() of positions alone.
std::vector<uint32_t> weldPositions(std::span<const glm::vec3> positions);

}  // namespace lobe
