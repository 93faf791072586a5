/// What SceneLoader and lobe-scene-worker say to each other.
#pragma once

#include <string>
#include <vector>

#include "base/worker.hpp"
#include "scene/load.hpp"

namespace lobe {

struct LoadRequest {
    std::filesystem::path file;
    LoadOptions options;
};

/// An image, still encoded, among the others in one block of memory.
struct PackedImage {
    std::string name;
    size_t offset = 0;
    size_t size = 0;
    int fallback = -1;  ///< index of the image to take if this one can't be decoded
};

struct LoadReply {
    Scene scene;  ///< without images
    std::vector<PackedImage> images;
    SharedMemory pictures;
};

Message writeLoadRequest(const LoadRequest& request);
LoadRequest readLoadRequest(const Message& message);  ///< throws InputError
Message writeLoadReply(const Scene& scene, const std::vector<PackedImage>& images, SharedMemory pictures);
LoadReply readLoadReply(Message message);  ///< throws InputError

}  // namespace lobe
