/// The head of a GLSL function, as far as tests need it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/unit/directive_reader.hpp"

namespace lobe::harness {

struct FunctionHead {
    std::string result, name;
    std::vector<std::pair<std::string, std::string>> parameters;  ///< type and name
    int line = 0;
};

/// The function that starts at or after `lines[first]`, with only blank lines and comments before it. Throws
/// InputError if something else stands there.
FunctionHead readFunctionHead(const std::vector<std::string>& lines, size_t first, const SourcePlace& place);

}  // namespace lobe::harness
