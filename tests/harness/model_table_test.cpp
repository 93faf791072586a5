// Every registered model over a table that is written and read as people would: GLSL against twin within the
// derived tolerance, the twin against itself, and what columns may not say.
#include "harness/model_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "base/error.hpp"
#include "harness/comparison.hpp"
#include "harness/table_evaluation.hpp"
#include "shading/on_contexts.hpp"

namespace lobe::harness {
namespace {

using testing::HasSubstr;

/// All digits of a float, as a double.
std::string digits(float x) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, double{x}).ptr;
    return {text, end};
}

std::vector<std::string> columnsFor(const Brdf& brdf) {
    std::vector<std::string> columns{"id", "lx", "ly", "lz", "vx", "vy", "vz"};
    for (const Parameter& parameter : brdf.parameters)
        if (parameter.kind == ParameterKind::rgb)
            for (const char* channel : {"_r", "_g", "_b"})
                columns.push_back(parameter.name + channel);
        else
            columns.push_back(parameter.name);
    return columns;
}

std::vector<std::string> cellsFor(const Brdf& brdf, const BrdfRow& row, size_t id) {
    std::vector<std::string> cells{std::to_string(id)};
    for (const glm::vec3& w : {row.wi, row.wo})
        for (int c = 0; c < 3; ++c)
            cells.push_back(digits(w[c]));
    size_t at = 0;
    for (const Parameter& parameter : brdf.parameters) {
        if (parameter.kind == ParameterKind::choice)
            cells.push_back(parameter.choices[static_cast<size_t>(row.values[at])]);
        else if (parameter.kind == ParameterKind::table)
            cells.push_back(brdf.table->examples()[static_cast<size_t>(row.table)].first);
        else
            for (int c = 0; c < parameter.components(); ++c)
                cells.push_back(digits(row.values[at + static_cast<size_t>(c)]));
        at += static_cast<size_t>(parameter.components());
    }
    return cells;
}

std::string csvOf(const Brdf& brdf, const std::vector<BrdfRow>& rows) {
    std::string text;
    appendRow(text, columnsFor(brdf));
    for (size_t i = 0; i < rows.size(); ++i)
        appendRow(text, cellsFor(brdf, rows[i], i));
    return text;
}

using Make = std::unique_ptr<TableEvaluation> (*)(const Brdf&, const TableHeader&,
                                                  const std::optional<TableRows>&);

std::vector<glm::dvec3> evaluated(Make make, const Brdf& brdf, const std::string& csv,
                                  const std::optional<TableRows>& table = {}) {
    std::istringstream stream(csv);
    CsvReader reader(stream, "t.csv");
    const auto evaluation = make(brdf, {reader.name(), reader.columns()}, table);
    std::vector<glm::dvec3> results;
    const auto finish = [&] {
        for (const std::string& line : evaluation->finish()) {
            std::istringstream cells(line);
            glm::dvec3 f;
            std::string cell;
            for (int c = 0; c < 3 && std::getline(cells, cell, ','); ++c)
                f[c] = parseNumber(cell).value();
            results.push_back(f);
        }
    };
    for (CsvRow row; reader.next(row);) {
        evaluation->add(row);
        if (evaluation->isFull()) finish();
    }
    finish();
    EXPECT_TRUE(evaluation->warnings().empty());
    return results;
}

class ModelTable : public test::OnContext {};

TEST_P(ModelTable, GlslAgreesWithTheTwinOnEveryModel) {
    for (const Brdf& brdf : allBrdfs()) {
        const std::vector<BrdfRow> rows = brdfRows(brdf, test::tableScale(400), 11);
        const auto results = evaluated(modelEvaluation, brdf, csvOf(brdf, rows));
        ASSERT_EQ(results.size(), rows.size()) << brdf.name;
        Comparison comparison(brdf, Axes::local);
        for (size_t i = 0; i < rows.size(); ++i)
            ASSERT_TRUE(comparison.check(rows[i], directionsOf(rows[i]), glm::vec3(results[i])))
                << comparison.message();
    }
}

LOBE_ON_EVERY_BACKEND(ModelTable);

/// Ends of ranges that are no floats, as they were before they were rounded.
ParameterValues withBounds(const Brdf& brdf, ParameterValues values) {
    size_t at = 0;
    for (const Parameter& parameter : brdf.parameters)
        for (int c = 0; c < parameter.components(); ++c, ++at)
            for (const double bound : {parameter.minimum, parameter.maximum})
                if (values[at] == double{static_cast<float>(bound)}) values[at] = bound;
    return values;
}

