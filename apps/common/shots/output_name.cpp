#include "output_name.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "image/image_files.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string padded(const std::string& value, size_t digits) {
    return value.size() < digits ? std::string(digits - value.size(), '0') + value : value;
}

/// A value as part of a file's name: a camera called "a/b" makes no folder.
std::string asName(std::string value) {
    for (char& c : value)
        if (c == '/' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
    return value;
}

std::string field(const std::string& inside, const std::string& text,
                  const std::map<std::string, std::string>& values) {
    const size_t colon = inside.find(':');
    const std::string name = inside.substr(0, colon);
    const auto found = values.find(name);
    if (found == values.end()) {
        std::vector<std::string> names;
        names.reserve(values.size());
        for (const auto& [known, value] : values)
            names.push_back(known);
        throw UsageError("output '" + text + "': unknown field {" + name + "}" + didYouMean(name, names));
    }
    if (colon == std::string::npos) return asName(found->second);
    const std::string digits = inside.substr(colon + 1);
    if (digits.empty() || digits.size() > 2 || digits.find_first_not_of("0123456789") != std::string::npos)
        throw UsageError("output '" + text + "': {" + inside +
                         "}; expected a number of digits after the colon");
    if (found->second.find_first_not_of("0123456789") != std::string::npos)
        throw UsageError("output '" + text + "': {" + inside + "}; " + name +
                         " is no number that digits could pad");
    return padded(found->second, std::stoul(digits));
}

std::string textOf(const Settings& settings, const char* key, const char* absent) {
    const json& value = settings.get(key);
    return value.is_string() ? value.get<std::string>() : absent;
}

bool contains(const std::vector<std::string>& list, const std::string& text) {
    return std::find(list.begin(), list.end(), text) != list.end();
}

void requireKnownFormat(const Settings& settings, const std::string& output, const std::string& extension) {
    const bool display = contains(ImageFiles::displayExtensions(), extension);
    if (!display && !contains(ImageFiles::linearExtensions(), extension))
        throw UsageError("output '" + output + "': extension '" + extension +
                         "'; expected .png, .jpg, .exr or .hdr");
    const json& aovs = settings.get("aov");
    if (extension != ".exr" && aovs != json{"radiance"})
        throw UsageError("output '" + output + "': aov " + aovs.dump() +
                         "; expected an .exr file, the only format with layers");
    if (display && extension != ".png" && backgroundOf(settings).transparent)
        throw UsageError("output '" + output + "': background transparent; expected a .png file");
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
            if (close == std::string::npos)
                throw UsageError("output '" + text + "': '{' without '}'; write {{ for a brace");
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

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    localtime_r(&now, &parts);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts);
    return text.data();
}

void nameOutputs(std::vector<Shot>& shots) {
    std::map<fs::path, const Shot*> taken;
    const std::string date = today();
    for (Shot& shot : shots) {
        const Settings& settings = *shot.settings;
        const bool turntable = settings.get("frames").get<int>() > 1;
        const std::string given =
            textOf(settings, "output", turntable ? "out/{model}_{frame:4}.png" : "out/{model}.png");
        if (given == "-") {
            if (shots.size() > 1)
                throw UsageError("output '-': " + std::to_string(shots.size()) + " pictures; expected one");
            shot.output = given;
            requireKnownFormat(settings, "-", ".png");
            continue;
        }
        shot.output = expandTemplate(given, {{"model", shot.scene.stem().string()},
                                             {"camera", textOf(settings, "camera", "default")},
                                             {"n", std::to_string(shot.number)},
                                             {"frame", std::to_string(shot.frame)},
                                             {"date", date},
                                             {"brdf", textOf(settings, "brdf", "own")},
                                             {"quality", textOf(settings, "quality", "")}});
        requireKnownFormat(settings, shot.output, lowerExtension(shot.output));
        const auto [other, isNew] = taken.emplace(fs::absolute(shot.output).lexically_normal(), &shot);
        if (!isNew)
            throw UsageError("output '" + shot.output + "' is the name of two pictures (" +
                             other->second->scene.string() + " and " + shot.scene.string() + "); add {n:3}" +
                             (turntable ? " or {frame:4}" : "") + " to the name");
    }
}

}  // namespace lobe::app
