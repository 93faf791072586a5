/// The commands of lobe-check; each takes the arguments after its name and returns the exit code.
#pragma once

#include <string>
#include <vector>

namespace lobe::app {

/// `lobe-check PATH...`: runs the tests in GLSL files.
int testCommand(const std::vector<std::string>& arguments);
/// `lobe-check eval`: evaluates a GLSL function or a model over a table.
int evalCommand(const std::vector<std::string>& arguments);
/// `lobe-check models`: every registered model's GLSL against its twin.
int modelsCommand(const std::vector<std::string>& arguments);

}  // namespace lobe::app
