/// From what was drawn to a file.
#pragma once

#include <map>
#include <string>

#include "image/image_files.hpp"
#include "shots.hpp"

namespace lobe::app {

/// Whether every pixel has the same colour: nearly always a picture of nothing. Colour is R, G and B where
/// the image has them, otherwise all channels.
bool isConstant(const Image& image);

/// Writes a shot's picture in the format of its name, or as PNG to standard output for "-". Throws
/// OutputError.
void writePicture(const Shot& shot, const Image& image, const std::map<std::string, std::string>& metadata,
                  ImageFiles& files);

}  // namespace lobe::app
