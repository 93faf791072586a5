#include "commands.hpp"

namespace lobe::app {

int modelsCommand(const std::vector<std::string>&) {
    return 0;
}

}  // namespace lobe::app
