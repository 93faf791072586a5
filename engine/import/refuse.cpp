#include "import/refuse.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace lobe {

namespace {
constexpr size_t kShownLength = 80;  // characters of a foreign value in a message
}

void refuse(const std::string& file, const std::string& property, const std::string& value,
            const std::string& expectation) {
    throw InputError(file + ": " + property + ": " + shown(value) + "; expected " + expectation);
}

void refuse(const std::string& file, const std::string& property, double value,
            const std::string& expectation) {
    char text[32];
    (void)std::snprintf(text, sizeof text, "%.9g", value);
    refuse(file, property, std::string(text), expectation);
}

std::string shown(const nlohmann::json& value) {
    return shown(value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}

std::string shown(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            c = ' ';
        }
    }
    if (text.size() > kShownLength) {
        text.resize(kShownLength - 3);
        text += "...";
    }
    return text;
}

std::string at(const std::string& name, size_t index) {
    return name + "[" + std::to_string(index) + "]";
}

std::string at(const std::string& name, size_t index, const std::string& member) {
    return at(name, index) + "." + member;
}

}  // namespace lobe
