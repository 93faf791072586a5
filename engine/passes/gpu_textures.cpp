#include "passes/gpu_textures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "image/tone.hpp"

namespace lobe {
namespace {

/// Linear value of each 8-bit sRGB code.
const std::array<float, 256>& srgbTable() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = decodeSrgb(static_cast<float>(i) / 255.0f);
        return values;
    }();
    return table;
}

float component(const Bitmap& bitmap, size_t index) {
    switch (bitmap.type) {
        case ComponentType::u8:
            return static_cast<float>(std::to_integer<unsigned>(bitmap.data[index])) / 255.0f;
        case ComponentType::u16: {
            uint16_t value;
            std::memcpy(&value, bitmap.data.data() + index * 2, 2);
            return static_cast<float>(value) / 65535.0f;
        }
        case ComponentType::f32: {
            float value;
            std::memcpy(&value, bitmap.data.data() + index * 4, 4);
            return value;
        }
    }
    return 0.0f;
}

GLenum internalFormatOf(int channels, int bits, bool srgb) {
    static const std::map<std::pair<int, int>, GLenum> formats = {
        {{1, 8}, GL_R8},    {{2, 8}, GL_RG8},    {{4, 8}, GL_RGBA8},
        {{1, 16}, GL_R16},  {{2, 16}, GL_RG16},  {{4, 16}, GL_RGBA16},
        {{1, 32}, GL_R32F}, {{2, 32}, GL_RG32F}, {{4, 32}, GL_RGBA32F}};
    return srgb ? static_cast<GLenum>(GL_SRGB8_ALPHA8) : formats.at({channels, bits});
}

void store(TexelData& texels, size_t index, float value) {
    switch (texels.type) {
        case GL_UNSIGNED_BYTE:
            texels.data[index] = static_cast<std::byte>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
            break;
        case GL_UNSIGNED_SHORT: {
            const auto code = static_cast<uint16_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535.0f));
            std::memcpy(texels.data.data() + index * 2, &code, 2);
            break;
        }
        default:
            std::memcpy(texels.data.data() + index * 4, &value, 4);
    }
}

GLint wrapOf(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return GL_REPEAT;
        case Wrap::mirroredRepeat:
            return GL_MIRRORED_REPEAT;
        case Wrap::clampToEdge:
            break;
    }
    return GL_CLAMP_TO_EDGE;
}

GLint minifyOf(const Sampler& sampler) {
    const bool linear = sampler.minify == Filter::linear;
    switch (sampler.mip) {
        case MipFilter::none:
            return linear ? GL_LINEAR : GL_NEAREST;
        case MipFilter::nearest:
            return linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
        case MipFilter::linear:
            break;
    }
    return linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
}

}  // namespace

TexelData texelsFor(const Bitmap& bitmap, bool srgb, int bits, bool exactSrgbDecode) {
    const bool wideSource = bitmap.type != ComponentType::u8;
    const bool keepEncoded = srgb && bits == 8 && exactSrgbDecode && !wideSource && bitmap.channels >= 3;
    int storedBits = bitmap.type == ComponentType::f32 ? 32 : std::max(bits, wideSource ? 16 : 8);
    if (srgb && !keepEncoded) storedBits = std::max(storedBits, 16);

    TexelData texels;
    texels.channels = bitmap.channels == 3 ? 4 : bitmap.channels;
    texels.internalFormat = internalFormatOf(texels.channels, storedBits, keepEncoded);
    texels.type = storedBits == 8 ? GL_UNSIGNED_BYTE : storedBits == 16 ? GL_UNSIGNED_SHORT : GL_FLOAT;
    const size_t pixels = static_cast<size_t>(bitmap.width) * static_cast<size_t>(bitmap.height);
    const auto stored = static_cast<size_t>(texels.channels);
    const auto given = static_cast<size_t>(bitmap.channels);
    texels.data.resize(pixels * stored * static_cast<size_t>(storedBits / 8));
    if (storedBits == 8 && stored == given) {
        std::memcpy(texels.data.data(), bitmap.data.data(), texels.data.size());
        return texels;
    }
    const bool hasAlpha = given == 2 || given == 4;
    const bool decode = srgb && !keepEncoded && bitmap.type != ComponentType::f32;
    const auto& table = srgbTable();
    for (size_t i = 0; i < pixels; ++i)
        for (size_t c = 0; c < stored; ++c) {
            if (c >= given) {
                store(texels, i * stored + c, 1.0f);
                continue;
            }
            const size_t source = i * given + c;
            const bool isAlpha = hasAlpha && c == given - 1;
            float value;
            if (decode && !isAlpha)
                value = bitmap.type == ComponentType::u8 ? table[std::to_integer<size_t>(bitmap.data[source])]
                                                         : decodeSrgb(component(bitmap, source));
            else
                value = component(bitmap, source);
            store(texels, i * stored + c, value);
        }
    return texels;
}

