/// The edited scene as glTF with Lobe's extensions, and the state as settings.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "edits.hpp"

namespace lobe::view {

struct Viewer;

struct EditedGltf {
    nlohmann::ordered_json gltf;
    std::vector<std::pair<std::filesystem::path, std::string>>
        files;  ///< to copy; to where, beside the result
};

/// The file's own JSON with the edited materials and lights in place of its own. Geometry and pictures are
/// those of the file; what they are in goes into `folder` beside the result. Throws InputError for a file
/// that cannot be read or whose buffers are inside it (.glb), UsageError for tables.
EditedGltf editedGltf(const std::filesystem::path& source, const Scene& scene, const Edits& edits,
                      const std::string& folder);

void exportEdited(Viewer& viewer, const std::filesystem::path& file);
/// The settings, for `lobe render --settings`; where something was edited, the edited scene beside them.
void saveState(Viewer& viewer, const std::filesystem::path& file);

}  // namespace lobe::view
