#include "shading/brdf_header.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <regex>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe {
namespace {

constexpr const char* kMark = "///";
constexpr const char* kTakes[] = {"base colour", "roughness", "metallic"};

std::string trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

std::optional<double> parsedNumber(std::string_view text) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) return {};
    return value;
}

std::string camelCase(const std::string& snake) {
    std::string camel;
    for (size_t i = 0; i < snake.size(); ++i) {
        const bool starts = snake[i] == '_' && i + 1 < snake.size();
        if (starts) ++i;
        camel += starts ? static_cast<char>(std::toupper(static_cast<unsigned char>(snake[i]))) : snake[i];
    }
    return camel;
}

std::vector<std::string> splitAtCommas(std::string_view text) {
    std::vector<std::string> parts;
    while (!text.empty()) {
        const size_t comma = std::min(text.find(','), text.size());
        if (std::string part = trimmed(text.substr(0, comma)); !part.empty())
            parts.push_back(std::move(part));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return parts;
}

/// One line under "params", its continuation lines joined to it.
class ParameterLine {
public:
    ParameterLine(std::string text, const std::string& file, int line)
        : text_(std::move(text)), file_(file), line_(line) {}

    void append(const std::string& more) { text_ += " " + more; }

    HeaderParameter parse() const {
        constexpr size_t kLongest = 1000;
        if (text_.size() > kLongest) refuse("longer than " + std::to_string(kLongest) + " letters");
        std::smatch match;
        if (!std::regex_match(text_, match, std::regex("([a-z][a-z0-9_]*) +(\\S.*)")))
            refuse("'" + text_ +
                   "'; expected NAME and a range or choices, as 'shininess  0..1e6  no unit: exponent'");
        HeaderParameter result;
        result.line = line_;
        Parameter& parameter = result.parameter;
        parameter.glslName = match[1];
        parameter.name = camelCase(parameter.glslName);
        std::string rest = match[2];
        if (const size_t colon = rest.find(": "); colon != std::string::npos) {
            parameter.description = trimmed(rest.substr(colon + 2));
            rest.resize(colon);
        }
        std::vector<std::string> attributes = splitAtCommas(rest);
        if (rest.starts_with("0 "))
            takeChoices(parameter, attributes);
        else
            takeRange(parameter, attributes);
        // Kind first: how many numbers a default has depends on it.
        if (std::erase(attributes, "per channel") > 0) parameter.kind = ParameterKind::rgb;
        for (const std::string& attribute : attributes)
            apply(result, attribute);
        if (!result.hasDefault && parameter.kind != ParameterKind::choice)
            parameter.defaultValue = glm::dvec3(std::clamp(0.5, parameter.minimum, parameter.maximum));
        return result;
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError(file_ + ":" + std::to_string(line_) + ": params: " + what);
    }

    static void takeChoices(Parameter& parameter, std::vector<std::string>& attributes) {
        size_t count = 0;
        for (std::smatch match; count < attributes.size(); ++count) {
            if (!std::regex_match(attributes[count], match, std::regex("(\\d+) ([a-z][a-z0-9_]*)")) ||
                match[1] != std::to_string(count))
                break;
            parameter.choices.push_back(match[2]);
        }
        attributes.erase(attributes.begin(), attributes.begin() + static_cast<std::ptrdiff_t>(count));
        parameter.kind = ParameterKind::choice;
        parameter.mayBeTextured = false;
        parameter.maximum = static_cast<double>(count) - 1.0;
    }

    /// "0..1" and what stands behind it, up to the first comma.
    void takeRange(Parameter& parameter, std::vector<std::string>& attributes) const {
        const std::string first = attributes.empty() ? "" : attributes.front();
        const size_t end = std::min(first.find(' '), first.size());
        const std::string range = first.substr(0, end);
        const size_t dots = range.find("..");
        const auto low = dots == std::string::npos ? std::nullopt : parsedNumber(range.substr(0, dots));
        const auto high = dots == std::string::npos ? std::nullopt : parsedNumber(range.substr(dots + 2));
        if (!low || !high || !(*low < *high))
            refuse(parameter.glslName + ": '" + range +
                   "'; expected a range, as 0..1, or choices, as 0 first, 1 second");
        parameter.minimum = *low;
        parameter.maximum = *high;
        attributes.front() = trimmed(first.substr(end));
        if (attributes.front().empty()) attributes.erase(attributes.begin());
    }

    void apply(HeaderParameter& result, const std::string& attribute) const {
        Parameter& parameter = result.parameter;
        const bool isChoice = parameter.kind == ParameterKind::choice;
        if (attribute == "no unit") return;
        if (attribute.starts_with("first row of the table")) {
            parameter.kind = ParameterKind::table;
            parameter.mayBeTextured = false;
        } else if (attribute.starts_with("default ")) {
            setDefault(parameter, attribute.substr(8));
            result.hasDefault = true;
        } else if (attribute == "sRGB" && parameter.kind == ParameterKind::rgb) {
            parameter.textureIsSrgb = true;
        } else if (attribute == "untextured" && !isChoice) {
            parameter.mayBeTextured = false;
        } else if (attribute.starts_with("takes ")) {
            setTakes(result, attribute.substr(6));
        } else if (!isChoice && parameter.unit == "1" &&
                   std::regex_match(attribute, std::regex("[A-Za-z/^0-9]{1,12}"))) {
            parameter.unit = attribute;
        } else {
            refuse(parameter.glslName + ": '" + attribute +
                   "'; expected per channel, no unit or a unit, default VALUE, sRGB (per channel only), "
                   "untextured, "
                   "takes base colour, takes roughness or takes metallic");
        }
    }

    void setDefault(Parameter& parameter, const std::string& text) const {
        if (parameter.kind == ParameterKind::choice) {
            const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), text);
            if (found == parameter.choices.end())
                refuse(parameter.glslName + ": default '" + text + "'; expected one of its choices" +
                       didYouMean(text, parameter.choices));
            parameter.defaultValue.x = static_cast<double>(found - parameter.choices.begin());
            return;
        }
        std::vector<double> values;
        for (size_t start = 0; start < text.size();) {
            const size_t end = std::min(text.find(' ', start), text.size());
            const auto value = parsedNumber(std::string_view(text).substr(start, end - start));
            if (!value || !(*value >= parameter.minimum && *value <= parameter.maximum)) {
                values.clear();
                break;
            }
            values.push_back(*value);
            start = end + 1;
        }
        const bool rgb = parameter.kind == ParameterKind::rgb;
        if (values.size() != 1 && !(rgb && values.size() == 3))
            refuse(parameter.glslName + ": default '" + text + "'; expected " +
                   (rgb ? "one number or three within its range" : "a number within its range"));
        for (int c = 0; c < 3; ++c)
            parameter.defaultValue[c] = values.size() == 3 ? values[static_cast<size_t>(c)] : values[0];
    }

    void setTakes(HeaderParameter& result, const std::string& what) const {
        const ParameterKind kind = what == kTakes[0] ? ParameterKind::rgb : ParameterKind::scalar;
        if (std::find(std::begin(kTakes), std::end(kTakes), what) == std::end(kTakes) ||
            result.parameter.kind != kind || !result.takes.empty())
            refuse(result.parameter.glslName + ": takes " + what +
                   "; expected base colour (per channel), roughness or metallic (a number), and one of them");
        result.takes = what;
    }

    std::string text_;
    const std::string& file_;
    int line_;
};

}  // namespace

