/// Float images with named channels: what the renderer makes and what error is measured on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lobe {

/// Linear values, interleaved, row 0 at the top. Channel names follow OpenEXR: "R","G","B","A", "Z",
/// "normal.X", ...
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;
    std::vector<float> values;  ///< width * height * channels.size()

    Image() = default;
    Image(int imageWidth, int imageHeight, std::vector<std::string> channelNames)
        : width(imageWidth),
          height(imageHeight),
          channels(std::move(channelNames)),
          values(static_cast<size_t>(imageWidth) * static_cast<size_t>(imageHeight) * channels.size()) {}

    size_t channelCount() const { return channels.size(); }
    size_t pixelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    float* pixel(int x, int y) { return values.data() + offset(x, y); }
    const float* pixel(int x, int y) const { return values.data() + offset(x, y); }

private:
    size_t offset(int x, int y) const {
        return (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) *
               channels.size();
    }
};

/// How many pixels have a NaN or infinity in any channel, told by exponent bits (isnan may be optimised
/// away), and where the first of them is.
struct NonFinite {
    size_t pixels = 0;
    int firstX = -1;
    int firstY = -1;
    std::string firstChannel;
};
NonFinite countNonFinite(const Image& image);

/// A decoded texture image: what a file held, not yet interpreted. Row 0 at the top; alpha never
/// premultiplied.
enum class ComponentType : uint8_t { u8, u16, f32 };
struct Bitmap {
    int width = 0;
    int height = 0;
    int channels = 0;  ///< 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
    ComponentType type = ComponentType::u8;
    std::vector<std::byte> data;

    size_t bytesPerComponent() const {
        return type == ComponentType::u8 ? 1 : type == ComponentType::u16 ? 2 : 4;
    }
};

}  // namespace lobe
