#include "reference/texture_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace lobe::reference {
namespace {

/// IEC 61966-2-1.
double decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const std::array<double, 256>& decodedBytes() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = decode(static_cast<double>(i) / 255.0);
        return values;
    }();
    return table;
}

/// Texel `i` of a row of `size`, which may lie outside.
int wrapped(Wrap wrap, int64_t i, int size) {
    const int64_t n = size;
    switch (wrap) {
        case Wrap::repeat:
            return static_cast<int>((i % n + n) % n);
        case Wrap::mirroredRepeat: {
            const int64_t m = (i % (2 * n) + 2 * n) % (2 * n);
            return static_cast<int>(m < n ? m : 2 * n - 1 - m);
        }
        case Wrap::clampToEdge:
            break;
    }
    return static_cast<int>(std::clamp<int64_t>(i, 0, n - 1));
}

/// The same place near 0, so that it times the size fits into an integer.
double nearZero(Wrap wrap, double s) {
    switch (wrap) {
        case Wrap::repeat:
            return s - std::floor(s);
        case Wrap::mirroredRepeat:
            return s - 2.0 * std::floor(s * 0.5);
        case Wrap::clampToEdge:
            break;
    }
    return std::clamp(s, -1.0, 2.0);
}

/// What of the finer row's texels a coarser texel covers: [from, from + scale).
struct Coverage {
    int first, last;
    double from, to;
    Coverage(int coarse, int coarseSize, int fineSize)
        : from(static_cast<double>(coarse) * fineSize / coarseSize),
          to(static_cast<double>(coarse + 1) * fineSize / coarseSize) {
        first = static_cast<int>(from);
        last = std::min(static_cast<int>(std::ceil(to)), fineSize) - 1;
    }
    double weight(int fine) const {
        return (std::min(to, fine + 1.0) - std::max(from, static_cast<double>(fine))) / (to - from);
    }
};

}  // namespace

TextureReader::TextureReader(const Bitmap& bitmap, bool srgb)
    : bitmap_(bitmap), decode_(srgb && bitmap.type != ComponentType::f32) {
    while (size(levels() - 1) != glm::ivec2(1)) {
        const int finer = levels() - 1;
        const glm::ivec2 fine = size(finer);
        const glm::ivec2 coarse = glm::max(fine / 2, glm::ivec2(1));
        Level level{coarse.x, coarse.y, {}};
        level.values.reserve(static_cast<size_t>(coarse.x) * static_cast<size_t>(coarse.y) *
                             static_cast<size_t>(bitmap_.channels));
        for (int y = 0; y < coarse.y; ++y)
            for (int x = 0; x < coarse.x; ++x) {
                const Coverage columns(x, coarse.x, fine.x);
                const Coverage rows(y, coarse.y, fine.y);
                for (int c = 0; c < bitmap_.channels; ++c) {
                    double sum = 0.0;
                    for (int j = rows.first; j <= rows.last; ++j)
                        for (int i = columns.first; i <= columns.last; ++i)
                            sum += rows.weight(j) * columns.weight(i) * value(finer, i, j, c);
                    level.values.push_back(sum);
                }
            }
        coarser_.push_back(std::move(level));
    }
}

glm::ivec2 TextureReader::size(int level) const {
    if (level == 0) return {bitmap_.width, bitmap_.height};
    const Level& coarse = coarser_[static_cast<size_t>(level) - 1];
    return {coarse.width, coarse.height};
}

