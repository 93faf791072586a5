/// What the programs' main() functions share.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace lobe::app {

/// Calls `run` with the arguments and returns its exit code; turns what it throws into one line on standard
/// error ("NAME: error: ...") and the documented code.
int runProgram(const std::string& name, int argc, char** argv,
               const std::function<int(const std::vector<std::string>&)>& run);

/// "NAME VERSION", and what it was built with.
void printVersion(const std::string& name);

}  // namespace lobe::app
