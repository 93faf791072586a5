#include "measure/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kPng = "\x89PNG\r\n\x1a\nrest";

json smallReport() {
    return {{"schema", 1}, {"scenes", json::array()}, {"pictures", {{"one", "pictures/one.png"}}}};
}

std::string page(const json& report, const std::string& bytes = kPng) {
    return reportPage(report, [&](const std::string&) { return bytes; });
}

/// What is between the tags of the JSON element `id`.
std::string element(const std::string& text, const std::string& id) {
    const std::string open = "id=\"" + id + "\">";
    const std::size_t from = text.find(open) + open.size();
    return text.substr(from, text.find("</script>", from) - from);
}

class PageFolder : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  ("lobe_page_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "report" / "pictures");
    }
    void TearDown() override { fs::remove_all(folder_); }
    static void put(const fs::path& path, const std::string& bytes) {
        std::ofstream(path, std::ios::binary) << bytes;
    }
    fs::path folder_;
};

TEST(Page, HoldsTheReportAndItsPicturesUnchanged) {
    json report = smallReport();
    report["command"] = "</script><!-- {{pictures}} <script> & \" \\ é";
    const std::string text = page(report);
    EXPECT_EQ(json::parse(element(text, "report")), report);
    EXPECT_EQ(element(text, "report").find('<'), std::string::npos);
    EXPECT_EQ(json::parse(element(text, "pictures")),
              json({{"one", "data:image/png;base64,iVBORw0KGgpyZXN0"}}));
}

TEST(Page, IsCompleteAndAsksForNothing) {
    const std::string text = page(smallReport());
    EXPECT_THAT(text, HasSubstr("Chart.js v3"));
    EXPECT_THAT(text, Not(HasSubstr("{{report")));
    EXPECT_THAT(text, HasSubstr("default-src 'none'"));
    for (const char* outside : {"<link rel=\"stylesheet\"", "<script src", "@import", "url("})
        EXPECT_THAT(text, Not(HasSubstr(outside)));
}

TEST(Page, KnowsKindsOfPicturesByTheirBytes) {
    EXPECT_THAT(page(smallReport(), "\xff\xd8\xff\xe0"), HasSubstr("data:image/jpeg;base64,"));
    EXPECT_THAT(page(smallReport(), "RIFF\1\1\1\1WEBPVP8 "), HasSubstr("data:image/webp;base64,"));
    for (const char* bytes : {"", "RIFF", "<svg onload=alert(1)>"})
        EXPECT_THROW(page(smallReport(), bytes), InputError) << bytes;
}

TEST(Page, RefusesOtherSchemasAndShapes) {
    json report = smallReport();
    report["schema"] = 2;
    EXPECT_THROW(page(report), InputError);
    EXPECT_THROW(page(json::object()), InputError);
    EXPECT_THROW(page(json::array()), InputError);
    for (const json& pictures : {json::array(), json({{"one", 1}})}) {
        report = smallReport();
        report["pictures"] = pictures;
        EXPECT_THROW(page(report), InputError) << pictures;
    }
}

TEST(Page, WritesInfinityAsNullAndReplacesWhatIsNotUtf8) {
    json report = smallReport();
    report["psnr"] = std::numeric_limits<double>::infinity();
    report["command"] = "\xff";
    const json read = json::parse(element(page(report), "report"));
    EXPECT_TRUE(read.at("psnr").is_null());
    EXPECT_EQ(read.at("command"), "\xef\xbf\xbd");
}

TEST_F(PageFolder, IsWrittenBesideThePictures) {
    put(folder_ / "report" / "pictures" / "one.png", kPng);
    writeReportPage(smallReport(), folder_ / "report");
    EXPECT_GT(fs::file_size(folder_ / "report" / "report.html"), 200000u);
}

TEST_F(PageFolder, TakesNoPictureFromOutsideAndLeavesNothingBehind) {
    put(folder_ / "secret.png", kPng);
    fs::create_symlink(folder_ / "secret.png", folder_ / "report" / "pictures" / "link.png");
    for (const std::string& file :
         {std::string("../secret.png"), (folder_ / "secret.png").string(), std::string("pictures/link.png"),
          std::string("pictures/../../secret.png"), std::string("pictures/missing.png"), std::string("")}) {
        json report = smallReport();
        report["pictures"]["one"] = file;
        EXPECT_THROW(writeReportPage(report, folder_ / "report"), InputError) << file;
    }
    EXPECT_FALSE(fs::exists(folder_ / "report" / "report.html"));
}

}  // namespace
}  // namespace lobe
