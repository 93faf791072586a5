/// The GLSL types that tests take and return, and their values as 32-bit words: bit patterns, so that NaN,
/// infinities, signed zeros and denormals stay what they are.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace lobe::harness {

/// float, int, uint, bool, or a vector of up to four of them.
struct GlslType {
    enum class Base : uint8_t { real, integer, natural, boolean };
    Base base = Base::real;
    int components = 1;

    bool isReal() const { return base == Base::real; }
    std::string name() const;  ///< "vec3"
    bool operator==(const GlslType&) const = default;
};

/// Nothing for types that tests can't use.
std::optional<GlslType> parseGlslType(const std::string& name);

/// GLSL that makes a value from uints: "vec2(uintBitsToFloat(a.x), uintBitsToFloat(a.y))", `words` its
/// components' expressions.
std::string glslFromWords(GlslType type, std::span<const std::string> words);
/// GLSL that makes a uvec4 from a value.
std::string glslToWords(GlslType type, const std::string& value);

inline float realOf(uint32_t word) {
    return std::bit_cast<float>(word);
}
inline uint32_t wordOf(float value) {
    return std::bit_cast<uint32_t>(value);
}

/// By exponent bits.
inline bool isFiniteWord(uint32_t word) {
    return (word & 0x7f800000U) != 0x7f800000U;
}
inline bool isNanWord(uint32_t word) {
    return (word & 0x7fffffffU) > 0x7f800000U;
}

/// A component's value in double; bools are 0 and 1.
double numberOf(GlslType::Base base, uint32_t word);

/// Distance of two floats in units of the last place, two NaNs counting as equal; of two integers, their
/// difference.
uint64_t wordDistance(GlslType::Base base, uint32_t a, uint32_t b);

/// The shortest decimal digits that give the same float: "0.1", "1e+30", "-inf", "nan".
std::string decimalText(float value);
/// As C's %a: "0x1.99999ap-4"; other than finite as decimalText.
std::string hexText(float value);
/// A component as tests write it: hexText for floats, digits for integers, true or false.
std::string literalText(GlslType::Base base, uint32_t word);
/// For people: "0.1 (0x1.99999ap-4)", "12", "true"; NaN with its bits.
std::string shownText(GlslType::Base base, uint32_t word);
/// Several components in brackets.
std::string shownText(GlslType type, std::span<const uint32_t> words);
/// literalText, several components in brackets.
std::string literalText(GlslType type, std::span<const uint32_t> words);

}  // namespace lobe::harness