BrdfHeader parseBrdfHeader(std::string_view text, const std::string& file) {
    BrdfHeader header;
    std::vector<ParameterLine> lines;
    std::string key;
    size_t nameColumn = 0;
    int number = 1;
    for (; !text.empty() && !text.starts_with(kMark); ++number)  // a licence may stand above
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    for (const int first = number; text.starts_with(kMark); ++number) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::string content = trimmed(line.substr(3));
        if (content.empty()) continue;
        const size_t column = line.find_first_not_of(" \t", 3);
        std::string value = content;
        if (number == first) {
            const size_t dash = content.find(" - ");
            const std::string title = dash == std::string::npos ? content : content.substr(dash + 3);
            header.title = title.substr(0, title.find(". "));
            if (header.title.ends_with('.')) header.title.pop_back();
            continue;
        }
        if (column == 4) {  // "/// key  text"
            const size_t space = std::min(content.find(' '), content.size());
            key = content.substr(0, space);
            value = trimmed(content.substr(space));
            nameColumn = value.empty() ? 0 : line.find(value, column + space);
            header.keys[key];
        }
        if (key == "params") {
            const size_t start = column == 4 ? nameColumn : column;
            if (value.empty()) continue;
            if (start > nameColumn && nameColumn > 0 && !lines.empty())
                lines.back().append(value);
            else
                lines.emplace_back(value, file, number);
            if (nameColumn == 0) nameColumn = start;
        } else if (!key.empty()) {
            std::string& all = header.keys[key];
            all += (all.empty() ? "" : " ") + value;
        }
        if (key == "sharpness" && column == 4) {
            header.sharpness = parsedNumber(value);
            if (!header.sharpness || *header.sharpness < 0.0)
                throw InputError(
                    file + ":" + std::to_string(number) + ": sharpness '" + value +
                    "'; expected the largest |d ln f / d theta_h|, in 1/rad, as a number from 0");
        }
    }
    for (const ParameterLine& line : lines)
        header.parameters.push_back(line.parse());
    return header;
}

}  // namespace lobe
