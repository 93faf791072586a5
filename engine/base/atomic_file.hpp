#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace lobe {

/// Writes a file so that it appears whole or not at all: `write` gets a temporary path in the same folder
/// (with the same extension), which is flushed to disk and renamed over `target` when `write` returns, and
/// removed when it throws. Missing folders are made, links are followed, devices and pipes are written to in
/// place. Throws OutputError that names the file and the reason (no permission, no space, ...).
void writeAtomically(const std::filesystem::path& target,
                     const std::function<void(const std::filesystem::path&)>& write);

void writeAtomically(const std::filesystem::path& target, std::string_view text);

}  // namespace lobe
