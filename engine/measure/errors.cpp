#include "measure/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "plot/style.hpp"

namespace lobe::measure {
namespace {

/// Of truth^2: keeps pixels that are dark against 0.1 from counting more than others (Rousselle et al. 2011).
constexpr double kFloor = 0.01;

std::array<size_t, 3> colourOf(const Image& image) {
    std::array<size_t, 3> places{};
    const std::array<const char*, 3> names{"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c) {
        const auto at = std::find(image.channels.begin(), image.channels.end(), names[c]);
        if (at == image.channels.end()) throw InputError(std::string("picture without channel ") + names[c]);
        places[c] = static_cast<size_t>(at - image.channels.begin());
    }
    return places;
}

/// Calls with the values of R, G or B of both pictures, pixel by pixel.
template<class Action>
void forEachValue(const Image& test, const Image& truth, Action action) {
    const std::array<size_t, 3> a = colourOf(test), b = colourOf(truth);
    for (size_t i = 0; i < test.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c)
            action(i, double{test.values[i * test.channelCount() + a[c]]},
                   double{truth.values[i * truth.channelCount() + b[c]]});
}

double relative(double test, double truth) {
    return (test - truth) * (test - truth) / (truth * truth + kFloor);
}

}  // namespace

double relativeSquaredError(const Image& test, const Image& truth) {
    double sum = 0.0;
    forEachValue(test, truth, [&](size_t, double a, double b) { sum += relative(a, b); });
    return sum / (3.0 * static_cast<double>(test.pixelCount()));
}

nlohmann::json errorJson(const Image& test, const Image& truth) {
    double squares = 0.0, largest = 0.0;
    forEachValue(test, truth, [&](size_t, double a, double b) {
        squares += (a - b) * (a - b);
        largest = std::max(largest, std::abs(a - b));
    });
    return {{"relmse", relativeSquaredError(test, truth)},
            {"rmse", std::sqrt(squares / (3.0 * static_cast<double>(test.pixelCount())))},
            {"max", largest},
            {"non_finite", countNonFinite(test).pixels}};
}

const std::vector<std::string>& errorColumns() {
    static const std::vector<std::string> names = {"relmse", "rmse", "max", "non_finite"};
    return names;
}

const std::vector<std::string>& errorMetricNames() {
    static const std::vector<std::string> names = {"relmse", "rmse", "max"};
    return names;
}

Bitmap differenceMap(const Image& test, const Image& truth) {
    constexpr double kDecades = 4.0;
    std::vector<double> errors(test.pixelCount());
    forEachValue(test, truth, [&](size_t i, double a, double b) { errors[i] += relative(a, b) / 3.0; });
    Bitmap map{test.width, test.height, 3, ComponentType::u8, {}};
    map.data.reserve(errors.size() * 3);
    for (const double error : errors) {
        const std::string colour =
            plot::sequentialColor(error > 0.0 ? 1.0 + 0.5 * std::log10(error) / kDecades : 0.0);
        for (size_t c = 0; c < 3; ++c)
            map.data.push_back(static_cast<std::byte>(std::stoi(colour.substr(1 + 2 * c, 2), nullptr, 16)));
    }
    return map;
}

}  // namespace lobe::measure
