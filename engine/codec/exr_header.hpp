/// The header of an OpenEXR file, read before a decoder allocates what it asks for.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codec/bytes.hpp"

namespace lobe::codec::exr {

struct Channel {
    std::string name;
    bool subsampled = false;
};

struct Size {
    int64_t width = 0;
    int64_t height = 0;
};

struct Part {
    std::vector<Channel> channels;
    std::optional<Size> dataWindow;
    std::optional<Size> tile;
    std::map<std::string, std::string> strings;
};

struct Header {
    bool deep = false;
    std::vector<Part> parts;  ///< at least one
};

/// Throws InputError when the header is cut off or not of OpenEXR's form.
Header readHeader(Bytes file);

}  // namespace lobe::codec::exr
