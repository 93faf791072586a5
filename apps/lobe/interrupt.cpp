#include "interrupt.hpp"

#include <csignal>
#include <cstdlib>

namespace lobe::app {
namespace {

std::atomic<bool> interrupted = false;

void interrupt(int) {
    if (interrupted.exchange(true)) std::_Exit(kInterruptedExit);
}

}  // namespace

const std::atomic<bool>& catchInterrupts() {
    std::signal(SIGINT, interrupt);
    std::signal(SIGTERM, interrupt);
    std::signal(SIGPIPE, SIG_IGN);
    return interrupted;
}

}  // namespace lobe::app
