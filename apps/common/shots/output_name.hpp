/// Names of pictures: "out/{model}_{n:3}.png".
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "shots.hpp"

namespace lobe::app {

/// Replaces {name}, {name:digits} (zero-padded numbers), {{ and }}, and runs of # by the running number n.
/// Throws UsageError that names the unknown name or the unclosed brace.
std::string expandTemplate(const std::string& text, const std::map<std::string, std::string>& values);

/// Today's date as 2026-01-31.
std::string today();

/// ".png" of "A.PNG".
std::string lowerExtension(const std::filesystem::path& path);

/// Fills in output names. Throws UsageError for two shots with one name, an unknown extension, layers or
/// transparency in a format without them.
void nameOutputs(std::vector<Shot>& shots);

}  // namespace lobe::app
