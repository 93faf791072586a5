#include "import/welding.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace lobe {

uint32_t weldWord(float value) {
    return std::bit_cast<uint32_t>(value == 0.0f ? 0.0f : value);
}

std::vector<uint32_t> weld(std::span<const uint32_t> words, size_t width) {
    const size_t count = words.size() / width;
    // Open addressing in a table at most half full.
    const size_t capacity = std::bit_ceil(std::max<size_t>(2 * count, 2));
    constexpr uint32_t kFree = UINT32_MAX;
    std::vector<uint32_t> table(capacity, kFree);
    std::vector<uint32_t> first(count);
    for (size_t v = 0; v < count; ++v) {
        const uint32_t* own = words.data() + v * width;
        uint64_t hash = 0;
        for (size_t w = 0; w < width; ++w) {
            hash = (hash ^ own[w]) * 0x9E3779B97F4A7C15ULL;
            hash ^= hash >> 29;
        }
        size_t slot = (hash * 0x9E3779B97F4A7C15ULL >> 20) & (capacity - 1);
        while (table[slot] != kFree &&
               std::memcmp(words.data() + size_t{table[slot]} * width, own, width * sizeof(uint32_t)) != 0) {
            slot = (slot + 1) & (capacity - 1);
        }
        if (table[slot] == kFree) {
            table[slot] = static_cast<uint32_t>(v);
        }
        first[v] = table[slot];
    }
    return first;
}

std::vector<uint32_t> weldPositions(std::span<const glm::vec3> positions) {
    std::vector<uint32_t> words;
    words.reserve(positions.size() * 3);
    for (const glm::vec3& p : positions) {
        words.insert(words.end(), {weldWord(p.x), weldWord(p.y), weldWord(p.z)});
    }
    return weld(words, 3);
}

}  // namespace lobe
