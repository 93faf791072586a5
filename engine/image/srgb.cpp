#include <algorithm>
#include <cmath>

#include "image/srgb_table.hpp"
#include "image/tone.hpp"

namespace lobe {
namespace {

/// IEC 61966-2-1.
double encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

int nearestCode(float linear) {
    return static_cast<int>(std::floor(encode(static_cast<double>(linear)) * 255.0 + 0.5));
}

}  // namespace

float encodeSrgb(float linear) {
    return static_cast<float>(encode(static_cast<double>(linear)));
}

float decodeSrgb(float encoded) {
    const auto value = static_cast<double>(encoded);
    return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

SrgbTable::SrgbTable() {
    for (uint32_t step = 0; step < steps_.size(); ++step) {
        const uint32_t begin = kFirstBits + (step << kShift);
        const int code = nearestCode(std::bit_cast<float>(begin));
        uint32_t inside = 0;             // has this code
        uint32_t beyond = 1U << kShift;  // has the next code, or is the next step
        while (beyond - inside > 1) {
            const uint32_t middle = (inside + beyond) / 2;
            (nearestCode(std::bit_cast<float>(begin + middle)) > code ? beyond : inside) = middle;
        }
        steps_[step] = (static_cast<uint32_t>(code) << kShift) + ((1U << kShift) - beyond);
    }
}

const SrgbTable& SrgbTable::get() {
    static const SrgbTable table;
    return table;
}

uint8_t encodeSrgb8(float linear) {
    return SrgbTable::get().encode(linear > 0.0F ? std::min(linear, 1.0F)
                                                 : 0.0F);  // the comparison sends NaN to 0
}

}  // namespace lobe
