/// What the registry promises: names, ranges, messages, and GLSL files that say the same as the C++ entries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>

#include "albedo.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"
#include "gl/context.hpp"
#include "harness/comparison.hpp"
#include "shading/brdf.hpp"
#include "shading/brdf_file.hpp"
#include "shading/brdf_header.hpp"

namespace lobe {
namespace {

std::string readText(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string glslText(const Brdf& brdf) {
    return readText(shaderDirectory() / "brdf" / (brdf.name + ".glsl"));
}

std::string oneSpaced(const std::string& text) {
    return std::regex_replace(text, std::regex("\\s+"), " ");
}

/// The numbers as the headers write them: 0..1, 0..1e6.
std::string rangeText(const Parameter& parameter) {
    const auto number = [](double value) {
        char text[32];
        std::snprintf(text, sizeof text, value >= 1e5 ? "%.0e" : "%g", value);
        return std::regex_replace(std::string(text), std::regex("e\\+0*"), "e");
    };
    return number(parameter.minimum) + ".." + number(parameter.maximum);
}

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(Registry, HoldsTheModelsSortedByName) {
    const std::vector<std::string> names = brdfNames();
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    EXPECT_THAT(names, testing::IsSupersetOf({"lambert", "phong", "blinn_phong", "metallic_roughness"}));
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const std::string& name : names)
        EXPECT_EQ(requireBrdf(name).name, name);
}

TEST(Registry, NamesTheNearestModel) {
    EXPECT_EQ(findBrdf("lamberd"), nullptr);
    EXPECT_THAT(messageOf([] { requireBrdf("lamberd"); }),
                testing::AllOf(testing::HasSubstr("'lamberd'"), testing::HasSubstr("did you mean 'lambert'?"),
                               testing::HasSubstr("blinn_phong")));
    EXPECT_THROW(requireBrdf(""), UsageError);
}

TEST(Registry, EveryEntryIsComplete) {
    for (const Brdf& brdf : allBrdfs()) {
        SCOPED_TRACE(brdf.name);
        EXPECT_FALSE(brdf.title.empty());
        EXPECT_FALSE(brdf.source.empty());
        EXPECT_TRUE(brdf.fCos && brdf.ambient && brdf.lobeSharpness && brdf.fromMetallicRoughness);
        const int base = brdf.parameterIndex(brdf.baseColorParameter);
        ASSERT_GE(base, 0);
        EXPECT_EQ(brdf.parameters[static_cast<size_t>(base)].kind, ParameterKind::rgb);
        std::set<std::string> names;
        for (const Parameter& parameter : brdf.parameters) {
            EXPECT_TRUE(names.insert(parameter.glslName).second) << parameter.glslName;
            EXPECT_TRUE(std::regex_match(parameter.name, std::regex("[a-z][a-zA-Z0-9]*"))) << parameter.name;
            EXPECT_TRUE(std::regex_match(parameter.glslName, std::regex("[a-z][a-z0-9_]*")))
                << parameter.glslName;
            EXPECT_LT(parameter.minimum, parameter.maximum);
            EXPECT_FALSE(parameter.description.empty());
            EXPECT_EQ(parameter.kind == ParameterKind::choice, !parameter.choices.empty());
            EXPECT_FALSE(parameter.kind == ParameterKind::choice && parameter.mayBeTextured);
        }
        EXPECT_EQ(layoutError(brdf, brdf.defaults()), "");
        EXPECT_EQ(brdf.table.has_value(), brdf.tableParameter() >= 0);
        EXPECT_NO_THROW(validateParameters(brdf, brdf.defaults(), "defaults"));
    }
}

TEST(Registry, PresetsAreValidAndNameTheirSource) {
    size_t count = 0;
    for (const Brdf& brdf : allBrdfs()) {
        std::set<std::string> names;
        for (const BrdfPreset& preset : brdf.presets) {
            SCOPED_TRACE(brdf.name + ": " + preset.name);
            EXPECT_TRUE(names.insert(preset.name).second);
            EXPECT_FALSE(preset.source.empty());
            EXPECT_EQ(layoutError(brdf, preset.values), "");
            EXPECT_NO_THROW(validateParameters(brdf, preset.values, preset.name));
            EXPECT_EQ(brdf.findPreset(preset.name), &preset);
            ++count;
        }
        EXPECT_EQ(brdf.findPreset("no such surface"), nullptr);
    }
    EXPECT_GE(count, 28U);
    EXPECT_EQ(requireBrdf("ward_anisotropic").presets.size(), 10U);
}

TEST(Registry, PresetsOfLafortuneKeepThePublishedAlbedo) {
    // Ngan et al.: k_d and k_s of a lobe that is normalised at normal incidence.
    const Brdf& brdf = requireBrdf("lafortune");
    const ParameterValues& steel = brdf.findPreset("steel")->values;
    EXPECT_NEAR(test::albedo(brdf, steel, 1.0).value, 0.0157 + 0.0644, 1e-5);
}

TEST(Registry, ParametersOfTheSceneFormat) {
    const Brdf& phong = requireBrdf("phong");
    EXPECT_EQ(phong.defaults(), (ParameterValues{0, 0, 0, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 32, 0}));
    EXPECT_EQ(requireBrdf("blinn_phong").defaults(), phong.defaults());
    EXPECT_EQ(phong.parameters[4].choices, (std::vector<std::string>{"classic", "energy"}));
    EXPECT_EQ(phong.valueOffset(phong.parameterIndex("shininess")), 9);
    EXPECT_EQ(phong.parameterIndex("shinyness"), -1);
    for (const char* color : {"diffuse", "specular"})
        EXPECT_TRUE(phong.parameters[static_cast<size_t>(phong.parameterIndex(color))].textureIsSrgb);
    EXPECT_FALSE(phong.parameters[static_cast<size_t>(phong.parameterIndex("ambient"))].textureIsSrgb);
    EXPECT_EQ(requireBrdf("lambert").defaults(), (ParameterValues{1, 1, 1}));
}

TEST(ValidateParameters, SaysWhatIsWrongInOneLine) {
    const Brdf& phong = requireBrdf("phong");
    const auto message = [&](size_t offset, double value) {
        ParameterValues values = phong.defaults();
        values[offset] = value;
        return messageOf([&] { validateParameters(phong, values, "room.gltf: material 'wall'"); });
    };
    EXPECT_EQ(message(9, -1.0), "room.gltf: material 'wall': shininess: -1; expected 0..1000000");
    EXPECT_EQ(message(4, 1.5), "room.gltf: material 'wall': diffuse[1]: 1.5; expected 0..1");
    EXPECT_EQ(message(10, 0.5),
              "room.gltf: material 'wall': normalization: 0.5; expected \"classic\" or \"energy\"");
    EXPECT_EQ(message(10, 2.0),
              "room.gltf: material 'wall': normalization: 2; expected \"classic\" or \"energy\"");
    EXPECT_EQ(message(0, std::nan("")), "room.gltf: material 'wall': ambient[0]: NaN; expected 0..1");
    EXPECT_EQ(message(9, std::numeric_limits<double>::infinity()),
              "room.gltf: material 'wall': shininess: infinity; expected 0..1000000");
    EXPECT_EQ(message(9, 1e6), "no error");
    EXPECT_EQ(message(9, 0.0), "no error");
    EXPECT_THROW(validateParameters(phong, ParameterValues{1.0}, "x"), InputError);
}

TEST(GlslFiles, DeclareTheStructOfTheRegistry) {
    EXPECT_EQ(glslParameterStruct(requireBrdf("lambert")), "struct LambertParams { vec3 diffuse; };");
    for (const Brdf& brdf : allBrdfs())
        EXPECT_THAT(oneSpaced(glslText(brdf)), testing::HasSubstr(glslParameterStruct(brdf))) << brdf.name;
}

TEST(GlslFiles, OneForEachEntryAndNoOther) {
    std::vector<std::string> stems;
    for (const auto& file : std::filesystem::directory_iterator(shaderDirectory() / "brdf"))
        stems.push_back(file.path().stem());
    EXPECT_THAT(stems, testing::UnorderedElementsAreArray(brdfNames()));
}

TEST(GlslFiles, HeadersHaveEveryKeyAndTheRegistrysRanges) {
    for (const Brdf& brdf : allBrdfs()) {
        SCOPED_TRACE(brdf.name);
        const std::string text = glslText(brdf);
        EXPECT_TRUE(text.starts_with("/// " + brdf.name + ".glsl - "));
        EXPECT_THAT(text, testing::HasSubstr("Registry name: " + brdf.name + "."));
        for (const char* key : {"value", "frame", "params", "domain", "source", "stable", "error", "twin"})
            EXPECT_TRUE(std::regex_search(text, std::regex("\n/// " + std::string(key) + " +\\S"))) << key;
        for (const Parameter& parameter : brdf.parameters) {
            std::string line = "\n/// (params)? +" + parameter.glslName + " +";
            if (parameter.kind == ParameterKind::choice)
                for (size_t i = 0; i < parameter.choices.size(); ++i)
                    line += (i > 0 ? ", " : "") + std::to_string(i) + " " + parameter.choices[i];
            else
                line += std::regex_replace(rangeText(parameter), std::regex("\\."), "\\.") + " ";
            EXPECT_TRUE(std::regex_search(text, std::regex(line))) << line;
        }
        const std::string twin = "engine/shading/brdf/" + brdf.name + ".cpp";
        EXPECT_THAT(text, testing::HasSubstr("/// twin   " + twin));
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(LOBE_SOURCE_DIR) / twin));
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(LOBE_SOURCE_DIR) / "docs/models" /
                                            (brdf.name + ".md")));
    }
}

