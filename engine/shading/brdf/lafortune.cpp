/// Sums of generalised cosine lobes.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <sstream>

#include "base/error.hpp"
#include "shading/lafortune_fits.hpp"
#include "shading/phong_family.hpp"

namespace lobe::brdf_entry {
namespace {

using shading::LafortuneLobe;
using shading::rgbAt;

constexpr size_t kRowsPerLobe = 4;
constexpr double kLargestLobe = 1e30;

TableRows rowsOf(const std::vector<LafortuneLobe>& lobes) {
    TableRows rows{static_cast<double>(lobes.size()), 0.0, 0.0, 0.0};
    for (const LafortuneLobe& lobe : lobes)
        for (const glm::dvec3& coefficient : {lobe.cx, lobe.cy, lobe.cz, lobe.n})
            rows.insert(rows.end(), {coefficient.r, coefficient.g, coefficient.b, 0.0});
    return rows;
}

std::vector<LafortuneLobe> lobesOf(std::span<const double> table) {
    std::vector<LafortuneLobe> lobes(static_cast<size_t>(table[0]));
    for (size_t i = 0; i < lobes.size(); ++i) {
        const size_t first = 4 * (1 + kRowsPerLobe * i);
        lobes[i] = {rgbAt(table, first), rgbAt(table, first + 4), rgbAt(table, first + 8),
                    rgbAt(table, first + 12)};
    }
    return lobes;
}

std::string textOf(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

/// Refuses exponents that are not positive and lobes too bright for floats.
TableRows rowsOfColumns(std::span<const double> columns) {
    std::vector<LafortuneLobe> lobes(columns.size() / 12);
    for (size_t i = 0; i < lobes.size(); ++i) {
        LafortuneLobe& lobe = lobes[i];
        lobe = {rgbAt(columns, 12 * i), rgbAt(columns, 12 * i + 3), rgbAt(columns, 12 * i + 6),
                rgbAt(columns, 12 * i + 9)};
        const std::string property = "lobes[" + std::to_string(i) + "]";
        for (int c = 0; c < 3; ++c) {
            const double n = lobe.n[c];
            if (!(n > 0.0 && n <= 1e6))
                throw InputError(property + ".n: " + textOf(n) + "; expected above 0, at most 1e6");
            const double largest =
                std::max({std::abs(lobe.cx[c]), std::abs(lobe.cy[c]), std::abs(lobe.cz[c])});
            if (!(n * std::log(largest) <= std::log(kLargestLobe)))
                throw InputError(property + ": " + textOf(largest) + " to the power " + textOf(n) +
                                 "; expected at most 1e30");
        }
    }
    return rowsOf(lobes);
}

glm::dvec3 lobes(const Directions& d, std::span<const double> values) {
    glm::dvec3 f(0.0);
    const std::span<const double> table = values.subspan(4);
    const auto count = static_cast<size_t>(table[0]);
    for (size_t i = 0; i < count; ++i) {
        const size_t first = 4 * (1 + kRowsPerLobe * i);
        for (size_t c = 0; c < 3; ++c) {
            const double s = table[first + c] * d.wi.x * d.wo.x + table[first + 4 + c] * d.wi.y * d.wo.y +
                             table[first + 8 + c] * d.wi.z * d.wo.z;
            f[static_cast<int>(c)] += std::pow(std::max(s, 0.0), table[first + 12 + c]);
        }
    }
    return f;
}

glm::dvec3 fCos(const Directions& d, std::span<const double> values) {
    if (!shading::aboveSurface(d)) return glm::dvec3(0.0);
    return (rgbAt(values, 0) / glm::pi<double>() + lobes(d, values)) * d.wi.z;
}

AreaModel area() {
    AreaModel area;
    area.colors = {"diffuse"};
    area.weights = [](std::span<const double> values) {
        return AreaWeights{rgbAt(values, 0), {glm::dvec3(1.0), glm::dvec3(0.0)}};
    };
    area.parts = [](const Directions& d, std::span<const double> values) {
        return AreaTerms{1.0, {lobes(d, values) * d.wi.z, glm::dvec3(0.0)}};
    };
    area.refuses = [](std::span<const double> values) {
        for (const LafortuneLobe& lobe : lobesOf(values.subspan(4)))
            if (lobe.cx != lobe.cy) return "its lobes have two widths";
        // Two lobes of a fit stand for those about the mirrored direction, not also for one that goes back.
        for (const LafortuneLobe& lobe : lobesOf(values.subspan(4)))
            if (lobe.cx.r > 0.0 || lobe.cx.g > 0.0 || lobe.cx.b > 0.0)
                return "a lobe of it turns back to the light";
        return "";
    };
    return area;
}

/// Of each lobe: the largest coefficient to its power, as the sum of |wi_k wo_k| is at most 1.
glm::dvec3 peak(std::span<const double> values) {
    glm::dvec3 f = rgbAt(values, 0) / glm::pi<double>();
    for (const LafortuneLobe& lobe : lobesOf(values.subspan(4)))
        for (int c = 0; c < 3; ++c)
            f[c] += std::pow(std::max({std::abs(lobe.cx[c]), std::abs(lobe.cy[c]), std::abs(lobe.cz[c])}),
                             lobe.n[c]);
    return f;
}

double sharpness(std::span<const double> values) {
    double n = 0.0;
    for (const LafortuneLobe& lobe : lobesOf(values.subspan(4)))
        n = std::max({n, lobe.n.r, lobe.n.g, lobe.n.b});
    return 2.0 * std::sqrt(n);
}

/// As Phong's about the vector w of components C wo; the lobe carries |w|^n.
SamplingLobes samplingLobes(const glm::dvec3& wo, std::span<const double> values) {
    SamplingLobes lobes;
    lobes.add({LobeShape::cosine, shading::meanOf(rgbAt(values, 0))});
    const std::span<const double> table = values.subspan(4);
    const auto count = static_cast<size_t>(table[0]);
    for (size_t i = 0; i < count; ++i) {
        const size_t first = 4 * (1 + kRowsPerLobe * i);
        for (size_t c = 0; c < 3; ++c) {
            const glm::dvec3 w(table[first + c] * wo.x, table[first + 4 + c] * wo.y,
                               table[first + 8 + c] * wo.z);
            const double length = glm::length(w), n = table[first + 12 + c];
            if (length == 0.0) continue;
            // A mean cosine of the light's side stands for the lobe's part below the horizon.
            const double cosine = std::max(w.z / length, 0.1);
            const double albedo = std::pow(length, n) * 2.0 * glm::pi<double>() / (n + 1.0) * cosine / 3.0;
            lobes.add({LobeShape::power, albedo, n, 0.0, 0.0, w / length});
        }
    }
    return lobes;
}

/// A diffuse part as Phong's, and one lobe about the mirrored direction: normalised Phong of exponent n.
ParameterValues fromMetallicRoughness(const MetallicRoughness& surface) {
    const glm::dvec3 diffuse = surface.baseColor * (1.0 - surface.metallic) * (1.0 - shading::kDielectricF0);
    const glm::dvec3 specular =
        glm::mix(glm::dvec3(shading::kDielectricF0), surface.baseColor, surface.metallic);
    const double n = std::clamp(shading::blinnExponent(surface.roughness) / 4.0, 0.1, 1e4);
    glm::dvec3 c;
    for (int k = 0; k < 3; ++k)
        c[k] = std::pow(std::max(specular[k], 1e-6) * (n + 2.0) / (2.0 * glm::pi<double>()), 1.0 / n);
    ParameterValues values{diffuse.r, diffuse.g, diffuse.b, 0.0};
    const TableRows rows = rowsOf({{-c, -c, c, glm::dvec3(n)}});
    values.insert(values.end(), rows.begin(), rows.end());
    return values;
}

}  // namespace

Brdf lafortune() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "lafortune";
    brdf.title = "Lafortune";
    brdf.source =
        "E. P. F. Lafortune et al., Non-linear approximation of reflectance functions, SIGGRAPH 1997";
    brdf.parameters = {
        colorParameter("diffuse", glm::dvec3(0.0), "k_d: diffuse reflectance"),
        tableParameter("lobes", "lobes, each with cx, cy, cz and n per channel; or the name of a fit")};
    TableFormat format;
    format.columns = {"cx", "cy", "cz", "n"};
    format.fromColumns = rowsOfColumns;
    format.examples = [] {
        std::vector<std::pair<std::string, TableRows>> examples;
        for (const LafortuneFit& fit : lafortuneFits())
            examples.emplace_back(fit.name, rowsOf(fit.lobes));
        // Anisotropic.
        examples.emplace_back("anisotropic",
                              rowsOf({{glm::dvec3(-1.0, -0.9, -0.5), glm::dvec3(-0.8, 0.9, -1.0),
                                       glm::dvec3(1.0, 0.95, 0.7), glm::dvec3(30.0, 8.0, 0.5)}}));
        return examples;
    };
    brdf.table = std::move(format);
    for (const LafortuneFit& fit : lafortuneFits()) {
        ParameterValues values{fit.diffuse.r, fit.diffuse.g, fit.diffuse.b, 0.0};
        const TableRows rows = rowsOf(fit.lobes);
        values.insert(values.end(), rows.begin(), rows.end());
        brdf.presets.push_back({fit.name, fit.source, std::move(values)});
    }
    // Fits are made to measurements, not to a bound: brushed metal reaches albedo 1.56.
    brdf.traits.energyConserving = false;
    brdf.traits.halfVectorLobe = false;
    brdf.traits.anglesOnly = false;
    brdf.traits.usesTangent = true;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = fCos;
    brdf.peak = peak;
    brdf.area = area();
    brdf.samplingLobes = samplingLobes;
    brdf.ambient = [](std::span<const double> values) { return rgbAt(values, 0); };
    brdf.lobeSharpness = sharpness;
    brdf.fromMetallicRoughness = fromMetallicRoughness;
    return brdf;
}

}  // namespace lobe::brdf_entry
