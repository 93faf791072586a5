#include "codec/limits.hpp"

#include <string>

#include "base/error.hpp"
#include "codec/codec.hpp"

namespace lobe::codec {

void checkSize(int64_t width, int64_t height, int64_t channels) {
    const auto check = [](const char* property, int64_t value, int64_t most) {
        if (value >= 1 && value <= most) return;
        throw InputError(std::string(property) + ": " + std::to_string(value) + "; expected 1 to " +
                         std::to_string(most));
    };
    check("width", width, kMaxSide);
    check("height", height, kMaxSide);
    check("channels", channels, kMaxChannels);
    check("width x height x channels", width * height * channels, kMaxComponents);
}

}  // namespace lobe::codec
