/// Maps of error as pictures.
#pragma once

#include <string>

#include "image/image_files.hpp"
#include "image/metrics.hpp"

namespace lobe::app {

/// Throws UsageError unless the name ends in .png, .jpg, .jpeg or .exr.
void requireMapName(const std::string& file);

/// The map of a metric: its values (.exr), or viridis from 0, dark, to 1 for FLIP and to the largest value
/// for others; 1 - SSIM for SSIM, and the bias without its sign. Returns what is drawn and its range, which
/// the file holds as "lobe:range" too.
std::string writeErrorMap(const std::string& file, const ErrorMaps& maps, Metric metric, ImageFiles& files);

}  // namespace lobe::app
