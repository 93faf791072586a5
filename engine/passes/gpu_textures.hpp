/// A scene's images as OpenGL textures, in the format that the plan's quality and the driver's accuracy ask
/// for.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "gl/objects.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// Texels ready for upload.
struct TexelData {
    GLenum internalFormat = 0;
    GLenum type = 0;   ///< GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_FLOAT
    int channels = 0;  ///< 1, 2 or 4, as stored in `data`
    std::vector<std::byte> data;
};

/// Converts a bitmap for filtering at `bits` a component. sRGB texels stay encoded only at 8 bits and only
/// where `exactSrgbDecode` (hardware); llvmpipe's decode is off by up to 2.5 % in the darks, so they are
/// decoded here.
TexelData texelsFor(const Bitmap& bitmap, bool srgb, int bits, bool exactSrgbDecode);

class GpuTextures {
public:
    GpuTextures(const Scene& scene, int bits, const Capabilities& capabilities);

    /// Binds a texture slot of a material to a unit; uploads its image at first use. Throws InputError if the
    /// driver's largest texture is smaller.
    void bind(int unit, const TextureSlot& slot, bool srgb);

    /// Takes the uploads of another, which was made with the same bits, of a scene with the same images.
    void adopt(GpuTextures&& other);

private:
    GLuint imageTexture(int image, bool srgb);
    GLuint samplerObject(const Sampler& sampler);

    const Scene& scene_;
    int bits_;
    Capabilities capabilities_;
    std::map<std::pair<int, bool>, gl::Texture> images_;
    std::vector<std::pair<Sampler, gl::Sampler>> samplers_;
    gl::Texture white_;  ///< stands for a texture without an image
};

}  // namespace lobe
