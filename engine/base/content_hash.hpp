/// A stable 64-bit fingerprint of bytes, to tell scenes apart; no protection against forgery.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace lobe {

/// FNV-1a's step (xor, then multiply by the 64-bit FNV prime) over little-endian 64-bit words instead of
/// bytes, with the upper half folded down after each step and each block's length mixed in, so that moving a
/// boundary between blocks changes the result.
class ContentHash {
public:
    void add(std::span<const std::byte> block);
    std::string hex() const;  ///< 16 digits

private:
    void step(uint64_t word);
    uint64_t state_ = 14695981039346656037ULL;  // FNV's offset basis
};

}  // namespace lobe