/// One syntax for files that come with Lobe and for those that people load.
TEST(GlslFiles, HeadersReadAsTheRegistrysParameters) {
    for (const Brdf& brdf : allBrdfs()) {
        SCOPED_TRACE(brdf.name);
        const BrdfHeader header = parseBrdfHeader(glslText(brdf), brdf.name + ".glsl");
        EXPECT_FALSE(header.title.empty());
        EXPECT_EQ(header.keys.at("frame").find("x = tangent") != std::string::npos, brdf.traits.usesTangent);
        ASSERT_EQ(header.parameters.size(), brdf.parameters.size());
        for (size_t i = 0; i < brdf.parameters.size(); ++i) {
            const Parameter& declared = header.parameters[i].parameter;
            const Parameter& registered = brdf.parameters[i];
            SCOPED_TRACE(registered.glslName);
            EXPECT_EQ(declared.glslName, registered.glslName);
            EXPECT_EQ(declared.name, registered.name);
            EXPECT_EQ(declared.kind, registered.kind);
            EXPECT_EQ(declared.choices, registered.choices);
            EXPECT_EQ(declared.unit, registered.unit);
            EXPECT_EQ(rangeText(declared), rangeText(registered));
            if (header.parameters[i].hasDefault) {
                EXPECT_EQ(declared.defaultValue, registered.defaultValue);
            }
        }
    }
}

