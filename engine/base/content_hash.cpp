#include "base/content_hash.hpp"

#include <bit>
#include <cstdio>
#include <cstring>

namespace lobe {

static_assert(std::endian::native == std::endian::little, "words are read as they lie in memory");

void ContentHash::step(uint64_t word) {
    state_ = (state_ ^ word) * 1099511628211ULL;  // the 64-bit FNV prime
    state_ ^= state_ >> 32;
}

void ContentHash::add(std::span<const std::byte> block) {
    size_t offset = 0;
    for (; offset + sizeof(uint64_t) <= block.size(); offset += sizeof(uint64_t)) {
        uint64_t word;
        std::memcpy(&word, block.data() + offset, sizeof word);
        step(word);
    }
    uint64_t last = 0;
    if (offset < block.size()) {
        std::memcpy(&last, block.data() + offset, block.size() - offset);
    }
    step(last);
    step(block.size());
}

std::string ContentHash::hex() const {
    char text[17];
    (void)std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
    return text;
}

}  // namespace lobe
