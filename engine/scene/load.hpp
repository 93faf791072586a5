/// From a .gltf or .glb file to a Scene.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/image_files.hpp"
#include "scene/scene.hpp"
#include "shading/brdf_file.hpp"

namespace lobe {

enum class NormalsMode : uint8_t {
    asFile,  ///< the file's; where absent, flat, as glTF says
    smooth,  ///< where absent, averaged over nearby facets (crease angle 60 degrees, weighted by angle)
    flat     ///< always flat
};

struct LoadOptions {
    double time = 0.0;  ///< seconds; all animations are posed at it (clamped to each one's end)
    NormalsMode normals = NormalsMode::asFile;
    std::vector<BrdfSource> brdfs = {};  ///< models from files, which the scene may name as well
};

/// Reads, validates and poses a scene. The file is parsed in lobe-scene-worker and its images are decoded in
/// lobe-image-worker, so no file can crash, hang or bloat the caller. Throws InputError that names file,
/// property, value and expectation. A scene object may be used for many loads; one thread at a time.
class SceneLoader {
public:
    SceneLoader();
    ~SceneLoader();
    Scene load(const std::filesystem::path& file, const LoadOptions& options = {});

private:
    struct Workers;
    std::unique_ptr<Workers> workers_;
};

}  // namespace lobe
