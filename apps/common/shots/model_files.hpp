/// The models that this run loads from GLSL files (setting brdf_file), each file once.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "settings.hpp"
#include "shading/brdf_file.hpp"

namespace lobe::app {

/// Reads a file and registers its model; nothing if it is registered already. Before threads use the
/// registry. Throws InputError, UsageError, and ShaderError for includes that cannot be found.
void loadModelFile(const std::string& file);

/// Reads all files that are registered again, and registers what they are now. Throws as above, and then
/// changes nothing.
void rereadModelFiles();

/// The names of the models of the setting's files.
std::vector<std::string> modelNamesOf(const Settings& settings);
/// Their sources.
std::vector<BrdfSource> modelSourcesOf(const Settings& settings);
/// Name -> fingerprint of the file with all that it includes.
nlohmann::json modelHashesOf(const Settings& settings);

/// A settings object in which the files of brdf_file, where relative, are those of `folder`.
nlohmann::json withFilesIn(const std::filesystem::path& folder, nlohmann::json settings);

}  // namespace lobe::app
