#include "reporter.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace lobe::app {
namespace {

std::string fixed(double value, int digits) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

}  // namespace

Reporter::Reporter(size_t shots, bool json, Verbosity verbosity)
    : shots_(shots),
      json_(json),
      verbosity_(verbosity),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

void Reporter::setContext(const std::string& backend, const std::string& renderer) {
    backend_ = backend;
    renderer_ = renderer;
    if (verbosity_ == Verbosity::verbose) print("context: " + backend + ", " + renderer, false);
}

void Reporter::clearBar() {
    if (barShown_) std::fputs("\r\033[K", stderr);
    barShown_ = false;
}

void Reporter::drawBar() {
    if (!terminal_ || verbosity_ == Verbosity::quiet || shots_ < 2) return;
    const size_t finished = done_ + failed_ + skipped_;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double left =
        finished ? seconds / static_cast<double>(finished) * static_cast<double>(shots_ - finished) : 0.0;
    const size_t width = 30;
    const size_t filled = width * finished / shots_;
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::fprintf(stderr, "\r\033[K[%s] %zu/%zu, %.0f s left", bar.c_str(), finished, shots_, left);
    std::fflush(stderr);
    barShown_ = true;
}

void Reporter::print(const std::string& line, bool important) {
    if (verbosity_ == Verbosity::quiet && !important) return;
    clearBar();
    std::fprintf(stderr, "%s\n", line.c_str());
}

/// The frames of a turntable share their scene, and what is wrong with it.
void Reporter::printOnce(const std::string& line, bool important) {
    constexpr size_t kMost = 1000;
    if (printed_.size() >= kMost) printed_.clear();
    if (printed_.insert(line).second) print(line, important);
}

void Reporter::addDone(const Outcome& outcome) {
    ++done_;
    const NonFinite& nonFinite = outcome.nonFinite;
    if (nonFinite.pixels > 0) {
        ++nonFinite_;
        print("lobe: error: " + outcome.shot.output + ": " + std::to_string(nonFinite.pixels) +
                  (nonFinite.pixels == 1 ? " pixel is" : " pixels are") +
                  " NaN or infinite, the first in channel " + nonFinite.firstChannel + " at " +
                  std::to_string(nonFinite.firstX) + "," + std::to_string(nonFinite.firstY),
              true);
    }
    if (terminal_ && shots_ > 1 && verbosity_ != Verbosity::verbose) return;
    print("wrote " + outcome.shot.output + " (load " + fixed(outcome.loadMs, 0) + " ms, upload " +
              fixed(outcome.uploadMs, 0) + " ms, render " + fixed(outcome.renderMs, 1) + " ms, encode " +
              fixed(outcome.encodeMs, 0) + " ms)",
          false);
    if (verbosity_ != Verbosity::verbose) return;
    for (const PassTime& pass : outcome.passes)
        print("    " + pass.pass + " " + fixed(pass.milliseconds, 2) + " ms", false);
}

void Reporter::add(const Outcome& outcome) {
    for (const std::string& warning : outcome.warnings)
        printOnce("lobe: warning: " + warning, false);
    if (outcome.error) {
        ++failed_;
        if (!firstError_) firstError_ = outcome.error;
        printOnce("lobe: error: " + outcome.message, true);
    } else if (outcome.skipped) {
        ++skipped_;
        if (verbosity_ == Verbosity::verbose || !terminal_)
            print("skipped " + outcome.shot.output + ": already there, made the same way", false);
    } else {
        addDone(outcome);
    }
    if (json_) {
        const std::string line = toJson(outcome, backend_, renderer_) + "\n";
        if (std::fwrite(line.data(), 1, line.size(), stdout) != line.size() || std::fflush(stdout) != 0)
            throw OutputError(std::string("standard output: can't be written: ") + std::strerror(errno));
    }
    drawBar();
}

ExitCode Reporter::finish(bool interrupted) {
    clearBar();
    const size_t missing = shots_ - done_ - failed_ - skipped_;
    if (shots_ > 1 || interrupted) {
        std::string summary = std::to_string(done_) + " of " + std::to_string(shots_) + " pictures written";
        if (skipped_ > 0) summary += ", " + std::to_string(skipped_) + " were there";
        if (failed_ > 0) summary += ", " + std::to_string(failed_) + " failed";
        if (nonFinite_ > 0) summary += ", " + std::to_string(nonFinite_) + " with NaN or infinity";
        if (interrupted) summary += ", interrupted with " + std::to_string(missing) + " to go";
        print(summary, failed_ > 0 || interrupted);
    }
    if (firstError_) return *firstError_;
    return nonFinite_ > 0 ? ExitCode::nonFinite : ExitCode::ok;
}

}  // namespace lobe::app
