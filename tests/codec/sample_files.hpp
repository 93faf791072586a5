/// Small picture files of every kind, made here.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace lobe::samples {

std::span<const std::byte> bytesOf(const std::string& file);

/// Every component differs from its neighbours; alpha takes 0 and the largest value too.
Bitmap bitmap(int width, int height, int channels, ComponentType type);
Image image(int width, int height, const std::vector<std::string>& channels);

/// A PNG from its parts, for kinds that the encoder does not write; `rows` are unfiltered and packed.
struct PngParts {
    uint32_t width = 1;
    uint32_t height = 1;
    int bitDepth = 8;
    int colourType = 2;
    std::string palette;
    std::string transparency;
    std::string rows;
};
std::string png(const PngParts& parts);

std::string webp(const Bitmap& bitmap);
std::string tiledExr(const Image& image, int tileWidth, int tileHeight);

/// One valid file of each format that is read, by a name for messages.
std::map<std::string, std::string> everyFormat();

}  // namespace lobe::samples
