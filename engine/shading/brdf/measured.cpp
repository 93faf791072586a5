/// Isotropic measurements over half and difference angles.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/merl.hpp"
#include "shading/parameters.hpp"

namespace lobe::brdf_entry {
namespace {

using shading::rgbAt;

constexpr size_t kTableAt = 4;

/// Rusinkiewicz's angles of a pair of directions.
struct Angles {
    double thetaH, thetaD, phiD;
};

Angles anglesOf(const Directions& d) {
    const glm::dvec3 difference = d.wi - d.wo;
    const double thetaH = std::atan2(std::hypot(d.h.x, d.h.y), d.h.z);
    const double phiH = d.h.x == 0.0 && d.h.y == 0.0 ? 0.0 : std::atan2(d.h.y, d.h.x);
    // wi turned by -phi_h about z, then by -theta_h about y; its azimuth is phi_d. The part along h turns to
    // z, so the difference vector has the same azimuth.
    const double x = difference.x * std::cos(phiH) + difference.y * std::sin(phiH);
    const double y = -difference.x * std::sin(phiH) + difference.y * std::cos(phiH);
    const double turned = x * std::cos(thetaH) - difference.z * std::sin(thetaH);
    double phiD = std::atan2(y, turned);
    if (phiD < 0.0) phiD += glm::pi<double>();
    return {thetaH, std::atan2(glm::length(difference), glm::length(d.h)), phiD};
}

struct Place {
    size_t lower, upper;
    double share;  ///< of upper
};

Place clamped(double coordinate, size_t n) {
    const double x = std::clamp(coordinate - 0.5, 0.0, static_cast<double>(n - 1));
    const auto lower = static_cast<size_t>(x);
    return {lower, std::min(lower + 1, n - 1), x - static_cast<double>(lower)};
}

Place repeating(double coordinate, size_t n) {
    const double x = coordinate - 0.5 + static_cast<double>(n);
    const auto lower = static_cast<size_t>(x);
    return {lower % n, (lower + 1) % n, x - static_cast<double>(lower)};
}

glm::dvec3 interpolated(std::span<const double> table, const Angles& angles) {
    const auto nh = static_cast<size_t>(table[0]);
    const auto nd = static_cast<size_t>(table[1]);
    const auto np = static_cast<size_t>(table[2]);
    const double halfPi = glm::half_pi<double>();
    const Place h = clamped(table[0] * std::sqrt(std::max(angles.thetaH, 0.0) / halfPi), nh);
    const Place e = clamped(table[1] * angles.thetaD / halfPi, nd);
    const Place p = repeating(table[2] * angles.phiD / glm::pi<double>(), np);
    const auto at = [&](size_t ih, size_t id, size_t ip) {
        return rgbAt(table, 4 * (2 + ip + np * (id + nd * ih)));
    };
    const auto alongPhi = [&](size_t ih, size_t id) {
        return at(ih, id, p.lower) * (1.0 - p.share) + at(ih, id, p.upper) * p.share;
    };
    const auto alongTheta = [&](size_t ih) {
        return alongPhi(ih, e.lower) * (1.0 - e.share) + alongPhi(ih, e.upper) * e.share;
    };
    return alongTheta(h.lower) * (1.0 - h.share) + alongTheta(h.upper) * h.share;
}

glm::dvec3 fCos(const Directions& d, std::span<const double> values) {
    if (!shading::aboveSurface(d)) return glm::dvec3(0.0);
    return rgbAt(values, 0) * interpolated(values.subspan(kTableAt), anglesOf(d)) * d.wi.z;
}

/// Steepest change of the logarithm from cell to cell along theta_h, in 1/rad; steps to a tenth and less are
/// edges.
double sharpness(std::span<const double> values) {
    const std::span<const double> table = values.subspan(kTableAt);
    const auto nh = static_cast<size_t>(table[0]);
    const size_t stride = 4 * static_cast<size_t>(table[1]) * static_cast<size_t>(table[2]);
    double steepest = 0.0;
    for (size_t h = 0; h + 1 < nh; ++h) {
        const double i = static_cast<double>(h);
        const double width = glm::half_pi<double>() * (2.0 * i + 2.0) / (table[0] * table[0]);
        const double here = table[8 + h * stride + 1];
        const double next = table[8 + (h + 1) * stride + 1];
        if (std::min(here, next) > 0.0)
            steepest = std::max(steepest, std::abs(std::log(here / next)) / width);
    }
    return steepest;
}

ParameterValues withTable(const glm::dvec3& scale, const TableRows& rows) {
    ParameterValues values{scale.r, scale.g, scale.b, 0.0};
    values.insert(values.end(), rows.begin(), rows.end());
    return values;
}

/// glTF's own model in white, tabulated.
TableRows tabulatedGltf(const MetallicRoughness& surface, const shading::MerlSize& size) {
    const Brdf& gltf = requireBrdf("metallic_roughness");
    const ParameterValues white{1.0, 1.0, 1.0, surface.metallic, surface.roughness};
    return shading::tabulated(size, [&](const Directions& d) {
        return shading::aboveSurface(d) ? gltf.fCos(d, white) / d.wi.z : glm::dvec3(0.0);
    });
}

/// Values that change by channel and along every axis, zeros among them, as measurements have.
TableRows uneven() {
    return shading::tabulated({12, 8, 6}, [](const Directions& d) {
        const double h = glm::normalize(d.h).z;
        const double anisotropy = 1.0 + 0.5 * d.wi.x * d.wi.x;
        const glm::dvec3 f(std::exp(-8.0 * (1.0 - h)), 0.1 + h * std::abs(d.wi.y), std::max(h - 0.6, 0.0));
        return f * anisotropy;
    });
}

}  // namespace

Brdf measured() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "measured";
    brdf.title = "Measured (MERL)";
    brdf.source =
        "W. Matusik et al., A data-driven reflectance model, ACM TOG 22(3), 2003; S. M. Rusinkiewicz, A new "
        "change of "
        "variables for efficient BRDF representation, EGWR 1998";
    brdf.parameters = {colorParameter("scale", glm::dvec3(1.0), "multiplies the table"),
                       tableParameter("file", "a table of the MERL database, beside the scene")};
    TableFormat format;
    format.fromFile = merlTable;
    format.examples = [] {
        return std::vector<std::pair<std::string, TableRows>>{
            {"lambert",
             tabulated({1, 1, 1}, [](const Directions&) { return glm::dvec3(1.0 / glm::pi<double>()); })},
            {"uneven", uneven()}};
    };
    brdf.table = std::move(format);
    // A table says what was measured, whatever that is.
    brdf.traits.energyConserving = false;
    brdf.baseColorParameter = "scale";
    brdf.fCos = fCos;
    brdf.peak = [](std::span<const double> values) {
        const std::span<const double> table = values.subspan(kTableAt);
        glm::dvec3 largest(0.0);
        for (size_t row = 2; 4 * row + 4 <= table.size(); ++row)
            largest = glm::max(largest, rgbAt(table, 4 * row));
        return rgbAt(values, 0) * largest;
    };
    AreaModel area;
    area.colors = {"scale"};
    area.weights = [](std::span<const double> values) {
        return AreaWeights{glm::dvec3(0.0), {rgbAt(values, 0), glm::dvec3(0.0)}};
    };
    area.parts = [](const Directions& d, std::span<const double> values) {
        return AreaTerms{1.0,
                         {interpolated(values.subspan(kTableAt), anglesOf(d)) * d.wi.z, glm::dvec3(0.0)}};
    };
    brdf.area = std::move(area);
    brdf.ambient = [](std::span<const double> values) {
        return rgbAt(values, 0) * rgbAt(values, kTableAt + 4);
    };
    brdf.lobeSharpness = sharpness;
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        return withTable(surface.baseColor, tabulatedGltf(surface, {64, 16, 12}));
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
