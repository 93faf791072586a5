#include "image/planes.hpp"

#include <algorithm>

namespace lobe {
namespace {

Plane alongX(const Plane& plane, int width, int height, const Kernel& kernel) {
    const size_t columns = static_cast<size_t>(width), radius = kernel.size() / 2;
    Plane result(plane.size(), 0.0);
    Plane row(columns + 2 * radius);  // with the border repeated, so that the loop over x has no branch
    for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
        const double* const source = plane.data() + y * columns;
        std::fill_n(row.begin(), radius, source[0]);
        std::copy_n(source, columns, row.begin() + static_cast<std::ptrdiff_t>(radius));
        std::fill_n(row.end() - static_cast<std::ptrdiff_t>(radius), radius, source[columns - 1]);
        double* const target = result.data() + y * columns;
        for (size_t k = 0; k < kernel.size(); ++k)
            for (size_t x = 0; x < columns; ++x)
                target[x] += kernel[k] * row[x + k];
    }
    return result;
}

Plane alongY(const Plane& plane, int width, int height, const Kernel& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    const size_t columns = static_cast<size_t>(width);
    Plane result(plane.size(), 0.0);
    for (int y = 0; y < height; ++y) {
        double* const target = result.data() + static_cast<size_t>(y) * columns;
        for (int k = -radius; k <= radius; ++k) {
            const double weight = kernel[static_cast<size_t>(k + radius)];
            const int from = std::clamp(y + k, 0, height - 1);
            const double* const source = plane.data() + static_cast<size_t>(from) * columns;
            for (size_t x = 0; x < columns; ++x)
                target[x] += weight * source[x];
        }
    }
    return result;
}

}  // namespace

Plane filtered(const Plane& plane, int width, int height, const Kernel& horizontal, const Kernel& vertical) {
    if (plane.empty()) return {};
    return alongY(alongX(plane, width, height, horizontal), width, height, vertical);
}

}  // namespace lobe
