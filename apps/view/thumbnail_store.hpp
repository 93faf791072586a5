/// Small pictures of scene files, kept between runs.
#pragma once

#include <filesystem>

#include "image/image_files.hpp"

namespace lobe::view {

class ThumbnailStore {
public:
    /// In the cache folder of the user (base/resources.hpp); without one nothing is kept.
    ThumbnailStore();

    /// The picture of the file as it is now, or an empty one.
    Bitmap find(const std::filesystem::path& scene, ImageFiles& files) const;
    /// Failing to keep it is no error.
    void keep(const std::filesystem::path& scene, const Bitmap& bitmap, ImageFiles& files) const;

private:
    std::filesystem::path fileOf(const std::filesystem::path& scene) const;
    std::filesystem::path folder_;
};

}  // namespace lobe::view
