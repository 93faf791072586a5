/// Reflectance models from GLSL files of one's own, without rebuilding (docs/how_to/add_a_brdf.md).
#pragma once

#include <filesystem>
#include <string>

#include "shading/brdf.hpp"

namespace lobe {

/// A GLSL file as it was read.
struct BrdfSource {
    std::string file;  ///< as it was named; its stem is the model's name
    std::string text;
    bool operator==(const BrdfSource&) const = default;
};

/// Reads the file. Throws InputError if it is none, or above 1 MiB.
BrdfSource readBrdfSource(const std::filesystem::path& file);

/// The registry entry that the file's header declares, without a twin. The file has a struct with the
/// header's parameters and a function NAME_f_cos; NAME_ambient and NAME_roughness are written for it where it
/// has none: the parameter that takes glTF's base colour (else 0), and the one that takes its roughness (else
/// 0.5). Where the header states no sharpness, the lobe is taken to be as sharp as can be. Throws InputError
/// that names file and line.
Brdf brdfFromSource(const BrdfSource& source);

}  // namespace lobe
