// Tables as CSV: what is read as it was written, and what is refused, with its line.
#include "harness/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.hpp"
#include "math/random.hpp"

namespace lobe::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

CsvTable table(const std::string& text) {
    std::istringstream stream(text);
    return readCsv(stream, "t.csv");
}

std::string refusal(const std::string& text) {
    try {
        table(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(Csv, ReadsQuotesLineEndsMarksAndBlankLines) {
    const CsvTable t = table(
        "\xEF\xBB\xBF"
        "id, x ,\"a,b\"\r\n"
        "1,2.5,\"he said \"\"no\"\"\"\r\n"
        "\r\n"
        "  \n"
        "2,,\"two\nlines\"\n"
        "3,4,5");
    EXPECT_THAT(t.columns, ElementsAre("id", "x", "a,b"));
    ASSERT_EQ(t.rows.size(), 3u);
    EXPECT_THAT(t.rows[0], ElementsAre("1", "2.5", "he said \"no\""));
    EXPECT_THAT(t.rows[1], ElementsAre("2", "", "two\nlines"));
    EXPECT_THAT(t.rows[2], ElementsAre("3", "4", "5"));
    EXPECT_THAT(t.lines, ElementsAre(2u, 5u, 7u));
    EXPECT_EQ(t.column("x"), 1u);
    EXPECT_FALSE(t.column("y").has_value());
}

TEST(Csv, RefusesWithFileAndLine) {
    EXPECT_THAT(refusal(""), HasSubstr("t.csv: empty; expected a line with the names of the columns"));
    EXPECT_THAT(refusal("\n \n"), HasSubstr("t.csv: empty"));
    EXPECT_EQ(refusal("a,b,a\n"), "t.csv:1: column 'a' is there twice");
    EXPECT_EQ(refusal("\na,,b\n"), "t.csv:2: column 2 has no name");
    EXPECT_EQ(refusal("a,b\n1,2\n\n3\n"), "t.csv:4: 1 cell; expected 2, one a column");
    EXPECT_EQ(refusal("a,b\n1,2,3\n"), "t.csv:2: 3 cells; expected 2, one a column");
    EXPECT_EQ(refusal("a,b\n1,\"2\n3,4\n"),
              "t.csv:2: a quote that is not closed, or not doubled within a cell");
    EXPECT_EQ(refusal("a,b\n1,2\n1,x\"y\"\n"),
              "t.csv:3: a quote that is not closed, or not doubled within a cell");
    EXPECT_THAT(refusal("a,b\n1,\"" + std::string(2 << 20, 'x')),
                HasSubstr("t.csv:2: more than 1 MiB in a row"));
}

TEST(Csv, RefusesFoldersAndMissingFiles) {
    EXPECT_THROW(readCsv(std::filesystem::temp_directory_path()), InputError);
    try {
        readCsv("/nowhere/t.csv");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "/nowhere/t.csv: can't be read: No such file or directory");
    }
}

TEST(Csv, NumbersAreDecimalHexadecimalAndNamed) {
    EXPECT_EQ(parseNumber("-2.5e-3"), -2.5e-3);
    EXPECT_EQ(parseNumber("+7"), 7.0);
    EXPECT_EQ(parseNumber("0x1.8p-3"), 0.1875);
    EXPECT_EQ(parseNumber("-0X.8"), -0.5);
    EXPECT_EQ(parseNumber("inf"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(parseNumber("-Infinity"), -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(parseNumber("NaN").value()));
    for (const char* text :
         {"", " 1", "1 ", "1,5", "1x", "--1", "+-1", "0x", "0xinf", "0x-1", "1e999", "one", "-"})
        EXPECT_FALSE(parseNumber(text).has_value()) << text;
    EXPECT_EQ(parseInteger("-12"), -12);
    EXPECT_EQ(parseInteger("+12"), 12);
    for (const char* text : {"", "1.0", "1e3", "+-1", "99999999999999999999"})
        EXPECT_FALSE(parseInteger(text).has_value()) << text;
}

TEST(Csv, ANumberThatIsNoneIsNamedWithItsPlace) {
    const CsvTable t = table("x\n1\n2;5\n");
    EXPECT_EQ(t.number(0, 0), 1.0);
    try {
        t.number(1, 0);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "t.csv:3: x: '2;5'; expected a number");
    }
}

TEST(Csv, NineDigitsKeepEveryFloat) {
    Pcg32 random(5);
    for (int i = 0; i < 100000; ++i) {
        const auto x =
            static_cast<float>(random.logUniform(1e-45, 3e38)) * (random.below(2) == 0 ? 1.0f : -1.0f);
        EXPECT_EQ(static_cast<float>(parseNumber(numberText(double{x})).value()), x);
    }
    EXPECT_EQ(numberText(-std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(numberText(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(numberText(0.1), "0.1");
    EXPECT_EQ(numberText(1.0 / 3.0), "0.333333333");
}

TEST(Csv, WhatIsWrittenIsReadBack) {
    const std::vector<std::string> cells{"",         "plain", "a,b",   "say \"so\"", "two\r\nlines",
                                         " spaced ", "\"",    "0x1p-3"};
    std::string text;
    appendRow(text, {"c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"});
    appendRow(text, cells);
    const CsvTable t = table(text);
    ASSERT_EQ(t.rows.size(), 1u);
    EXPECT_EQ(t.rows[0], cells);
}

}  // namespace
}  // namespace lobe::harness