double TextureReader::value(int level, int x, int y, int channel) const {
    const size_t index =
        (static_cast<size_t>(y) * static_cast<size_t>(size(level).x) + static_cast<size_t>(x)) *
            static_cast<size_t>(bitmap_.channels) +
        static_cast<size_t>(channel);
    if (level > 0) return coarser_[static_cast<size_t>(level) - 1].values[index];
    const bool isAlpha = bitmap_.channels % 2 == 0 && channel == bitmap_.channels - 1;
    switch (bitmap_.type) {
        case ComponentType::u8: {
            const auto code = std::to_integer<size_t>(bitmap_.data[index]);
            return decode_ && !isAlpha ? decodedBytes()[code] : static_cast<double>(code) / 255.0;
        }
        case ComponentType::u16: {
            uint16_t code;
            std::memcpy(&code, bitmap_.data.data() + index * 2, 2);
            const double encoded = code / 65535.0;
            return decode_ && !isAlpha ? decode(encoded) : encoded;
        }
        case ComponentType::f32:
            break;
    }
    float number;
    std::memcpy(&number, bitmap_.data.data() + index * 4, 4);
    return static_cast<double>(number);
}

glm::dvec4 TextureReader::texel(int level, int x, int y) const {
    const auto channel = [&](int c) { return value(level, x, y, c); };
    switch (bitmap_.channels) {
        case 1:
            return glm::dvec4(glm::dvec3(channel(0)), 1.0);
        case 2:
            return glm::dvec4(glm::dvec3(channel(0)), channel(1));
        case 3:
            return {channel(0), channel(1), channel(2), 1.0};
        default:
            return {channel(0), channel(1), channel(2), channel(3)};
    }
}

glm::dvec4 TextureReader::sampleLevel(const Sampler& sampler, Filter filter, const glm::dvec2& uv,
                                      int level) const {
    const glm::ivec2 n = size(level);
    const glm::dvec2 place(nearZero(sampler.wrapS, uv.x) * n.x, nearZero(sampler.wrapT, uv.y) * n.y);
    const auto at = [&](double x, double y) {
        return texel(level, wrapped(sampler.wrapS, static_cast<int64_t>(x), n.x),
                     wrapped(sampler.wrapT, static_cast<int64_t>(y), n.y));
    };
    if (filter == Filter::nearest) return at(std::floor(place.x), std::floor(place.y));
    const glm::dvec2 corner = glm::floor(place - 0.5);
    const glm::dvec2 w = place - 0.5 - corner;
    return (1.0 - w.y) * ((1.0 - w.x) * at(corner.x, corner.y) + w.x * at(corner.x + 1.0, corner.y)) +
           w.y * ((1.0 - w.x) * at(corner.x, corner.y + 1.0) + w.x * at(corner.x + 1.0, corner.y + 1.0));
}

glm::dvec4 TextureReader::sample(const Sampler& sampler, const glm::dvec2& uv, const glm::dvec2& dx,
                                 const glm::dvec2& dy) const {
    const glm::dvec2 texels(size(0));
    const double rho = std::max(glm::length(dx * texels), glm::length(dy * texels));
    const double lambda = std::log2(rho);  // -infinity where magnified without bound
    // Where the two filters differ in sharpness, magnification reaches half a level further.
    const bool further = sampler.magnify == Filter::linear && sampler.minify == Filter::nearest &&
                         sampler.mip != MipFilter::none;
    if (!(lambda > (further ? 0.5 : 0.0))) return sampleLevel(sampler, sampler.magnify, uv, 0);
    const double last = levels() - 1;
    switch (sampler.mip) {
        case MipFilter::none:
            break;
        case MipFilter::nearest: {
            const double level = lambda <= 0.5 ? 0.0 : std::ceil(lambda + 0.5) - 1.0;
            return sampleLevel(sampler, sampler.minify, uv, static_cast<int>(std::min(level, last)));
        }
        case MipFilter::linear: {
            const double finer = std::min(std::floor(lambda), last);
            const glm::dvec4 fine = sampleLevel(sampler, sampler.minify, uv, static_cast<int>(finer));
            if (finer == last) return fine;
            return glm::mix(fine, sampleLevel(sampler, sampler.minify, uv, static_cast<int>(finer) + 1),
                            lambda - finer);
        }
    }
    return sampleLevel(sampler, sampler.minify, uv, 0);
}

}  // namespace lobe::reference
