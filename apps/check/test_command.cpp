#include "commands.hpp"

namespace lobe::app {

int testCommand(const std::vector<std::string>&) {
    return 0;
}

}  // namespace lobe::app
