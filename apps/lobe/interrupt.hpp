/// Ctrl-C and SIGTERM for commands that work for long.
#pragma once

#include <atomic>

namespace lobe::app {

inline constexpr int kInterruptedExit = 130;

/// From now on the first signal sets the flag that is returned, and a second one ends the program at once.
const std::atomic<bool>& catchInterrupts();

}  // namespace lobe::app