TEST(ModelTwin, IsTheRegistrysToNineDigits) {
    for (const Brdf& brdf : allBrdfs()) {
        const std::vector<BrdfRow> rows = brdfRows(brdf, 50, 12);
        const auto results = evaluated(twinEvaluation, brdf, csvOf(brdf, rows));
        ASSERT_EQ(results.size(), rows.size());
        for (size_t i = 0; i < rows.size(); ++i) {
            const glm::dvec3 exact =
                brdf.fCos(directionsOf(rows[i]), withBounds(brdf, valuesOf(brdf, rows[i])));
            // Tables are rounded to floats in valuesOf(). Otherwise doubles, whose rounding a lobe's far tail
            // blows up.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(results[i][c], exact[c], (brdf.table ? 1e-2 : 5.1e-9) * exact[c])
                    << brdf.name << " " << describe(rows[i]);
        }
    }
}

glm::dvec3 twin(const std::string& model, const std::string& columns, const std::string& cells) {
    const auto results =
        evaluated(twinEvaluation, requireBrdf(model),
                  "lx,ly,lz,vx,vy,vz" + columns + "\n0.6,0,0.8,-0.36,0.48,0.8" + cells + "\n");
    return results.at(0);
}

std::string refusal(const std::string& model, const std::string& columns, const std::string& cells) {
    try {
        twin(model, columns, cells);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(ModelColumns, OneColumnStandsForAllChannels) {
    EXPECT_EQ(twin("phong", ",diffuse", ",0.25"),
              twin("phong", ",diffuse_r,diffuse_g,diffuse_b", ",0.25,0.25,0.25"));
    const glm::dvec3 f = twin("lambert", ",diffuse_b,diffuse_r,diffuse_g", ",0.3,0.1,0.2");
    EXPECT_NEAR(f.g / f.r, 2.0, 1e-7);
    EXPECT_NEAR(f.b / f.r, 3.0, 1e-7);
    EXPECT_THAT(refusal("phong", ",diffuse,diffuse_r", ",1,1"), HasSubstr("columns diffuse and diffuse_r"));
    EXPECT_THAT(refusal("phong", ",diffuse_r,diffuse_b", ",1,1"), HasSubstr("no column diffuse_g"));
}

TEST(ModelColumns, WhatIsGivenDecidesOnFresnelsEquations) {
    const std::string type = ",fresnel,f0,eta,k";
    EXPECT_EQ(twin("cook_torrance", ",f0", ",0.5"), twin("cook_torrance", type, ",schlick,0.5,,"));
    EXPECT_EQ(twin("cook_torrance", ",eta", ",1.3"), twin("cook_torrance", type, ",dielectric,,1.3,"));
    EXPECT_EQ(twin("cook_torrance", ",eta,k", ",0.2,3"), twin("cook_torrance", type, ",conductor,,0.2,3"));
    EXPECT_EQ(twin("cook_torrance", ",f0,eta,k", ",,0.2,3"),
              twin("cook_torrance", type, ",conductor,,0.2,3"));
    EXPECT_EQ(twin("cook_torrance", ",f0,eta,k", ",0.5,,"), twin("cook_torrance", type, ",schlick,0.5,,"));
    EXPECT_NE(twin("cook_torrance", ",eta,k", ",0.2,3"), twin("cook_torrance", ",eta", ",0.2"));
    EXPECT_THAT(refusal("cook_torrance", ",f0,eta", ",1,1"), HasSubstr("t.csv:2: both f0 and eta"));
    EXPECT_THAT(refusal("cook_torrance", ",k", ",1"), HasSubstr("t.csv:2: k without eta"));
    EXPECT_THAT(refusal("cook_torrance", ",fresnel", ",shlick"), HasSubstr("did you mean 'schlick'?"));
}

TEST(ModelColumns, LengthsAreInAnyUnit) {
    const glm::dvec3 metres = twin("he", ",sigma,tau,wavelength", ",2e-7,3e-6,5e-7");
    for (const char* cells : {",0.2,3,0.5", ",200,3000,500", ",2e-16,3e-15,5e-16"}) {
        const glm::dvec3 other = twin("he", ",sigma,tau,wavelength", cells);
        EXPECT_NEAR(other.g / metres.g, 1.0, 1e-7) << cells;
    }
    EXPECT_THAT(refusal("he", ",sigma,tau,wavelength", ",-1,3000,500"), HasSubstr("sigma: -"));
    EXPECT_THAT(refusal("he", ",wavelength", ",0"), HasSubstr("wavelength: 0; expected above 0"));
}

TEST(ModelColumns, LobesAreCountedFromZeroAndRowsMayHaveFewer) {
    const std::string lobe0 = ",cx0,cy0,cz0,n0";
    const std::string lobe1 = ",cx1_r,cx1_g,cx1_b,cy1,cz1,n1";
    const glm::dvec3 one = twin("lafortune", lobe0, ",-1,-1,1,2");
    EXPECT_EQ(twin("lafortune", lobe0 + lobe1, ",-1,-1,1,2,,,,,,"), one);
    const glm::dvec3 both = twin("lafortune", lobe0 + lobe1, ",-1,-1,1,2,-0.1,-0.2,-0.3,-0.5,0.9,3");
    EXPECT_GT(both.b, both.r);
    EXPECT_GT(both.r, one.r);
    EXPECT_EQ(
        twin("lafortune", ",lobes", ",skin"),
        evaluated(twinEvaluation, requireBrdf("lafortune"), "lx,ly,lz,vx,vy,vz\n0.6,0,0.8,-0.36,0.48,0.8\n",
                  tableForAllRows(requireBrdf("lafortune"), "skin"))
            .at(0));
    EXPECT_THAT(refusal("lafortune", "", ""), HasSubstr("no lobes; expected columns cx0, cy0, cz0, n0, ..."));
    EXPECT_THAT(refusal("lafortune", ",cx0,cy0,cz0", ",1,1,1"), HasSubstr("no column n0"));
    EXPECT_THAT(refusal("lafortune", lobe0, ",1,1,1,nan"),
                HasSubstr("t.csv:2: n0: nan; expected a finite number"));
    EXPECT_THAT(refusal("lafortune", lobe0, ",1,1,1,0"), HasSubstr("t.csv:2: lobes[0].n: 0"));
    EXPECT_THAT(refusal("lafortune", lobe0 + ",cx2,cy2,cz2,n2", ",1,1,1,1,1,1,1,1"),
                HasSubstr("column 'cx2'"));
    EXPECT_THROW(tableForAllRows(requireBrdf("lambert"), "skin"), UsageError);
}

TEST(ModelColumns, AnEndOfARangeMayHaveBeenAFloat) {
    EXPECT_EQ(twin("cook_torrance", ",m", ",9.99999975e-06"), twin("cook_torrance", ",m", ",1e-5"));
    EXPECT_THAT(refusal("cook_torrance", ",m", ",9.999999e-06"),
                HasSubstr("m: 9.999999e-06; expected 1e-05..10"));
}

TEST(ModelColumns, RefusesWithPlaceAndRange) {
    EXPECT_THAT(refusal("ggx", ",alfaX", ",1"),
                HasSubstr("t.csv:1: column 'alfaX' is none of ggx; did you mean 'alphaX'?"));
    EXPECT_EQ(refusal("ggx", ",alphaX", ",2"), "t.csv:2: alphaX: 2; expected 0.0001..1");
    EXPECT_THAT(refusal("ggx", ",alphaX", ",nan"), HasSubstr("t.csv:2: alphaX: NaN; expected 0.0001..1"));
    EXPECT_THAT(refusal("ggx", ",alphaX", ",0.1x"), HasSubstr("t.csv:2: alphaX: '0.1x'; expected a number"));
    EXPECT_THAT(refusal("ggx", ",alphaX", ","), HasSubstr("t.csv:2: alphaX: ''; expected a number"));
    EXPECT_THAT(refusal("phong", ",normalization", ",energie"), HasSubstr("did you mean 'energy'?"));
    const Brdf& lambert = requireBrdf("lambert");
    const auto direction = [&](const std::string& header, const std::string& cells) {
        try {
            evaluated(twinEvaluation, lambert, header + "\n" + cells + "\n");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("(accepted)");
    };
    EXPECT_THAT(direction("lx,ly,vx,vy,vz", "0,0,0,0,1"), HasSubstr("t.csv:1: no column lz"));
    EXPECT_THAT(direction("lx,ly,lz,vx,vy,vz", "0,0,1,0,0,0"),
                HasSubstr("t.csv:2: vx: a direction of length 0"));
    EXPECT_THAT(direction("lx,ly,lz,vx,vy,vz", "0,0,1,0,inf,0"),
                HasSubstr("t.csv:2: vy: inf; expected a finite number"));
}

TEST(ModelColumns, DirectionsOfOtherLengthsAreNormalisedWithAWarning) {
    const TableHeader header{"t.csv", {"lx", "ly", "lz", "vx", "vy", "vz"}};
    const auto evaluation = twinEvaluation(requireBrdf("lambert"), header, {});
    evaluation->add({{"0.6", "0", "0.8", "0", "0", "1"}, 2});
    evaluation->add({{"0.60001", "0", "0.8", "0", "0", "1"}, 3});
    EXPECT_TRUE(evaluation->warnings().empty());
    evaluation->add({{"6e200", "0", "8e200", "0", "0", "1e-200"}, 4});
    EXPECT_EQ(evaluation->warnings().size(), 1u);
    const auto lines = evaluation->finish();
    EXPECT_EQ(lines[0], lines[2]);
}

}  // namespace
}  // namespace lobe::harness
