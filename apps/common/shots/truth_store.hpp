/// True pictures, kept between runs.
#pragma once

#include <filesystem>
#include <string>

#include "image/image_files.hpp"
#include "reference/truth.hpp"

namespace lobe::app {

/// What a truth is of: a hash of the scene as it is drawn, camera, size, filter and version. Not how exact it
/// is: a more exact one goes on from a less exact one.
std::string truthKey(const Scene& scene, const Camera& camera, const reference::TruthRequest& request);

/// A folder of EXR files, one a key. Files that are damaged or of other layout count as absent.
class TruthStore {
public:
    /// In $XDG_CACHE_HOME/lobe/truth, else ~/.cache/lobe/truth; without a home nothing is kept.
    TruthStore();
    explicit TruthStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// The picture so far, or an empty image.
    Image find(const std::string& key, ImageFiles& files) const;
    /// Failing to keep it is a warning on standard error, once, and no error.
    void keep(const std::string& key, const Image& image, ImageFiles& files);

private:
    std::filesystem::path fileOf(const std::string& key) const { return folder_ / (key + ".exr"); }
    std::filesystem::path folder_;
    bool warned_ = false;
};

}  // namespace lobe::app
