/// The header comment of a model's GLSL file: lines that start with "///", a key and its text; under "params"
/// one parameter a line. The syntax is that of docs/how_to/add_a_brdf.md, for files that come with Lobe and
/// others alike.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shading/brdf.hpp"

namespace lobe {

/// A parameter as its line declares it.
struct HeaderParameter {
    Parameter parameter;
    std::string takes;  ///< "base colour", "roughness", "metallic": what of glTF's surface becomes its value
    bool hasDefault = false;
    int line = 0;  ///< in the file, from 1
};

struct BrdfHeader {
    std::string title;                        ///< of the first line "NAME.glsl - TITLE."
    std::map<std::string, std::string> keys;  ///< "source" -> text, continuation lines joined by spaces
    std::vector<HeaderParameter> parameters;
    std::optional<double> sharpness;  ///< of the key of that name, 1/rad
};

/// `file` names the text in messages. Throws InputError "FILE:LINE: ..." for a params or sharpness line that
/// cannot be read; a header without params has none.
BrdfHeader parseBrdfHeader(std::string_view text, const std::string& file);

}  // namespace lobe
