/// Tells people and programs how a batch goes: a bar on a terminal, plain lines elsewhere, one JSON object a
/// shot.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <string>

#include "outcome.hpp"

namespace lobe::app {

enum class Verbosity { quiet, normal, verbose };

/// One thread at a time.
class Reporter {
public:
    Reporter(size_t shots, bool json, Verbosity verbosity);
    void setContext(const std::string& backend, const std::string& renderer);
    /// Throws OutputError when standard output does not take the JSON.
    void add(const Outcome& outcome);
    /// Ends the bar and prints the summary. Returns the exit code of the whole: that of the first shot that
    /// failed, 6 if only non-finite pixels were found, else 0.
    ExitCode finish(bool interrupted);

private:
    void clearBar();
    void drawBar();
    void print(const std::string& line, bool important);
    void printOnce(const std::string& line, bool important);
    void addDone(const Outcome& outcome);

    size_t shots_;
    bool json_;
    Verbosity verbosity_;
    bool terminal_;
    bool barShown_ = false;
    size_t done_ = 0, failed_ = 0, skipped_ = 0, nonFinite_ = 0;
    std::optional<ExitCode> firstError_;
    std::set<std::string> printed_;
    std::string backend_, renderer_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace lobe::app
