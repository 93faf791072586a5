/// Files of models are foreign bytes: whatever stands in them, they are read or refused in one line.
#include "shading/brdf_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/error.hpp"
#include "math/random.hpp"

namespace lobe {
namespace {

const std::string kModel =
    "/// grey.glsl - Grey.\n"
    "///\n"
    "/// value  f_r cos(theta_i) in 1/sr\n"
    "/// frame  Dirs d: local, z = shading normal, x = tangent\n"
    "/// params level    0..1     per channel, no unit, default 1 0.5 0, sRGB, takes base colour: level,\n"
    "///                          on two lines\n"
    "///        width    1e-5..2  rad, default 0.5, untextured, takes roughness: width\n"
    "///        form     0 first, 1 second, default second: form\n"
    "/// sharpness 12.5\n"
    "/// source A paper\n"
    "#include \"common/dirs.glsl\"\n"
    "struct GreyParams { vec3 level; /* comment */ float width; int form; };\n"
    "vec3 grey_f_cos(Dirs d, GreyParams p) { return p.level; } // end\n";

/// Bytes changed, cut out, repeated, or the rest cut off.
std::string mutated(std::string text, Pcg32& random) {
    const auto place = [&](size_t size) {
        return static_cast<size_t>(random.below(static_cast<uint32_t>(size)));
    };
    for (uint32_t changes = 1 + random.below(4); changes > 0 && !text.empty(); --changes) {
        const size_t at = place(text.size());
        const size_t length = std::min(1 + place(40), text.size() - at);
        switch (random.below(5)) {
            case 0:
                text[at] = static_cast<char>(random.below(256));
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(at, length));
                break;
            case 3:
                text.resize(at);
                break;
            default:
                text.insert(at, std::string(1, "/*{};,.:\n= -"[random.below(12)]));
        }
    }
    return text;
}

TEST(BrdfFile, IsReadOrRefusedWhateverStandsInIt) {
    Pcg32 random(11);
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::string text = mutated(kModel, random);
        try {
            const Brdf brdf = brdfFromSource({"grey.glsl", text});
            EXPECT_NO_THROW(validateParameters(brdf, brdf.defaults(), "defaults"));
            EXPECT_NO_THROW(validateParameters(brdf, brdf.fromMetallicRoughness({glm::dvec3(1.0), 1.0, 0.0}),
                                               "imitation"));
            ++read;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with("grey.glsl:")) << message;
            ++refused;
        }
    }
    EXPECT_GT(read, 500);
    EXPECT_GT(refused, 500);
}

TEST(BrdfFile, LongTextsAreNoTrouble) {
    const std::string spaces(500000, ' ');
    for (const std::string& text :
         {spaces, std::string(500000, '/'), "struct GreyParams {" + spaces + "float a; }",
          kModel + spaces + kModel,
          kModel + "struct" + std::string(500000, '\n') + "X {" + std::string(500000, ',')}) {
        try {
            brdfFromSource({"grey.glsl", text});
        } catch (const InputError&) {
        }
    }
}

}  // namespace
}  // namespace lobe
