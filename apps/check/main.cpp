// lobe-check: tests GLSL, without a window. Errors are one line on standard error and a documented exit code.
#include <iostream>

#include "commands.hpp"
#include "program.hpp"

namespace {

int run(const std::vector<std::string>& arguments) {
    const std::string first = arguments.empty() ? "" : arguments[0];
    if (first == "--version") {
        lobe::app::printVersion("lobe-check");
        return 0;
    }
    const std::vector<std::string> rest(arguments.begin() + (arguments.empty() ? 0 : 1), arguments.end());
    if (first == "eval") return lobe::app::evalCommand(rest);
    if (first == "models") return lobe::app::modelsCommand(rest);
    return lobe::app::testCommand(arguments);
}

}  // namespace

int main(int argc, char** argv) {
    return lobe::app::runProgram("lobe-check", argc, argv, run);
}
