#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "base/error.hpp"
#include "plot/drawing.hpp"
#include "plot/gnuplot.hpp"

namespace lobe::plot {
namespace {

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(PlotModel, ParametersByTheNamesOfScenes) {
    const Model phong =
        makeModel("phong", {{"diffuse", "0.1,0.2,0.3"}, {"specular", "0.5"}, {"normalization", "energy"}});
    EXPECT_EQ(describe(phong),
              "Phong: ambient 0, diffuse (0.1, 0.2, 0.3), specular 0.5, shininess 32, normalization energy");
    const Model ggx = makeModel("ggx", {{"alpha", "0.2"}, {"metal", "gold"}});
    EXPECT_NE(describe(ggx).find("alphaX 0.2, alphaY 0.2"), std::string::npos);
    EXPECT_NE(describe(ggx).find("metal gold"), std::string::npos);
    // A value puts in use the equations that read it.
    EXPECT_NE(describe(makeModel("ggx", {{"eta", "2"}})).find("fresnel dielectric, eta 2"),
              std::string::npos);
    EXPECT_NE(describe(makeModel("ggx", {{"eta", "2"}, {"k", "1"}})).find("fresnel conductor"),
              std::string::npos);
    EXPECT_THROW(makeModel("ggx", {{"metal", "gold"}, {"k", "1"}}), UsageError);
    EXPECT_NE(describe(makeModel("lafortune", {{"lobes", "clay"}})).find("lobes clay"), std::string::npos);
    for (const double value : ggx.values)
        EXPECT_EQ(value, double(static_cast<float>(value)));
}

TEST(PlotModel, WhatCannotBeIsNamed) {
    const auto message = [](const char* model, const char* key, const char* text) {
        return messageOf([&] { makeModel(model, {{key, text}}); });
    };
    EXPECT_NE(message("phong", "shinines", "1").find("did you mean 'shininess'"), std::string::npos);
    EXPECT_NE(message("phong", "shininess", "-1").find("expected 0..1000000"), std::string::npos);
    EXPECT_NE(message("phong", "shininess", "nan").find("NaN"), std::string::npos);
    EXPECT_NE(message("phong", "shininess", "12x").find("expected a number"), std::string::npos);
    EXPECT_NE(message("phong", "diffuse", "1,2").find("expected a number, or three"), std::string::npos);
    EXPECT_NE(message("phong", "normalization", "energ").find("did you mean 'energy'"), std::string::npos);
    EXPECT_NE(message("ggx", "metal", "golt").find("did you mean 'gold'"), std::string::npos);
    EXPECT_NE(message("lafortune", "lobes", "clai").find("did you mean 'clay'"), std::string::npos);
    EXPECT_NE(message("lambert", "alpha", "1").find("unknown parameter"), std::string::npos);
}

TEST(PlotModel, WidthParameters) {
    const std::vector<std::pair<const char*, const char*>> known{{"phong", "shininess"},
                                                                 {"ggx", "alpha"},
                                                                 {"lambert", ""},
                                                                 {"cook_torrance", "m"},
                                                                 {"metallic_roughness", "roughness"}};
    for (const auto& [model, parameter] : known)
        EXPECT_EQ(widthParameter(requireBrdf(model)), parameter) << model;
    for (const Brdf& brdf : allBrdfs())
        if (const std::string name = widthParameter(brdf); !name.empty()) {
            EXPECT_NO_THROW(scalarParameterOf(brdf, name)) << brdf.name;
        }
}

TEST(PlotTable, NumbersAndTexts) {
    Table table({"name", "x [1]"});
    table.add({std::string("a,\"b\""), 1.0 / 3.0});
    table.add({std::string("plain"), -0.0});
    table.add({std::string(), 1.5e-30});
    EXPECT_EQ(table.csv(), "name,x [1]\n\"a,\"\"b\"\"\",0.333333333\nplain,0\n,1.5e-30\n");
}

TEST(PlotTable, NineDigitsTellFloatsApart) {
    for (float value : {0.1f, 1e-38f, 16777217.0f, 3.4028235e38f, 1.17549435e-38f})
        EXPECT_EQ(std::strtof(numberText(double(value)).c_str(), nullptr), value);
}

TEST(PlotText, LeavesNothingForGnuplotToRead) {
    EXPECT_EQ(gnuplotText("Ward b"), "\"Ward b\"");
    EXPECT_EQ(gnuplotText("1\""), "\"\\061\\042\"");
    for (const char* hostile :
         {"`touch x`", "\"; system('x'); \"", "@macro $x", "a\nplot sin(x)", "\\\"", "%s {/Symbol a}"}) {
        const std::string text = gnuplotText(hostile);
        for (char c : text.substr(1, text.size() - 2))
            EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ' ' || c == '\\') << text;
    }
    EXPECT_EQ(gnuplotText("\xCE\xB8"), "\"\\316\\270\"");
    for (const char* bad :
         {"\xFF", "\xC0\x80", "\xED\xA0\x80", "\x01", "\xEF\xBF\xBF", "\xC2\x85", "\xF4\x90\x80\x80"})
        EXPECT_EQ(gnuplotText(bad).substr(0, 5), "\"\\077") << bad;
}

Drawing smallDrawing(const std::string& title) {
    Drawing drawing{Table({"x"}), title, {"caption of " + title}, "set yrange [0:2]\nplot 1\n"};
    return drawing;
}

TEST(PlotGnuplot, DrawsTheSameBytesAndEscapesForXml) {
    const std::string first = render(smallDrawing("a < b & `id` \"c\""), Format::svg, 400, 320);
    EXPECT_EQ(first, render(smallDrawing("a < b & `id` \"c\""), Format::svg, 400, 320));
    EXPECT_NE(first.find("a &lt; b &amp; `id`"), std::string::npos);
    EXPECT_EQ(first.find("uid="), std::string::npos);
    EXPECT_EQ(render(smallDrawing("x"), Format::png, 400, 320).substr(1, 3), "PNG");
}

TEST(PlotGnuplot, ComplaintsAreErrors) {
    EXPECT_NE(messageOf([] { runGnuplot("set terminal svg\nplot $nothing\n"); }).find("gnuplot: "),
              std::string::npos);
    EXPECT_NE(messageOf([] { runGnuplot("set terminal svg\nplot 1 with nonsense\n"); }), "");
    EXPECT_NE(messageOf([] { runGnuplot("set terminal svg\n"); }).find("nothing"), std::string::npos);
    EXPECT_NE(messageOf([] { runGnuplot("set terminal svg\n$d << EOD\nEOD\nplot $d using 1:2\n"); }), "");
}

TEST(PlotGnuplot, MissingProgramIsNamedWithItsPackage) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nonexistent", 1);
    const std::string message = messageOf([] { runGnuplot("plot 1\n"); });
    const std::string csv = render(smallDrawing("x"), Format::csv, 400, 320);
    setenv("PATH", path.c_str(), 1);
    EXPECT_NE(message.find("gnuplot-nox"), std::string::npos) << message;
    EXPECT_EQ(csv, "x\n");
}

}  // namespace
}  // namespace lobe::plot
