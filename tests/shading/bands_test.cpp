/// Fresnel's equations in bands of wavelength: their weights, what they give for metals, and GLSL against
/// twin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <iterator>

#include "harness/brdf_table.hpp"
#include "harness/comparison.hpp"
#include "harness/evaluator.hpp"
#include "shading/bands.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"
#include "shading/on_contexts.hpp"

namespace lobe {
namespace {

using shading::Band;
using shading::MetalSpectrum;

const shading::Metal& metalNamed(const std::string& name) {
    for (const shading::Metal& metal : shading::metals())
        if (metal.name == name) return metal;
    throw std::logic_error("no metal " + name);
}

double cosOf(double degrees) {
    return std::cos(degrees * glm::pi<double>() / 180.0);
}

TEST(Bands, WeightsOfEachChannelAddUpToOneAndFillTheSpectrum) {
    for (int count : {4, 5, 16, 64}) {
        const std::vector<Band>& bands = shading::bandsOf(shading::metalSpectra()[0], count);
        ASSERT_EQ(bands.size(), static_cast<size_t>(count));
        glm::dvec3 sum(0.0);
        for (size_t i = 0; i < bands.size(); ++i) {
            sum += bands[i].weight;
            EXPECT_NEAR(bands[i].from, i == 0 ? 380.0 : bands[i - 1].to, 1e-9);
        }
        EXPECT_NEAR(bands.back().to, 780.0, 1e-9);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c], 1.0, 1e-14);
    }
    // Red is seen at long wavelengths, blue at short ones.
    const std::vector<Band>& bands = shading::bandsOf(shading::metalSpectra()[0], 8);
    const auto strongest = [&](int c) {
        return std::max_element(bands.begin(), bands.end(),
                                [c](const Band& a, const Band& b) { return a.weight[c] < b.weight[c]; })
            ->from;
    };
    EXPECT_EQ(strongest(0), 580.0);
    EXPECT_EQ(strongest(1), 530.0);
    EXPECT_EQ(strongest(2), 430.0);
}

TEST(Bands, WhatReflectsAllWavelengthsAlikeIsGrey) {
    for (int count : {4, 16, 64}) {
        std::vector<Band> bands = shading::bandsOf(shading::metalSpectra()[0], count);
        for (Band& band : bands)
            band.index = {1.0, 1e12};
        const glm::dvec3 white = shading::bandReflectance(bands, 1.0);
        for (Band& band : bands)
            band.index = {1.5, 0.0};
        const glm::dvec3 grey = shading::bandReflectance(bands, 1.0);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(white[c], 1.0, 1e-11);
            EXPECT_NEAR(grey[c], 0.04, 1e-14);
        }
    }
}

/// Linear sRGB of the normal reflectance under D65 from the same spectra, integrated with the CIE's own
/// tables of colour matching functions. The fit of these departs from them by about 1 % of their peaks.
TEST(Bands, NormalReflectanceIsThatOfTheWholeSpectrum) {
    const std::vector<std::pair<std::string, glm::dvec3>> published{
        {"silver", {.9715, .9599, .9153}},   {"aluminium", {.9132, .9215, .9245}},
        {"gold", {1.0219, .7823, .3435}},    {"copper", {.9551, .6377, .5382}},
        {"chromium", {.6347, .6622, .7046}}, {"nickel", {.6593, .6086, .5258}},
        {"tungsten", {.5153, .4959, .4676}}, {"titanium nitride", {.6137, .4614, .2328}}};
    ASSERT_EQ(published.size(), shading::metalSpectra().size());
    for (const auto& [name, f0] : published)
        for (int count : {16, 64}) {
            const glm::dvec3 got =
                shading::bandReflectance(shading::bandsOf(*shading::metalSpectrum(name), count), 1.0);
            for (int c = 0; c < 3; ++c)
                // Those were made with tabulated matching functions, ours with a fit of them: chosen, not
                // derived.
                EXPECT_NEAR(got[c], f0[c], count == 64 ? 0.006 : 0.01) << name << " " << count << " " << c;
        }
}

TEST(Bands, IndicesAreThoseOfTheTableOfMetals) {
    for (const MetalSpectrum& spectrum : shading::metalSpectra()) {
        const shading::Metal& metal = metalNamed(spectrum.name);
        EXPECT_TRUE(std::is_sorted(spectrum.samples.begin(), spectrum.samples.end(),
                                   [](const auto& a, const auto& b) { return a.wavelength < b.wavelength; }));
        EXPECT_LE(spectrum.samples.front().wavelength, 380.0);
        EXPECT_GE(spectrum.samples.back().wavelength, 780.0);
        for (int c = 0; c < 3; ++c) {
            const std::complex<double> index =
                spectrum.index(std::array{630.0, 532.0, 465.0}[static_cast<size_t>(c)]);
            EXPECT_NEAR(index.real(), metal.eta[c], 2e-3) << spectrum.name << c;
            EXPECT_NEAR(index.imag(), metal.k[c], 2e-3) << spectrum.name << c;
        }
    }
    EXPECT_EQ(shading::metalSpectrum("platinum"), nullptr);
}

