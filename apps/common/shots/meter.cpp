#include "meter.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace lobe::app {

Meter::Meter(bool wanted) : wanted_(wanted && isatty(STDERR_FILENO) != 0) {}

void Meter::show(double done, const std::string& what) {
    const auto now = std::chrono::steady_clock::now();
    if (!wanted_ || (shown_ && now - last_ < std::chrono::milliseconds(100))) return;
    last_ = now;
    shown_ = true;
    std::cerr << "\r\033[K" << static_cast<int>(done * 100.0) << " % " << what << std::flush;
}

void Meter::clear() {
    if (shown_) std::cerr << "\r\033[K" << std::flush;
    shown_ = false;
}

std::string shortPercent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g %%", share * 100.0);
    return text;
}

}  // namespace lobe::app
