#include "printer.hpp"

#include <unistd.h>

#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace lobe::app {
namespace {

using harness::UnitResult;
using Status = UnitResult::Status;

constexpr const char* kGreen = "32";
constexpr const char* kRed = "31";
constexpr const char* kYellow = "33";

std::string briefly(const UnitResult& result) {
    std::ostringstream text;
    text << result.rows << (result.rows == 1 ? " input, " : " inputs, ") << std::fixed << std::setprecision(0)
         << result.milliseconds << " ms";
    if (result.skipped > 0) text << ", " << result.skipped << " left out by assume()";
    if (result.mustFail) text << ", fails as it must";
    return text.str();
}

}  // namespace

Printer::Printer(const CheckOptions& options)
    : silent_(options.junit == "-" || options.json == "-" || options.tap == "-"),
      quiet_(options.quiet),
      color_(!options.noColor && std::getenv("NO_COLOR") == nullptr && isatty(STDOUT_FILENO) != 0) {}

std::string Printer::colored(const char* code, const std::string& text) const {
    return color_ ? std::string("\033[") + code + "m" + text + "\033[0m" : text;
}

void Printer::result(const UnitResult& result) {
    const bool passed = result.status == Status::passed;
    if (silent_ || (quiet_ && passed)) return;
    if (file_ != result.file) std::cout << result.file << "\n";
    file_ = result.file;
    const std::string verdict = passed                            ? colored(kGreen, "ok    ")
                                : result.status == Status::failed ? colored(kRed, "FAILED")
                                                                  : colored(kYellow, "ERROR ");
    std::cout << "  " << verdict << " " << result.name;
    if (passed)
        std::cout << "  (" << briefly(result) << ")\n";
    else
        std::cout << "  " << result.file << (result.line > 0 ? ":" + std::to_string(result.line) : "")
                  << "\n";
    for (const std::string& line : failureLines(result))
        std::cout << "         " << line << "\n";
    std::cout.flush();
}

void Printer::sum(const RunReport& report) const {
    if (silent_) return;
    const size_t failed = report.count(Status::failed);
    const size_t errors = report.count(Status::error);
    std::ostringstream text;
    text << report.count(Status::passed) << " passed, " << failed << " failed";
    if (errors > 0) text << ", " << errors << (errors == 1 ? " error" : " errors");
    std::cout << colored(failed + errors > 0 ? kRed : kGreen, text.str());
    if (!report.backend.empty()) std::cout << " on " << report.backend << ", " << report.renderer;
    std::cout << ", in " << std::fixed << std::setprecision(1) << report.seconds << " s" << std::endl;
}

}  // namespace lobe::app
