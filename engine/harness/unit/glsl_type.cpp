#include "harness/unit/glsl_type.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>

#include "math/ulp.hpp"

namespace lobe::harness {
namespace {

struct Spelling {
    const char* scalar;
    const char* vector;
    const char* fromWord;  ///< of one uint
    const char* toWords;   ///< of a whole value
};

const Spelling& spellingOf(GlslType::Base base) {
    static const std::array<Spelling, 4> spellings{{{"float", "vec", "uintBitsToFloat", "floatBitsToUint"},
                                                    {"int", "ivec", "int", ""},
                                                    {"uint", "uvec", "", ""},
                                                    {"bool", "bvec", "bool", ""}}};
    return spellings.at(static_cast<size_t>(base));
}

std::string joined(std::span<const uint32_t> words, const std::function<std::string(uint32_t)>& text) {
    if (words.size() == 1) return text(words[0]);
    std::string all;
    for (const uint32_t word : words)
        all += (all.empty() ? "(" : ", ") + text(word);
    return all + ")";
}

std::string bitsText(uint32_t word) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "0x%08x", word);
    return text.data();
}

std::string specialText(float value) {
    const uint32_t bits = wordOf(value);
    if (isNanWord(bits)) return "nan";
    return (bits >> 31) != 0 ? "-inf" : "inf";
}

}  // namespace

std::string GlslType::name() const {
    const Spelling& spelling = spellingOf(base);
    return components == 1 ? spelling.scalar : spelling.vector + std::to_string(components);
}

std::optional<GlslType> parseGlslType(const std::string& name) {
    for (int base = 0; base < 4; ++base)
        for (int components = 1; components <= 4; ++components) {
            const GlslType type{static_cast<GlslType::Base>(base), components};
            if (type.name() == name) return type;
        }
    return std::nullopt;
}

std::string glslFromWords(GlslType type, std::span<const std::string> words) {
    const std::string convert = spellingOf(type.base).fromWord;
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + convert + "(" + word + ")";
    return type.components == 1 ? text : type.name() + "(" + text + ")";
}

std::string glslToWords(GlslType type, const std::string& value) {
    const GlslType words{GlslType::Base::natural, type.components};
    std::string text = type.isReal() ? std::string(spellingOf(type.base).toWords) + "(" + value + ")"
                                     : words.name() + "(" + value + ")";
    for (int c = type.components; c < 4; ++c)
        text += ", 0u";
    return "uvec4(" + text + ")";
}

double numberOf(GlslType::Base base, uint32_t word) {
    switch (base) {
        case GlslType::Base::real:
            return double(realOf(word));
        case GlslType::Base::integer:
            return double(static_cast<int32_t>(word));
        case GlslType::Base::natural:
            return double(word);
        default:
            return word != 0 ? 1.0 : 0.0;
    }
}

uint64_t wordDistance(GlslType::Base base, uint32_t a, uint32_t b) {
    if (base == GlslType::Base::real)
        return isNanWord(a) && isNanWord(b) ? 0 : ulpDistance(realOf(a), realOf(b));
    return static_cast<uint64_t>(std::abs(numberOf(base, a) - numberOf(base, b)));
}

std::string decimalText(float value) {
    if (!isFiniteWord(wordOf(value))) return specialText(value);
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string hexText(float value) {
    if (!isFiniteWord(wordOf(value))) return specialText(value);
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%a", double(value));
    return text.data();
}

std::string literalText(GlslType::Base base, uint32_t word) {
    switch (base) {
        case GlslType::Base::real:
            return isNanWord(word) ? "bits(" + bitsText(word) + ")" : hexText(realOf(word));
        case GlslType::Base::boolean:
            return word != 0 ? "true" : "false";
        default:
            return std::to_string(static_cast<int64_t>(numberOf(base, word)));
    }
}

std::string shownText(GlslType::Base base, uint32_t word) {
    if (base != GlslType::Base::real) return literalText(base, word);
    const std::string decimal = decimalText(realOf(word));
    if (isNanWord(word)) return decimal + " (" + literalText(base, word) + ")";
    return isFiniteWord(word) ? decimal + " (" + hexText(realOf(word)) + ")" : decimal;
}

std::string shownText(GlslType type, std::span<const uint32_t> words) {
    if (type.components == 1 || !type.isReal())
        return joined(words, [&](uint32_t word) { return shownText(type.base, word); });
    return joined(words, [](uint32_t word) { return decimalText(realOf(word)); }) + " = " +
           literalText(type, words);
}

std::string literalText(GlslType type, std::span<const uint32_t> words) {
    return joined(words, [&](uint32_t word) { return literalText(type.base, word); });
}

}  // namespace lobe::harness
