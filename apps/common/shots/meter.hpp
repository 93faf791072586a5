/// A line on a terminal that says how far something is; nothing elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace lobe::app {

class Meter {
public:
    explicit Meter(bool wanted);
    ~Meter() { clear(); }
    Meter(const Meter&) = delete;
    Meter& operator=(const Meter&) = delete;
    /// `done`: 0 to 1. At most ten times a second.
    void show(double done, const std::string& what);
    void clear();

private:
    bool shown_ = false, wanted_;
    std::chrono::steady_clock::time_point last_{};
};

/// 0.00213 as "0.21 %".
std::string shortPercent(double share);

}  // namespace lobe::app
