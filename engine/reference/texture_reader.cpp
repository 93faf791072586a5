#include "reference/texture_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/tone.hpp"
#include "shading/brdf.hpp"

namespace lobe::reference {
namespace {

/// 0..1 for integers.
float component(const Bitmap& bitmap, size_t index) {
    switch (bitmap.type) {
        case ComponentType::u8:
            return static_cast<float>(std::to_integer<unsigned>(bitmap.data[index])) / 255.0F;
        case ComponentType::u16: {
            uint16_t value;
            std::memcpy(&value, bitmap.data.data() + index * sizeof value, sizeof value);
            return static_cast<float>(value) / 65535.0F;
        }
        default: {
            float value;
            std::memcpy(&value, bitmap.data.data() + index * sizeof value, sizeof value);
            return value;
        }
    }
}

int wrapped(int i, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::clampToEdge:
            return std::clamp(i, 0, size - 1);
        case Wrap::mirroredRepeat: {
            const int period = ((i % (2 * size)) + 2 * size) % (2 * size);
            return period < size ? period : 2 * size - 1 - period;
        }
        default:
            return ((i % size) + size) % size;
    }
}

/// Where a coordinate falls in texels, kept within what an int holds.
double inTexels(double coordinate, int size) {
    constexpr double kFar = 1e8;
    return std::clamp(coordinate * size, -kFar, kFar);
}

glm::dvec2 transformed(const glm::dvec2& uv, const TextureSlot& slot) {
    const double c = std::cos(double{slot.rotation}), s = std::sin(double{slot.rotation});
    const glm::dvec2 scaled = uv * glm::dvec2(slot.scale);
    return glm::dvec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

}  // namespace

TextureReader::TextureReader(const Scene& scene) : scene_(scene) {
    const auto use = [&](const TextureSlot& slot, bool srgb) {
        if (!slot) return;
        const int image = scene.textures[static_cast<size_t>(slot.texture)].image;
        if (image < 0 || images_.contains({image, srgb})) return;
        images_.emplace(std::pair(image, srgb), decode(scene.images[static_cast<size_t>(image)], srgb));
    };
    std::vector<bool> used(scene.materials.size());
    for (const Instance& instance : scene.instances)
        used[static_cast<size_t>(scene.primitives[static_cast<size_t>(instance.primitive)].material)] = true;
    for (size_t m = 0; m < scene.materials.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = scene.materials[m];
        if (const Brdf* brdf = findBrdf(material.brdf))
            for (size_t p = 0; p < material.textures.size(); ++p)
                use(material.textures[p], brdf->parameters[p].textureIsSrgb);
        if (material.alphaMode != AlphaMode::opaque || findBrdf(material.brdf) == nullptr)
            use(material.baseColorTexture, true);
        use(material.normalTexture, false);
        use(material.occlusionTexture, false);
        use(material.emissionTexture, true);
    }
}

TextureReader::Levels TextureReader::decode(const Bitmap& bitmap, bool srgb) {
    Level base{bitmap.width, bitmap.height, {}};
    const auto channels = static_cast<size_t>(bitmap.channels);
    const bool hasAlpha = channels == 2 || channels == 4;
    const bool decodes = srgb && bitmap.type != ComponentType::f32;
    base.texels.resize(static_cast<size_t>(bitmap.width) * static_cast<size_t>(bitmap.height));
    for (size_t i = 0; i < base.texels.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const float value = component(bitmap, i * channels + (channels >= 3 ? c : 0));
            base.texels[i][static_cast<int>(c)] = decodes ? decodeSrgb(value) : value;
        }
        base.texels[i].a = hasAlpha ? component(bitmap, i * channels + channels - 1) : 1.0F;
    }
    Levels levels{std::move(base)};
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halved(levels.back()));
    return levels;
}

/// Bilinear at the coarser texels' centres: the mean of four where sizes are even, as drivers make it.
TextureReader::Level TextureReader::halved(const Level& level) {
    Level half{std::max(1, level.width / 2), std::max(1, level.height / 2), {}};
    half.texels.reserve(static_cast<size_t>(half.width) * static_cast<size_t>(half.height));
    Sampler clamp;
    clamp.wrapS = clamp.wrapT = Wrap::clampToEdge;
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            half.texels.emplace_back(
                sample(level, clamp, Filter::linear, {(x + 0.5) / half.width, (y + 0.5) / half.height}));
    return half;
}

glm::dvec4 TextureReader::sample(const Level& level, const Sampler& sampler, Filter filter,
                                 const glm::dvec2& uv) {
    const auto at = [&](int x, int y) {
        const int column = wrapped(x, level.width, sampler.wrapS),
                  row = wrapped(y, level.height, sampler.wrapT);
        return glm::dvec4(level.texels[static_cast<size_t>(row) * static_cast<size_t>(level.width) +
                                       static_cast<size_t>(column)]);
    };
    const double x = inTexels(uv.x, level.width), y = inTexels(uv.y, level.height);
    if (filter == Filter::nearest)
        return at(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const double fx = x - 0.5 - left, fy = y - 0.5 - top;
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
    return glm::mix(glm::mix(at(x0, y0), at(x0 + 1, y0), fx),
                    glm::mix(at(x0, y0 + 1), at(x0 + 1, y0 + 1), fx), fy);
}

glm::dvec4 TextureReader::read(const TextureSlot& slot, bool srgb, const UvFootprint& footprint) const {
    const Texture& texture = scene_.textures[static_cast<size_t>(slot.texture)];
    if (texture.image < 0) return glm::dvec4(1.0);
    const Levels& levels = images_.at({texture.image, srgb});
    const glm::dvec2 uv = transformed(footprint.uv, slot) + glm::dvec2(slot.offset);
    const Sampler& sampler = texture.sampler;
    // OpenGL 3.3, section 3.8.11: the longer of the footprint's two sides, in texels.
    const glm::dvec2 size(levels[0].width, levels[0].height);
    const double longest = footprint.known ? std::max(glm::length(transformed(footprint.dx, slot) * size),
                                                      glm::length(transformed(footprint.dy, slot) * size))
                                           : 0.0;
    const double level = longest > 0.0 ? std::log2(longest) : -1.0;
    if (!(level > 0.0)) return sample(levels[0], sampler, sampler.magnify, uv);
    const double coarsest = static_cast<double>(levels.size()) - 1.0;
    switch (sampler.mip) {
        case MipFilter::none:
            return sample(levels[0], sampler, sampler.minify, uv);
        case MipFilter::nearest: {
            const double nearest = std::clamp(std::ceil(level + 0.5) - 1.0, 0.0, coarsest);
            return sample(levels[static_cast<size_t>(nearest)], sampler, sampler.minify, uv);
        }
        default: {
            const double fine = std::min(std::floor(level), coarsest);
            const double coarse = std::min(fine + 1.0, coarsest);
            return glm::mix(sample(levels[static_cast<size_t>(fine)], sampler, sampler.minify, uv),
                            sample(levels[static_cast<size_t>(coarse)], sampler, sampler.minify, uv),
                            std::min(level, coarsest) - fine);
        }
    }
}

}  // namespace lobe::reference