/// The clamp at 0 is for spectra that nobody has measured yet.
TEST(Bands, NoMetalIsBeyondTheGamutOnTheDarkSide) {
    for (const MetalSpectrum& metal : shading::metalSpectra())
        for (int count = 4; count <= 64; ++count)
            for (double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 90.0}) {
                glm::dvec3 sum(0.0);
                for (const Band& band : shading::bandsOf(metal, count))
                    sum += band.weight * shading::exactReflectance(band.index, cosOf(degrees));
                for (int c = 0; c < 3; ++c) {
                    EXPECT_GT(sum[c], 0.1) << metal.name;
                    EXPECT_LT(sum[c], 1.05) << metal.name;
                }
            }
}

TEST(Bands, ChannelsThatWouldBeNegativeAreZero) {
    std::vector<Band> bands = shading::bandsOf(shading::metalSpectra()[0], 64);
    for (Band& band : bands)  // a mirror for blue-green light alone, for which red is negative
        band.index = band.from > 480.0 && band.to < 520.0 ? std::complex(1.0, 1e6) : std::complex(1.0, 0.0);
    const glm::dvec3 got = shading::bandReflectance(bands, 1.0);
    EXPECT_EQ(got.r, 0.0);
    EXPECT_GT(got.g, 0.1);
}

/// The table of docs/bands.md: how far from 64 bands the other ways are.
std::vector<std::string> tableOfErrors() {
    std::vector<std::string> rows;
    for (const MetalSpectrum& spectrum : shading::metalSpectra()) {
        const shading::Metal& metal = metalNamed(spectrum.name);
        const std::vector<Band>& fine = shading::bandsOf(spectrum, 64);
        std::array<std::complex<double>, 3> averaged{};
        for (const Band& band : fine)
            for (size_t c = 0; c < 3; ++c)
                averaged[c] += band.weight[static_cast<int>(c)] * band.index;
        for (double degrees : {0.0, 60.0, 80.0}) {
            const glm::dvec3 exact = shading::bandReflectance(fine, cosOf(degrees));
            std::vector<glm::dvec3> ways(4);
            for (int c = 0; c < 3; ++c) {
                ways[0][c] = shading::exactReflectance(averaged[static_cast<size_t>(c)], cosOf(degrees));
                ways[1][c] = shading::exactReflectance({metal.eta[c], metal.k[c]}, cosOf(degrees));
            }
            ways[2] = shading::bandReflectance(shading::bandsOf(spectrum, 8), cosOf(degrees));
            ways[3] = shading::bandReflectance(shading::bandsOf(spectrum, 16), cosOf(degrees));
            char text[256];
            int used = std::snprintf(text, sizeof text, "| %s | %.0f° | %.4f %.4f %.4f |",
                                     spectrum.name.c_str(), degrees, exact.r, exact.g, exact.b);
            for (const glm::dvec3& way : ways) {
                const glm::dvec3 off = way - exact;
                used += std::snprintf(text + used, sizeof text - static_cast<size_t>(used),
                                      " %+.4f %+.4f %+.4f |", off.r, off.g, off.b);
            }
            rows.emplace_back(text);
        }
    }
    return rows;
}

TEST(Bands, TheDocumentationHoldsTheMeasuredErrors) {
    std::ifstream file(std::filesystem::path(LOBE_SOURCE_DIR) / "docs/bands.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    for (const std::string& row : tableOfErrors()) {
        std::printf("%s\n", row.c_str());
        EXPECT_NE(page.find(row + '\n'), std::string::npos) << row;
    }
}

TEST(Bands, ThreeWavelengthsAreOffByWhatMoreBandsMend) {
    const std::vector<Band>& fine = shading::bandsOf(*shading::metalSpectrum("gold"), 64);
    const std::vector<Band>& some = shading::bandsOf(*shading::metalSpectrum("gold"), 16);
    const shading::Metal& gold = metalNamed("gold");
    const double red = shading::bandReflectance(fine, 1.0).r;
    EXPECT_GT(std::abs(shading::exactReflectance({gold.eta.r, gold.k.r}, 1.0) - red), 0.05);
    EXPECT_LT(std::abs(shading::bandReflectance(some, 1.0).r - red), 0.01);
}

