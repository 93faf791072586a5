/// Linear floats to 8-bit sRGB codes without pow, exactly.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace lobe {

/// The 254 boundaries between codes are irregular in x but sparse in the bits of x: from 2^-13 (the first
/// boundary is above it) to 1 in steps of 2^-7 of an octave no step holds more than one. An entry holds a
/// step's first code and where in the step the next code begins, such that adding the low bits of x carries
/// into the code there.
class SrgbTable {
public:
    static const SrgbTable& get();

    /// The nearest code to the encoded value of x, for x in 0..1 and nothing else.
    uint8_t encode(float x) const {
        const uint32_t bits = std::bit_cast<uint32_t>(x > kFirst ? x : kFirst);
        const uint32_t low = bits & ((1U << kShift) - 1);
        return static_cast<uint8_t>((steps_[(bits - kFirstBits) >> kShift] + low) >> kShift);
    }

private:
    SrgbTable();
    static constexpr float kFirst = 0x1p-13F;
    static constexpr uint32_t kFirstBits = 0x39000000;  // of kFirst
    static constexpr int kShift = 23 - 7;
    static_assert(std::bit_cast<uint32_t>(kFirst) == kFirstBits);
    std::array<uint32_t, 13 * 128 + 1> steps_{};  // 13 octaves, and x = 1
};

}  // namespace lobe
