/// FOLDER/report.json to FOLDER/report.html, for the test in a browser.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "measure/page.hpp"

int main(int argc, char** argv) try {
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];
    std::ifstream file(folder / "report.json");
    lobe::writeReportPage(nlohmann::json::parse(file), folder);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