TEST(BrdfHeader, ReadsEveryAttribute) {
    const BrdfHeader header = parseBrdfHeader(
        "// licence\n"
        "/// my.glsl - A title. More.\n"
        "///\n"
        "/// params base_color  0..1  per channel, no unit, default 1 0.5 0, sRGB, takes base colour: "
        "colour\n"
        "///        depth       1e-9..2  m, untextured: depth,\n"
        "///                             on two lines\n"
        "///        form  0 first, 1 second_one, default second_one: form\n"
        "/// sharpness 12.5\n"
        "/// source A paper,\n"
        "///        1999\n"
        "code\n"
        "/// params no more\n",
        "my.glsl");
    EXPECT_EQ(header.title, "A title");
    EXPECT_EQ(header.keys.at("source"), "A paper, 1999");
    EXPECT_EQ(header.sharpness, 12.5);
    ASSERT_EQ(header.parameters.size(), 3u);
    const Parameter& color = header.parameters[0].parameter;
    EXPECT_EQ(color.name, "baseColor");
    EXPECT_EQ(color.kind, ParameterKind::rgb);
    EXPECT_EQ(color.defaultValue, glm::dvec3(1.0, 0.5, 0.0));
    EXPECT_TRUE(color.textureIsSrgb && color.mayBeTextured);
    EXPECT_EQ(header.parameters[0].takes, "base colour");
    EXPECT_EQ(header.parameters[0].line, 4);
    const Parameter& depth = header.parameters[1].parameter;
    EXPECT_EQ(depth.minimum, 1e-9);
    EXPECT_EQ(depth.defaultValue.x, 0.5);
    EXPECT_EQ(depth.unit, "m");
    EXPECT_FALSE(depth.mayBeTextured);
    EXPECT_EQ(depth.description, "depth, on two lines");
    const Parameter& form = header.parameters[2].parameter;
    EXPECT_EQ(form.choices, (std::vector<std::string>{"first", "second_one"}));
    EXPECT_EQ(form.defaultValue.x, 1.0);
}

