#include "harness/unit/test_function.hpp"

#include <regex>
#include <sstream>

#include "base/error.hpp"

namespace lobe::harness {
namespace {

/// Without comments, on one line; as much as a head can be.
std::string textFrom(const std::vector<std::string>& lines, size_t first) {
    std::string text;
    for (size_t i = first; i < lines.size() && i < first + 40; ++i)
        text += lines[i].substr(0, lines[i].find("//")) + " ";
    return std::regex_replace(text, std::regex(R"(/\*.*?\*/)"), " ");
}

}  // namespace

FunctionHead readFunctionHead(const std::vector<std::string>& lines, size_t first, const SourcePlace& place) {
    while (first < lines.size() && lines[first].find_first_not_of(" \t\r") == std::string::npos)
        ++first;
    static const std::regex head(R"(^\s*(?:(?:highp|mediump|lowp)\s+)?(\w+)\s+(\w+)\s*\(([^(){};]*)\)\s*\{)");
    static const std::regex parameter(R"(^\s*(?:(?:const|in|highp|mediump|lowp)\s+)*(\w+)\s+(\w+)\s*$)");
    const std::string text = textFrom(lines, first);
    std::smatch match;
    if (!std::regex_search(text, match, head))
        throw InputError(place.text() +
                         ": no function follows the test's directives; expected one such as "
                         "'float test(float x) { ... }'");
    FunctionHead result{match[1], match[2], {}, static_cast<int>(first) + 1};
    std::istringstream list(match[3].str());
    for (std::string one; std::getline(list, one, ',');) {
        std::smatch parts;
        if (one.find_first_not_of(' ') == std::string::npos || one == "void") continue;
        if (!std::regex_match(one, parts, parameter))
            throw InputError(place.file + ":" + std::to_string(result.line) + ": " + result.name +
                             ": parameter '" + one + "'; expected a type and a name");
        result.parameters.emplace_back(parts[1], parts[2]);
    }
    return result;
}

}  // namespace lobe::harness
