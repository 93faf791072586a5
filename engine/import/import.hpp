/// glTF 2.0 to Scene through tinygltf, in this process. Only the scene worker and tests call this; everybody
/// else goes through scene/load.hpp.
#pragma once

#include <filesystem>

#include "scene/load.hpp"

namespace lobe {

/// An image that the scene refers to, still encoded.
struct EncodedImage {
    std::string name;  ///< for messages: "images[2] (albedo.png)"
    std::vector<std::byte> bytes;
    int fallback = -1;  ///< index of another EncodedImage to take if this one can't be decoded
};

struct Imported {
    Scene scene;  ///< images empty; Texture::image indexes `images`
    std::vector<EncodedImage> images;
};

/// Throws InputError. Never returns a scene that breaks an invariant of scene.hpp.
Imported importGltf(const std::filesystem::path& file, const LoadOptions& options);

/// The scene worker's request handler.
Message serveImport(const Message& request);

}  // namespace lobe
