#include "harness/unit/glsl_type.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "harness/unit/directive_reader.hpp"
#include "math/random.hpp"

namespace lobe::harness {
namespace {

using Base = GlslType::Base;

float readBack(const std::string& text) {
    DirectiveReader reader("in", text, {"t.glsl", 1});
    const float value = reader.real();
    EXPECT_TRUE(reader.atEnd()) << text;
    return value;
}

TEST(GlslType, NamesAreReadBack) {
    for (const char* name : {"float", "vec2", "vec4", "int", "ivec3", "uint", "uvec2", "bool", "bvec4"})
        EXPECT_EQ(parseGlslType(name)->name(), name);
    for (const char* name : {"mat3", "double", "vec5", "vec1", "void", ""})
        EXPECT_FALSE(parseGlslType(name)) << name;
}

TEST(GlslType, LiteralsGiveTheSameBits) {
    Pcg32 random(5);
    for (int i = 0; i < 200'000; ++i) {
        uint32_t word = random.next();
        if (i < 64) word = i < 32 ? uint32_t{1} << i : 0x7f800000U + static_cast<uint32_t>(i) - 40U;
        EXPECT_EQ(wordOf(readBack(literalText(Base::real, word))), word) << literalText(Base::real, word);
        // Decimal digits are the shortest that do.
        if (isFiniteWord(word)) {
            EXPECT_EQ(wordOf(readBack(decimalText(realOf(word)))), word);
        }
    }
}

TEST(GlslType, WordsAsNumbersAndText) {
    EXPECT_EQ(numberOf(Base::integer, 0xffffffffU), -1.0);
    EXPECT_EQ(numberOf(Base::natural, 0xffffffffU), 4294967295.0);
    EXPECT_EQ(literalText(Base::integer, 0x80000000U), "-2147483648");
    EXPECT_EQ(literalText(Base::natural, 0xffffffffU), "4294967295");
    EXPECT_EQ(literalText(Base::boolean, 1U), "true");
    EXPECT_EQ(shownText(Base::real, wordOf(0.1f)), "0.1 (0x1.99999ap-4)");
    EXPECT_EQ(shownText(Base::real, 0x7fc00001U), "nan (bits(0x7fc00001))");
    EXPECT_EQ(decimalText(-std::numeric_limits<float>::infinity()), "-inf");
}

TEST(GlslType, Distances) {
    EXPECT_EQ(wordDistance(Base::real, wordOf(0.0f), wordOf(-0.0f)), 0U);
    EXPECT_EQ(wordDistance(Base::real, wordOf(1.0f), wordOf(1.0f) + 3), 3U);
    EXPECT_EQ(wordDistance(Base::real, 0x7fc00000U, 0x7fc00001U), 0U);
    EXPECT_EQ(wordDistance(Base::real, 0x7fc00000U, wordOf(1.0f)), std::numeric_limits<uint64_t>::max());
    EXPECT_EQ(wordDistance(Base::integer, static_cast<uint32_t>(-3), 4U), 7U);
}

}  // namespace
}  // namespace lobe::harness