TEST(BrdfFile, HasNoTwinAndSaysSo) {
    const BrdfSource source{
        "some/grey.glsl",
        "/// grey.glsl - Grey.\n/// params level  0..1  no unit: level\n"
        "struct GreyParams { float level; };\nvec3 grey_f_cos(Dirs d, GreyParams p) { return "
        "vec3(p.level); }\n"};
    setLoadedBrdfs({brdfFromSource(source)});
    const Brdf& grey = requireBrdf("grey");
    EXPECT_THAT(brdfNames(), testing::Contains("grey"));
    EXPECT_EQ(allBrdfs().size() + 1, brdfNames().size());
    EXPECT_THAT(
        messageOf([&] { requireTwin(grey); }),
        testing::AllOf(testing::HasSubstr("some/grey.glsl"), testing::HasSubstr("no double-precision twin")));
    EXPECT_THAT(messageOf([&] { harness::Comparison(grey, harness::Axes::local); }),
                testing::HasSubstr("no double"));
    setLoadedBrdfs({});
    EXPECT_EQ(findBrdf("grey"), nullptr);
}

TEST(Imitation, GivesValidValuesForEveryGltfSurface) {
    for (const Brdf& brdf : allBrdfs())
        for (double base : {0.0, 0.5, 1.0})
            for (double metallic : {0.0, 0.3, 1.0})
                for (double roughness : {0.0, 1e-3, 0.5, 0.97, 1.0}) {
                    const ParameterValues values =
                        brdf.fromMetallicRoughness({glm::dvec3(base), metallic, roughness});
                    EXPECT_NO_THROW(validateParameters(brdf, values, brdf.name));
                }
}

TEST(Imitation, PhongKeepsDiffuseAndSpecularWithinOne) {
    for (const char* name : {"phong", "blinn_phong"})
        for (double base : {0.0, 0.5, 1.0})
            for (double metallic : {0.0, 0.3, 1.0}) {
                const ParameterValues v =
                    requireBrdf(name).fromMetallicRoughness({glm::dvec3(base), metallic, 0.5});
                EXPECT_LE(v[3] + v[6], 1.0 + 1e-15);
                EXPECT_EQ(v[0], base);
                EXPECT_EQ(v[10], 1.0);
            }
    // Blinn's n = 2 / alpha^2 - 2 with alpha = 0.25; Phong's is a quarter.
    EXPECT_DOUBLE_EQ(requireBrdf("blinn_phong").fromMetallicRoughness({glm::dvec3(1.0), 0.0, 0.5})[9], 30.0);
    EXPECT_DOUBLE_EQ(requireBrdf("phong").fromMetallicRoughness({glm::dvec3(1.0), 0.0, 0.5})[9], 7.5);
    EXPECT_DOUBLE_EQ(requireBrdf("phong").fromMetallicRoughness({glm::dvec3(1.0), 0.0, 0.0})[9], 1e6);
}

TEST(Backends, AtLeastOneMakesAContext) {
    EXPECT_NO_THROW(gl::Context::create());
}

}  // namespace
}  // namespace lobe
