#include "shading/bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "shading/colour_matching.hpp"
#include "shading/fresnel.hpp"

namespace lobe::shading {
namespace {

constexpr double kShortest = 380.0;
constexpr double kLongest = 780.0;
constexpr int kGroup = 3;        ///< bands that GLSL evaluates at a time
constexpr double kFinest = 0.5;  ///< nm: widest step of the integrals over a band

/// CIE standard illuminant D65, relative, 380 to 780 nm in steps of 10 (ISO/CIE 11664-2).
constexpr std::array kD65 = {49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812,
                             114.861, 115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
                             100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992,
                             80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856,
                             75.0870, 63.5927, 46.4182, 66.8054, 63.3828};

double d65(double wavelength) {
    const double place = (wavelength - kShortest) / 10.0;
    const auto below = std::min(static_cast<size_t>(place), kD65.size() - 2);
    return std::lerp(kD65[below], kD65[below + 1], place - static_cast<double>(below));
}

std::vector<Band> makeBands(const MetalSpectrum& metal, int count) {
    std::vector<Band> bands(static_cast<size_t>(count));
    const double width = (kLongest - kShortest) / count;
    const int steps = static_cast<int>(std::ceil(width / kFinest));
    glm::dvec3 sum(0.0);
    for (size_t b = 0; b < bands.size(); ++b) {
        Band& band = bands[b];
        band.from = kShortest + width * static_cast<double>(b);
        band.to = band.from + width;
        for (int i = 0; i < steps; ++i) {
            const double wavelength = band.from + width * (i + 0.5) / steps;
            band.index += metal.index(wavelength) / static_cast<double>(steps);
            band.weight += linearSrgb(colourMatching(wavelength)) * (d65(wavelength) * width / steps);
        }
        sum += band.weight;
    }
    for (Band& band : bands)
        band.weight /= sum;
    return bands;
}

TableRows makeRows(const std::vector<Band>& bands) {
    const size_t groups = (bands.size() + kGroup - 1) / kGroup;
    TableRows rows{static_cast<double>(groups), 0.0, 0.0, 0.0};
    for (size_t g = 0; g < groups; ++g) {
        std::array<Band, kGroup> group;
        group.fill({0.0, 0.0, {1.5, 0.0}, glm::dvec3(0.0)});  // fills up the last one, without weight
        for (size_t i = 0; i < kGroup && kGroup * g + i < bands.size(); ++i)
            group[i] = bands[kGroup * g + i];
        rows.insert(rows.end(), {group[0].index.real(), group[1].index.real(), group[2].index.real(), 0.0});
        rows.insert(rows.end(), {group[0].index.imag(), group[1].index.imag(), group[2].index.imag(), 0.0});
        for (const Band& band : group)
            rows.insert(rows.end(), {band.weight.r, band.weight.g, band.weight.b, 0.0});
    }
    return rows;
}

struct Made {
    std::vector<Band> bands;
    TableRows rows;
};

/// Each metal and number of bands once, for the program's life.
const Made& made(const MetalSpectrum& metal, int count) {
    static std::mutex mutex;
    static std::map<std::pair<std::string, int>, Made> known;
    const std::lock_guard lock(mutex);
    Made& entry = known[{metal.name, count}];
    if (entry.bands.empty()) {
        entry.bands = makeBands(metal, count);
        entry.rows = makeRows(entry.bands);
    }
    return entry;
}

const Made& madeFor(std::span<const double> eta) {
    return made(metalSpectra()[static_cast<size_t>(std::lround(eta[0])) - 1],
                static_cast<int>(std::lround(eta[1])));
}

}  // namespace

const std::vector<Band>& bandsOf(const MetalSpectrum& metal, int count) {
    return made(metal, count).bands;
}

glm::dvec3 bandReflectance(const std::vector<Band>& bands, double cosTheta, double oneMinusCos) {
    glm::dvec3 sum(0.0);
    for (const Band& band : bands)
        sum += band.weight * exactReflectance(band.index, cosTheta, oneMinusCos);
    return glm::max(sum, glm::dvec3(0.0));
}

const TableRows& bandRows(const MetalSpectrum& metal, int count) {
    return made(metal, count).rows;
}

std::optional<FresnelPlaces> fresnelPlaces(const Brdf& brdf) {
    const auto place = [&](const char* name) {
        const int index = brdf.parameterIndex(name);
        const bool grouped = index >= 0 && brdf.parameters[static_cast<size_t>(index)].group == "fresnel";
        return grouped ? std::optional(static_cast<size_t>(brdf.valueOffset(index))) : std::nullopt;
    };
    const auto type = place("fresnel");
    const auto eta = place("eta");
    const auto k = place("k");
    return type && eta && k ? std::optional(FresnelPlaces{*type, *eta, *k}) : std::nullopt;
}

bool hasBands(const Brdf& brdf, std::span<const double> values) {
    const auto places = fresnelPlaces(brdf);
    return places && values[places->type] == static_cast<double>(FresnelType::bands);
}

void setBands(const Brdf& brdf, ParameterValues& values, const MetalSpectrum& metal, int count) {
    const FresnelPlaces places = fresnelPlaces(brdf).value();
    values[places.type] = static_cast<double>(FresnelType::bands);
    values[places.eta] = static_cast<double>(&metal - metalSpectra().data() + 1);
    values[places.eta + 1] = count;
    values[places.eta + 2] = 0.0;
    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(places.k), 3, 0.0);
}

const std::vector<Band>& bandsIn(std::span<const double> eta) {
    return madeFor(eta).bands;
}

const TableRows& bandRowsIn(std::span<const double> eta) {
    return madeFor(eta).rows;
}

}  // namespace lobe::shading
