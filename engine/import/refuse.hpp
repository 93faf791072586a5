/// One-line refusals of what a scene file says: "FILE: PROPERTY: VALUE; expected EXPECTATION".
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lobe {

/// Throws InputError.
[[noreturn]] void refuse(const std::string& file, const std::string& property, const std::string& value,
                         const std::string& expectation);
[[noreturn]] void refuse(const std::string& file, const std::string& property, double value,
                         const std::string& expectation);

/// A JSON value as it stands in a message: on one line, shortened.
std::string shown(const nlohmann::json& value);
std::string shown(std::string text);

/// "NAME[INDEX]" and "NAME[INDEX].MEMBER".
std::string at(const std::string& name, size_t index);
std::string at(const std::string& name, size_t index, const std::string& member);

}  // namespace lobe