class BandsGlsl : public test::OnContext {};

/// Every model that Fresnel's equations weight, on every kind of configuration, with each metal.
TEST_P(BandsGlsl, AgreeWithTheTwin) {
    gl::ShaderLibrary bandLibrary = library();
    bandLibrary.mount("test/bands.glsl", "bands.glsl", "#define FRESNEL_BANDS 1\n");
    std::vector<float> table;
    std::map<std::pair<size_t, int>, int> firstRow;
    const std::vector<int> counts{4, 16, 64};
    for (size_t m = 0; m < shading::metalSpectra().size(); ++m)
        for (int count : counts) {
            firstRow[{m + 1, count}] = static_cast<int>(table.size() / 4);
            const TableRows& rows = shading::bandRows(shading::metalSpectra()[m], count);
            table.insert(table.end(), rows.begin(), rows.end());
        }
    int models = 0;
    for (const Brdf& brdf : allBrdfs()) {
        const auto places = shading::fresnelPlaces(brdf);
        if (!places) continue;
        ++models;
        SCOPED_TRACE(brdf.name);
        std::vector<harness::BrdfRow> rows = harness::brdfRows(brdf, test::tableScale(60), 7);
        harness::Snippet snippet;
        snippet.name = brdf.name + "_bands";
        snippet.includes = {"test/bands.glsl", "brdf/" + brdf.name + ".glsl"};
        snippet.inputs = {{"vec3", "wi"}, {"vec3", "wo"}};
        std::string constructor;
        for (const Parameter& parameter : brdf.parameters) {
            snippet.inputs.push_back({glslType(parameter.kind), parameter.glslName});
            constructor += (constructor.empty() ? "" : ", ") + parameter.glslName;
        }
        const std::string type = glslParameterType(brdf);
        snippet.results = 3;
        snippet.body = "    " + type + " p = " + type + "(" + constructor +
                       ");\n    result[0].xyz = " + brdf.name +
                       "_f_cos(Dirs(wi, wo, wi + wo), p);\n    result[1].xyz = " + brdf.name + "_ambient(p);";
        if (brdf.mirror)
            snippet.body += "\n    result[2].xyz = " + brdf.name + "_mirror(wo.z, dot(wo.xy, wo.xy), p);";
        std::vector<float> inputs;
        for (size_t i = 0; i < rows.size(); ++i) {
            const size_t metal = 1 + i % shading::metalSpectra().size();
            const int count = counts[i % counts.size()];
            std::vector<float>& values = rows[i].values;
            values[places->type] = static_cast<float>(shading::FresnelType::bands);
            const std::vector<float> eta{static_cast<float>(metal), static_cast<float>(count), 0.0f};
            std::copy(eta.begin(), eta.end(), values.begin() + static_cast<std::ptrdiff_t>(places->eta));
            std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(places->k), 3, 0.0f);
            for (const glm::vec3& w : {rows[i].wi, rows[i].wo})
                inputs.insert(inputs.end(), {w.x, w.y, w.z});
            const size_t start = inputs.size();
            inputs.insert(inputs.end(), values.begin(), values.end());
            inputs[start + places->k] = static_cast<float>(firstRow.at({metal, count}));
        }
        const harness::ResultTable results = harness::Evaluator(bandLibrary, snippet).evaluate(inputs, table);
        harness::Comparison comparison(brdf, harness::Axes::local);
        for (size_t i = 0; i < rows.size(); ++i) {
            const auto r = results.row(i);
            const Directions d = harness::directionsOf(rows[i]);
            ASSERT_TRUE(comparison.check(rows[i], d, {r[0], r[1], r[2]})) << comparison.message();
            // 16 roundings, times what the weights' signs can add up to, at most 3.
            constexpr double kAllowance = 16.0 * 3.0 * 0x1p-24;
            const ParameterValues values = harness::valuesOf(brdf, rows[i]);
            const glm::dvec3 ambient = brdf.ambient(values);
            const bool ideal =
                brdf.name == "mirror";  // he's has a factor of its own, which other tests look at
            const glm::dvec3 mirror = ideal ? brdf.mirror(d.wo.z, values) : glm::dvec3(0.0);
            for (size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(r[4 + c], ambient[static_cast<int>(c)], kAllowance);
                if (ideal) {
                    EXPECT_NEAR(r[8 + c], mirror[static_cast<int>(c)], kAllowance);
                }
            }
        }
        std::printf("%s: %s\n", brdf.name.c_str(), comparison.report().c_str());
    }
    EXPECT_GE(models, 5);
}

LOBE_ON_EVERY_BACKEND(BandsGlsl);

}  // namespace
}  // namespace lobe