GpuTextures::GpuTextures(const Scene& scene, int bits, const Capabilities& capabilities)
    : scene_(scene), bits_(bits), capabilities_(capabilities) {}

GLuint GpuTextures::imageTexture(int image, bool srgb) {
    const auto key = std::pair(image, srgb);
    if (const auto found = images_.find(key); found != images_.end()) return found->second.id();
    const Bitmap& bitmap = scene_.images[static_cast<size_t>(image)];
    const int largest = std::max(bitmap.width, bitmap.height);
    if (largest > capabilities_.maxTextureSize)
        throw InputError(scene_.file + ": images[" + std::to_string(image) +
                         "]: " + std::to_string(bitmap.width) + "x" + std::to_string(bitmap.height) +
                         " pixels; expected at most " + std::to_string(capabilities_.maxTextureSize) +
                         " a side, the driver's limit");
    const TexelData texels = texelsFor(bitmap, srgb, bits_, !capabilities_.softwareRasteriser);
    gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.id());
    const GLenum format = texels.channels == 1 ? GL_RED : texels.channels == 2 ? GL_RG : GL_RGBA;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(texels.internalFormat), bitmap.width, bitmap.height, 0,
                 format, texels.type, texels.data.data());
    if (texels.channels <= 2) {
        // Grey stands for equal red, green and blue; the second channel, if any, is alpha.
        const GLint alpha = texels.channels == 2 ? GL_GREEN : GL_ONE;
        const GLint swizzle[] = {GL_RED, GL_RED, GL_RED, alpha};
        glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
    }
    glGenerateMipmap(GL_TEXTURE_2D);
    return images_.emplace(key, std::move(texture)).first->second.id();
}

GLuint GpuTextures::samplerObject(const Sampler& sampler) {
    for (const auto& [known, object] : samplers_)
        if (known == sampler) return object.id();
    gl::Sampler object = gl::Sampler::make();
    glSamplerParameteri(object.id(), GL_TEXTURE_WRAP_S, wrapOf(sampler.wrapS));
    glSamplerParameteri(object.id(), GL_TEXTURE_WRAP_T, wrapOf(sampler.wrapT));
    glSamplerParameteri(object.id(), GL_TEXTURE_MIN_FILTER, minifyOf(sampler));
    glSamplerParameteri(object.id(), GL_TEXTURE_MAG_FILTER,
                        sampler.magnify == Filter::linear ? GL_LINEAR : GL_NEAREST);
    samplers_.emplace_back(sampler, std::move(object));
    return samplers_.back().second.id();
}

void GpuTextures::adopt(GpuTextures&& other) {
    images_ = std::move(other.images_);
    samplers_ = std::move(other.samplers_);
    white_ = std::move(other.white_);
}

void GpuTextures::bind(int unit, const TextureSlot& slot, bool srgb) {
    const Texture& texture = scene_.textures[static_cast<size_t>(slot.texture)];
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    if (texture.image >= 0) {
        const GLuint id = imageTexture(texture.image, srgb);
        glBindTexture(GL_TEXTURE_2D, id);
    } else {
        if (!white_) {
            white_ = gl::Texture::make();
            glBindTexture(GL_TEXTURE_2D, white_.id());
            const unsigned char texel[] = {255, 255, 255, 255};
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
        }
        glBindTexture(GL_TEXTURE_2D, white_.id());
    }
    glBindSampler(static_cast<GLuint>(unit), samplerObject(texture.sampler));
}

}  // namespace lobe
