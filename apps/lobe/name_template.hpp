/// Output names: "out/{model}_{n:3}.png".
#pragma once

#include <map>
#include <string>

namespace lobe::app {

/// Replaces {name}, {name:digits} (zero-padded numbers), {{ and }}, and runs of # by the running number n. Throws
/// UsageError that names the unknown name or the unclosed brace.
std::string expandTemplate(const std::string& text, const std::map<std::string, std::string>& values);

/// Today's date as 2026-01-31.
std::string today();

}  // namespace lobe::app
