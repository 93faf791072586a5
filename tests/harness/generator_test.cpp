#include "harness/unit/generator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/error.hpp"

namespace lobe::harness {
namespace {

Generator read(const std::string& text, const std::string& type = "float") {
    DirectiveReader reader("in", text, {"t.glsl", 7});
    Generator generator = Generator::parse(reader, *parseGlslType(type), ".");
    reader.expectEnd();
    return generator;
}

std::vector<Words> listOf(const std::string& text, const std::string& type = "float") {
    return read(text, type).list();
}

/// Everything drawn is allowed, and the ends come up.
void expectRange(const std::string& text, double low, double high, const std::string& type = "float") {
    const Generator generator = read(text, type);
    const GlslType::Base base = parseGlslType(type)->base;
    Pcg32 random(1);
    double least = high;
    double most = low;
    for (int i = 0; i < 2000; ++i) {
        const Words words = generator.draw(random);
        EXPECT_TRUE(generator.allows(words)) << text;
        for (const uint32_t word : words) {
            least = std::min(least, numberOf(base, word));
            most = std::max(most, numberOf(base, word));
        }
    }
    EXPECT_EQ(least, low) << text;
    EXPECT_EQ(most, high) << text;
}

TEST(Generator, RangesHoldTheirEnds) {
    expectRange("uniform(-2, 3)", -2.0, 3.0);
    expectRange("uniform(-2, 3)", -2.0, 3.0, "vec4");
    expectRange("uniform(-2, 3)", -2.0, 3.0, "int");
    expectRange("uniform(0, 4294967295)", 0.0, 4294967295.0, "uint");
    expectRange("log_uniform(0.25, 1024)", 0.25, 1024.0);
    expectRange("log_uniform(-1024, -0.25)", -1024.0, -0.25);
}

/// Ends that are no floats are rounded to the nearest.
TEST(Generator, EndsThatAreNoFloats) {
    const Generator generator = read("uniform(0.1, 0.3)");
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Words words = generator.draw(random);
        EXPECT_TRUE(generator.allows(words)) << realOf(words[0]);
    }
}

TEST(Generator, DirectionsAreUnitAndWhereTheyShouldBe) {
    for (const auto& [text, low, high] :
         {std::tuple("unit_sphere", -1.0, 1.0), std::tuple("hemisphere", 0.0, 1.0),
          std::tuple("grazing_hemisphere(1e-7)", 0.99e-7, 0.1),
          std::tuple("grazing_hemisphere", 0.99e-7, 0.1)}) {
        const Generator generator = read(text, "vec3");
        Pcg32 random(2);
        for (int i = 0; i < 10'000; ++i) {
            const Words w = generator.draw(random);
            const double x = double(realOf(w[0]));
            const double y = double(realOf(w[1]));
            const double z = double(realOf(w[2]));
            EXPECT_NEAR(std::sqrt(x * x + y * y + z * z), 1.0, 2e-7);
            EXPECT_GE(z, low);
            EXPECT_LE(z, high);
            EXPECT_TRUE(generator.allows(w));
        }
    }
    EXPECT_FALSE(read("hemisphere", "vec3").allows(Words{0, 0, wordOf(-1.0f)}));
    EXPECT_FALSE(read("unit_sphere", "vec3").allows(Words{0, 0, wordOf(0.9f)}));
}

TEST(Generator, AnyGivesEverySignAndExponentAndIsFinite) {
    const Generator generator = read("any");
    Pcg32 random(4);
    std::set<uint32_t> exponents;
    for (int i = 0; i < 20'000; ++i) {
        const uint32_t word = generator.draw(random)[0];
        ASSERT_TRUE(isFiniteWord(word));
        exponents.insert(word >> 23);
    }
    EXPECT_EQ(exponents.size(), 2U * 255U);
}

TEST(Generator, Lists) {
    EXPECT_EQ(listOf("values(1, 0x1p-149, -inf, bits(0x7fc00001))"),
              (std::vector<Words>{{0x3f800000U}, {1U}, {0xff800000U}, {0x7fc00001U}}));
    EXPECT_EQ(listOf("values((1, -1), (0, 2))", "ivec2"), (std::vector<Words>{{1U, 0xffffffffU}, {0U, 2U}}));
    EXPECT_EQ(listOf("values(true, false)", "bool"), (std::vector<Words>{{1U}, {0U}}));
    EXPECT_EQ(listOf("grid(0, 1, 5)"),
              (std::vector<Words>{
                  {wordOf(0.0f)}, {wordOf(0.25f)}, {wordOf(0.5f)}, {wordOf(0.75f)}, {wordOf(1.0f)}}));
    const auto special = listOf("special(inf, nan)");
    for (const uint32_t word : {0U, 0x80000000U, 1U, 0x007fffffU, 0x00800000U, 0x7f7fffffU, 0x3f7fffffU,
                                0x3f800001U, 0x7f800000U, 0xff800000U, 0x7fc00000U})
        EXPECT_NE(std::find(special.begin(), special.end(), Words{word}), special.end()) << word;
    for (const Words& word : listOf("special(positive)"))
        EXPECT_EQ(word[0] >> 31, 0U);
    for (const Words& word : listOf("special"))
        EXPECT_TRUE(isFiniteWord(word[0]));
}

TEST(Generator, RefusesWhatMakesNoSense) {
    for (const auto& [text, type, message] : std::vector<std::tuple<std::string, std::string, std::string>>{
             {"unifrom(0, 1)", "float", "did you mean 'uniform'"},
             {"uniform(1, 0)", "float", "the smaller first"},
             {"uniform(0, inf)", "float", "finite"},
             {"uniform(nan, 1)", "float", "finite"},
             {"uniform(0, 1e39)", "float", "range"},
             {"uniform(-1, 1)", "uint", "range"},
             {"uniform(0 1)", "float", "expected ','"},
             {"uniform(0, 1", "float", "expected ')'"},
             {"uniform(0, 1) more", "float", "'more' was not expected"},
             {"log_uniform(0, 1)", "float", "without 0"},
             {"values()", "float", "expected a number"},
             {"values(1)", "vec2", "expected '('"},
             {"values(1.5)", "int", "whole number"},
             {"values(-1)", "uint", "whole number"},
             {"values(0x)", "float", "not a number"},
             {"values(bits(0x1ffffffff))", "float", "not the bits"},
             {"grid(0, 1, 1)", "float", "from 2"},
             {"grid(0, 1, 1e99)", "float", "from 2"},
             {"special(negative)", "float", "expected positive"},
             {"special", "vec2", "single numbers"},
             {"unit_sphere", "vec2", "gives vec3"},
             {"grazing_hemisphere(1)", "vec3", "0..0.1"},
             {"csv(\"a.csv\")", "float", "column"},
             {"csv(a.csv, x)", "float", "double quotes"},
             {"", "float", "expected a generator"}}) {
        try {
            read(text, type);
            ADD_FAILURE() << text << " was taken";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos)
                << text << ": " << error.what();
            EXPECT_EQ(std::string(error.what()).find("t.glsl:7: @in"), 0U) << error.what();
        }
    }
}

}  // namespace
}  // namespace lobe::harness
