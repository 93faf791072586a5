/// Textures and images, read only as far as materials use them.
#pragma once

#include <map>
#include <vector>

#include "import/document.hpp"
#include "import/import.hpp"

namespace lobe {

/// Collects the textures that the scene's materials refer to, in the order in which they do.
class TextureTable {
public:
    explicit TextureTable(Document& document) : document_(document) {}

    /// The scene's index of a glTF texture, or -1 (with a warning) if it has no image. Throws InputError if
    /// the image can't be read.
    int use(int gltfTexture);

    /// The index in `images` of a file beside the scene that is none of glTF's images. `property` says where
    /// the scene names it. Throws InputError if it can't be read.
    int addFile(const std::string& uri, const std::string& property);

    /// The scene's index of a texture that shows an image, by its index in `images`, up to its edges.
    int addTexture(int image);

    /// The index in `images` of one of glTF's images that no texture shares. Throws InputError if it can't be
    /// read.
    int addOwn(size_t gltfImage);

    std::vector<Texture> textures;
    std::vector<EncodedImage> images;

private:
    int addImage(int gltfImage, int fallback);
    Sampler sampler(int gltfSampler) const;

    Document& document_;
    std::map<int, int> textureIndex_;
    std::map<int, int> imageIndex_;
};

/// "images[2] (albedo.png)".
std::string imageName(const Document& document, size_t image);

}  // namespace lobe
