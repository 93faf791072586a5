// ShaderLibrary on small libraries written for each test: includes, and where each line came from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "gl/program.hpp"

namespace lobe::gl {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ShaderLibraryTest : public testing::Test {
protected:
    void SetUp() override {
        root_ = fs::temp_directory_path() / ("lobe_shaders_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(root_);
    }
    void TearDown() override { fs::remove_all(root_); }

    void write(const std::string& file, const std::string& text) const {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
    }
    ShaderSource source(const std::string& file, const Defines& defines = {},
                        const std::map<std::string, std::string>& generated = {}) const {
        return ShaderLibrary(root_).source(file, defines, generated);
    }
    std::string refusal(const std::string& file) const {
        try {
            source(file);
        } catch (const ShaderError& error) {
            return error.what();
        }
        ADD_FAILURE() << file << " was taken";
        return {};
    }
    const fs::path& root() const { return root_; }

private:
    fs::path root_;
};

/// "FILE:LINE TEXT" for each line of a source.
std::vector<std::string> placed(const ShaderSource& source) {
    std::vector<std::string> result;
    std::istringstream lines(source.text);
    size_t i = 0;
    for (std::string line; std::getline(lines, line); ++i)
        result.push_back(source.places.at(i).file + ":" + std::to_string(source.places.at(i).line) + " " +
                         line);
    EXPECT_EQ(i, source.places.size());
    return result;
}

TEST_F(ShaderLibraryTest, PutsVersionDefinesAndIncludesInOrderWithTheirPlaces) {
    write("pass/a.frag", "#include \"brdf/b.glsl\"\nvoid main() {}\n");
    write("brdf/b.glsl", "float b;\nfloat c;\n");
    EXPECT_THAT(placed(source("pass/a.frag", {{"MODEL", "ward"}, {"CLIP", "1"}})),
                testing::ElementsAre("(version):1 #version 330 core", "(defines):1 #define CLIP 1",
                                     "(defines):2 #define MODEL ward", "brdf/b.glsl:1 float b;",
                                     "brdf/b.glsl:2 float c;", "pass/a.frag:2 void main() {}"));
}

TEST_F(ShaderLibraryTest, AFileUnderAConditionIsTakenWhereverItMayBeMissing) {
    write("main.frag",
          "#ifdef A\n#include \"a.glsl\"\n#endif\n#include \"b.glsl\"\n#include \"shared.glsl\"\n");
    write("a.glsl", "#include \"shared.glsl\"\na\n");
    write("b.glsl", "#include \"shared.glsl\"\nb\n");
    write("shared.glsl", "shared\n");
    EXPECT_THAT(placed(source("main.frag")),
                testing::ElementsAre(
                    "(version):1 #version 330 core", "main.frag:1 #ifdef A", "a.glsl:1 #ifndef LOBE_TAKEN_0",
                    "a.glsl:1 #define LOBE_TAKEN_0", "shared.glsl:1 #ifndef LOBE_TAKEN_1",
                    "shared.glsl:1 #define LOBE_TAKEN_1", "shared.glsl:1 shared", "shared.glsl:1 #endif",
                    "a.glsl:2 a", "a.glsl:1 #endif", "main.frag:3 #endif",
                    "shared.glsl:1 #ifndef LOBE_TAKEN_1", "shared.glsl:1 #define LOBE_TAKEN_1",
                    "shared.glsl:1 shared", "shared.glsl:1 #endif", "b.glsl:2 b"));
}

TEST_F(ShaderLibraryTest, TakesEachFileOnceAlsoWhenTwoIncludeIt) {
    write("main.frag", "#include \"left.glsl\"\n#include \"right.glsl\"\n#include \"left.glsl\"\n");
    write("left.glsl", "#include \"shared.glsl\"\nleft\n");
    write("right.glsl", "#include \"shared.glsl\"\nright\n");
    write("shared.glsl", "shared\n");
    EXPECT_THAT(placed(source("main.frag")),
                testing::ElementsAre("(version):1 #version 330 core", "shared.glsl:1 shared",
                                     "left.glsl:2 left", "right.glsl:2 right"));
}

TEST_F(ShaderLibraryTest, AFileSpelledInAnotherWayIsTheSameFile) {
    write(
        "main.frag",
        "#include \"common/a.glsl\"\n#include \"./common//a.glsl\"\n#include \"common/../common/a.glsl\"\n");
    write("common/a.glsl", "a\n");
    EXPECT_THAT(placed(source("main.frag")),
                testing::ElementsAre("(version):1 #version 330 core", "common/a.glsl:1 a"));
}

TEST_F(ShaderLibraryTest, NamesBothEndsOfACycle) {
    write("a.glsl", "float x;\n#include \"b.glsl\"\n");
    write("b.glsl", "\n\n#include \"a.glsl\"\n");
    const std::string message = refusal("a.glsl");
    EXPECT_THAT(message, HasSubstr("b.glsl:3"));
    EXPECT_THAT(message, HasSubstr("a.glsl includes itself"));
}

TEST_F(ShaderLibraryTest, RefusesAFileThatIncludesItself) {
    write("a.glsl", "#include \"a.glsl\"\n");
    EXPECT_THAT(refusal("a.glsl"), HasSubstr("a.glsl:1: a.glsl includes itself"));
}

TEST_F(ShaderLibraryTest, RefusesIncludesThatNestTooDeep) {
    for (int i = 0; i < 40; ++i)
        write(std::to_string(i) + ".glsl", "#include \"" + std::to_string(i + 1) + ".glsl\"\n");
    write("40.glsl", "\n");
    EXPECT_THAT(refusal("0.glsl"), HasSubstr("nest deeper than 32"));
}

TEST_F(ShaderLibraryTest, NamesTheLineThatIncludesAMissingFile) {
    write("a.glsl", "\n\n#include \"nowhere/none.glsl\"\n");
    const std::string message = refusal("a.glsl");
    EXPECT_THAT(message, HasSubstr("a.glsl:3"));
    EXPECT_THAT(message, HasSubstr("nowhere/none.glsl"));
    EXPECT_THAT(message, HasSubstr(root().string()));
    EXPECT_THAT(refusal("none.frag"), HasSubstr("none.frag"));
}

TEST_F(ShaderLibraryTest, RefusesAFolderAndAnIncludeWithoutAName) {
    write("folder/x.glsl", "\n");
    write("a.glsl", "#include \"folder\"\n");
    EXPECT_THAT(refusal("a.glsl"), HasSubstr("a.glsl:1"));
    write("b.glsl", "#include <x.glsl>\n");
    EXPECT_THAT(refusal("b.glsl"), HasSubstr("b.glsl:1"));
}

TEST_F(ShaderLibraryTest, IncludesInCommentsAreText) {
    write("a.glsl",
          "// #include \"none.glsl\"\n"
          "/* #include \"none.glsl\"\n"
          "#include \"none.glsl\"\n"
          "*/\n"
          "/*/\n"
          "#include \"none.glsl\"\n"
          "*/\n"
          "/**/\n"
          "  #  include \"b.glsl\" // the real one\n"
          "// /*\n"
          "#include \"c.glsl\"\n");
    write("b.glsl", "b\n");
    write("c.glsl", "c\n");
    const std::vector<std::string> lines = placed(source("a.glsl"));
    EXPECT_THAT(lines, testing::Contains("b.glsl:1 b"));
    EXPECT_EQ(lines.back(), "c.glsl:1 c");
}

TEST_F(ShaderLibraryTest, RefusesABlockCommentThatAFileLeavesOpen) {
    write("a.glsl", "#include \"b.glsl\"\n*/\n#include \"c.glsl\"\n");
    write("b.glsl", "b /* open\n");
    write("c.glsl", "c\n");
    EXPECT_THAT(refusal("a.glsl"), HasSubstr("b.glsl: a block comment is not closed"));
}

TEST_F(ShaderLibraryTest, GeneratedTextGoesBeforeFilesAndHasPlacesToo) {
    write("a.frag", "#include \"generated/material.glsl\"\n");
    write("generated/material.glsl", "from the file\n");
    EXPECT_THAT(placed(source("a.frag", {}, {{"generated/material.glsl", "from the program\n"}})),
                testing::Contains("generated/material.glsl:1 from the program"));
}

TEST_F(ShaderLibraryTest, TakesLinesThatEndAsOnWindowsAndALastLineWithoutEnd) {
    write("a.glsl", "#include \"b.glsl\"\r\nlast");
    write("b.glsl", "b\r\n");
    EXPECT_THAT(placed(source("a.glsl")),
                testing::ElementsAre("(version):1 #version 330 core", "b.glsl:1 b", "a.glsl:2 last"));
}

}  // namespace
}  // namespace lobe::gl
