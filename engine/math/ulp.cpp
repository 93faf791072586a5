#include "math/ulp.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace lobe {
namespace {

/// Maps floats to integers so that neighbours stay neighbours: sign and magnitude becomes two's complement.
template<class Signed, class Float>
Signed ordered(Float value) {
    const auto bits = std::bit_cast<Signed>(value);
    return bits < 0 ? std::numeric_limits<Signed>::min() - bits : bits;
}

template<class Signed, class Float>
uint64_t distance(Float a, Float b) {
    if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<uint64_t>::max();
    const auto x = static_cast<uint64_t>(static_cast<int64_t>(ordered<Signed>(a)));
    const auto y = static_cast<uint64_t>(static_cast<int64_t>(ordered<Signed>(b)));
    return a < b ? y - x : x - y;
}

}  // namespace

uint64_t ulpDistance(float a, float b) {
    return distance<int32_t>(a, b);
}
uint64_t ulpDistance(double a, double b) {
    return distance<int64_t>(a, b);
}

}  // namespace lobe
