#include "name_template.hpp"

#include <ctime>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::app {
namespace {

std::string padded(const std::string& value, size_t digits) {
    return value.size() < digits ? std::string(digits - value.size(), '0') + value : value;
}

std::string field(const std::string& inside, const std::string& text, const std::map<std::string, std::string>& values) {
    const size_t colon = inside.find(':');
    const std::string name = inside.substr(0, colon);
    const auto found = values.find(name);
    if (found == values.end()) {
        std::vector<std::string> names;
        for (const auto& [known, value] : values)
            names.push_back(known);
        throw UsageError("output '" + text + "': unknown field {" + name + "}" + didYouMean(name, names));
    }
    if (colon == std::string::npos) return found->second;
    const std::string digits = inside.substr(colon + 1);
    if (digits.empty() || digits.size() > 2 || digits.find_first_not_of("0123456789") != std::string::npos)
        throw UsageError("output '" + text + "': {" + inside + "}; expected a number of digits after the colon");
    return padded(found->second, std::stoul(digits));
}

}  // namespace

std::string expandTemplate(const std::string& text, const std::map<std::string, std::string>& values) {
    std::string result;
    for (size_t i = 0; i < text.size();) {
        const char c = text[i];
        if ((c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c) {
            result += c;
            i += 2;
        } else if (c == '{') {
            const size_t close = text.find('}', i);
            if (close == std::string::npos) throw UsageError("output '" + text + "': '{' without '}'; write {{ for a brace");
            result += field(text.substr(i + 1, close - i - 1), text, values);
            i = close + 1;
        } else if (c == '}') {
            throw UsageError("output '" + text + "': '}' without '{'; write }} for a brace");
        } else if (c == '#') {
            const size_t end = std::min(text.find_first_not_of('#', i), text.size());
            result += padded(values.at("n"), end - i);
            i = end;
        } else {
            result += c;
            ++i;
        }
    }
    return result;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    localtime_r(&now, &parts);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
    return text;
}

}  // namespace lobe::app
