#include "explain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "harness/comparison.hpp"
#include "meter.hpp"

namespace lobe::app {
namespace {

using nlohmann::ordered_json;
using reference::LightShare;
using reference::SurfaceShare;

std::string vec(const glm::dvec3& v) {
    return fmt::format("{:.5g} {:.5g} {:.5g}", v.x, v.y, v.z);
}

ordered_json list(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

double degrees(double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

double mean(const glm::dvec3& v) {
    return (v.x + v.y + v.z) / 3.0;
}

std::string parameterText(const Brdf& brdf, std::span<const double> values) {
    std::string text;
    for (size_t i = 0; i < brdf.parameters.size(); ++i) {
        const Parameter& parameter = brdf.parameters[i];
        if (parameter.kind == ParameterKind::table) continue;
        const auto offset = static_cast<size_t>(brdf.valueOffset(static_cast<int>(i)));
        text += text.empty() ? "" : ", ";
        text += parameter.name + " = ";
        if (parameter.kind == ParameterKind::choice)
            text += parameter.choices[static_cast<size_t>(values[offset])];
        else if (parameter.kind == ParameterKind::rgb)
            text += vec({values[offset], values[offset + 1], values[offset + 2]});
        else
            text += fmt::format("{:.5g}", values[offset]);
    }
    return text;
}

std::string lightText(const LightShare& light, const glm::dvec3& total) {
    std::string text =
        fmt::format("    {:<12} {:<20} {}", nameOf(light.source), light.name, vec(light.radiance));
    if (mean(total) > 0.0) text += fmt::format("   {:.1f} %", 100.0 * mean(light.radiance) / mean(total));
    text += fmt::format("   visible {:.1f} %", 100.0 * light.visible);
    if (mean(light.error) > 0.0) text += "   +- " + vec(light.error);
    text += '\n';
    if (light.wi == glm::dvec3(0.0)) return text;
    text += fmt::format("                 {:.2f} degrees from the normal", degrees(light.wi.z));
    if (light.distance > 0.0) text += fmt::format(", {:.5g} m away", light.distance);
    if (light.irradiance != glm::dvec3(0.0)) text += ", E " + vec(light.irradiance);
    if (light.brdf != glm::dvec3(0.0)) text += ", f_r " + vec(light.brdf);
    for (const BrdfFactor& factor : light.factors)
        text += ", " + factor.name + " " +
                (factor.value.x == factor.value.y && factor.value.y == factor.value.z
                     ? fmt::format("{:.5g}", factor.value.x)
                     : vec(factor.value));
    return text + '\n';
}

std::string materialName(const Scene& scene, int material) {
    const std::string& name = scene.materials[static_cast<size_t>(material)].name;
    return fmt::format("{}{}", material, name.empty() ? "" : " '" + name + "'");
}

std::string surfaceText(const Scene& scene, const SurfaceShare& surface) {
    const reference::SurfacePoint& point = surface.point;
    std::string text = fmt::format("surface {:.5g} m away, weight {:.4g}: material {}, model {}\n",
                                   point.distance, surface.weight, materialName(scene, point.material),
                                   point.brdf == nullptr ? "unlit" : point.brdf->name);
    text += fmt::format("    node {}, triangle {}\n", scene.instances[point.instance].node, point.triangle);
    text += fmt::format("    position {}   normal {}   of the triangle {}\n", vec(point.position),
                        vec(point.normal), vec(point.geometricNormal));
    if (point.emission != glm::dvec3(0.0)) text += "    emission     " + vec(point.emission) + '\n';
    if (point.brdf == nullptr) return text;
    text += fmt::format("    seen {:.2f} degrees from the normal; {}\n", degrees(surface.wo.z),
                        parameterText(*point.brdf, point.values()));
    glm::dvec3 total = point.emission + surface.ambient;
    for (const LightShare& light : surface.lights)
        total += light.radiance;
    if (surface.ambient != glm::dvec3(0.0)) text += "    ambient      " + vec(surface.ambient) + '\n';
    std::vector<const LightShare*> order;
    for (const LightShare& light : surface.lights)
        order.push_back(&light);
    std::stable_sort(order.begin(), order.end(), [](const LightShare* a, const LightShare* b) {
        return mean(a->radiance) > mean(b->radiance);
    });
    constexpr size_t kShown = 20;
    for (size_t i = 0; i < std::min(order.size(), kShown); ++i)
        text += lightText(*order[i], total);
    if (order.size() > kShown)
        text += fmt::format("    and {} lights that give less (all: --json)\n", order.size() - kShown);
    return text;
}

}  // namespace

std::string explanationText(const Scene& scene, const ExplainedPixel& pixel) {
    const reference::PixelTruth& truth = pixel.explanation->truth;
    std::string text = fmt::format("pixel {},{} of {}\n", pixel.x, pixel.y, pixel.scene);
    if (pixel.explanation->surfaces.empty()) text += "no surface\n";
    for (const SurfaceShare& surface : pixel.explanation->surfaces)
        text += surfaceText(scene, surface);
    text += fmt::format("truth     {}   +- {}   ({} rays)\n", vec(truth.total()),
                        vec(glm::sqrt(truth.variance)), truth.rays);
    if (pixel.rendered) {
        const glm::dvec3 difference = *pixel.rendered - truth.total();
        text += fmt::format("rendered  {}   by {}\ndifference {}", vec(*pixel.rendered), pixel.context,
                            vec(difference));
        if (mean(truth.total()) > 0.0)
            text += fmt::format("   {:+.3g} %", 100.0 * mean(difference) / mean(truth.total()));
        text += '\n';
    }
    return text;
}

ordered_json explanationJson(const Scene& scene, const ExplainedPixel& pixel) {
    ordered_json surfaces = ordered_json::array();
    for (const SurfaceShare& surface : pixel.explanation->surfaces) {
        const reference::SurfacePoint& point = surface.point;
        ordered_json lights = ordered_json::array();
        for (const LightShare& light : surface.lights) {
            ordered_json factors = ordered_json::object();
            for (const BrdfFactor& factor : light.factors)
                factors[factor.name] = list(factor.value);
            lights.push_back({{"name", light.name},
                              {"type", nameOf(light.source)},
                              {"wi", list(light.wi)},
                              {"distance", light.distance},
                              {"irradiance", list(light.irradiance)},
                              {"brdf", list(light.brdf)},
                              {"factors", factors},
                              {"visible", light.visible},
                              {"radiance", list(light.radiance)},
                              {"standard_error", list(light.error)}});
        }
        const auto values = point.brdf == nullptr ? std::span<const double>() : point.values();
        surfaces.push_back({{"material", point.material},
                            {"material_name", scene.materials[static_cast<size_t>(point.material)].name},
                            {"model", point.brdf == nullptr ? "unlit" : point.brdf->name},
                            {"node", scene.instances[point.instance].node},
                            {"triangle", point.triangle},
                            {"distance", point.distance},
                            {"weight", surface.weight},
                            {"position", list(point.position)},
                            {"normal", list(point.normal)},
                            {"geometric_normal", list(point.geometricNormal)},
                            {"wo", list(surface.wo)},
                            {"values", std::vector<double>(values.begin(), values.end())},
                            {"emission", list(point.emission)},
                            {"ambient", list(surface.ambient)},
                            {"lights", lights}});
    }
    const reference::PixelTruth& truth = pixel.explanation->truth;
    ordered_json result = {{"schema", 1},
                           {"scene", pixel.scene},
                           {"pixel", {pixel.x, pixel.y}},
                           {"surfaces", surfaces},
                           {"truth", list(truth.total())},
                           {"standard_error", list(glm::sqrt(truth.variance))},
                           {"rays", truth.rays}};
    if (pixel.rendered) {
        result["rendered"] = list(*pixel.rendered);
        result["context"] = pixel.context;
    }
    return result;
}

std::string explanationTest(const ExplainedPixel& pixel) {
    if (pixel.explanation->surfaces.empty()) return {};
    const SurfaceShare& surface = pixel.explanation->surfaces.front();
    const Brdf* brdf = surface.point.brdf;
    if (brdf == nullptr || brdf->tableParameter() >= 0) return {};
    const LightShare* best = nullptr;
    for (const LightShare& light : surface.lights)
        if (light.brdf != glm::dvec3(0.0) && (best == nullptr || mean(light.radiance) > mean(best->radiance)))
            best = &light;
    if (best == nullptr) return {};

    // What the GLSL gets are floats: the value expected is the twin's for them.
    const auto rounded = [](const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)); };
    const glm::dvec3 wi = rounded(best->wi), wo = rounded(surface.wo);
    const Directions d(wi, wo);
    ParameterValues values;
    std::string arguments;
    const auto exact = [](double v) { return fmt::format("{:.9g}", static_cast<float>(v)); };
    for (const Parameter& parameter : brdf->parameters) {
        const size_t offset = values.size();
        for (int c = 0; c < parameter.components(); ++c)
            values.push_back(
                double{static_cast<float>(surface.point.values()[offset + static_cast<size_t>(c)])});
        arguments += arguments.empty() ? "" : ", ";
        if (parameter.kind == ParameterKind::rgb)
            arguments += "vec3(" + exact(values[offset]) + ", " + exact(values[offset + 1]) + ", " +
                         exact(values[offset + 2]) + ")";
        else if (parameter.kind == ParameterKind::choice)
            arguments += std::to_string(static_cast<int>(values[offset]));
        else
            arguments += "float(" + exact(values[offset]) + ")";
    }
    const glm::dvec3 value = brdf->fCos(d, values);
    const glm::dvec3 unit = harness::roundingUnit(*brdf, d, values, harness::Axes::local);
    const double tolerance = harness::kAllowedUnits * std::max({unit.x, unit.y, unit.z});
    const auto in = [&](const glm::dvec3& v) {
        return "values((" + exact(v.x) + ", " + exact(v.y) + ", " + exact(v.z) + "))";
    };
    return fmt::format(
        "// Pixel {},{} of {}: {} under {} light {}.\n"
        "#include \"brdf/{}.glsl\"\n\n"
        "/// @test {}_at_pixel_{}_{}\n"
        "/// @in wi: {}\n"
        "/// @in wo: {}\n"
        "/// @expect equals ({:.9g}, {:.9g}, {:.9g}) within rel {:.3g}\n"
        "vec3 test_pixel(vec3 wi, vec3 wo)\n{{\n"
        "    return {}_f_cos(Dirs(wi, wo, wi + wo), {}({}));\n}}\n",
        pixel.x, pixel.y, pixel.scene, brdf->name, nameOf(best->source), best->name, brdf->name, brdf->name,
        pixel.x, pixel.y, in(wi), in(wo), value.x, value.y, value.z, tolerance, brdf->name,
        glslParameterType(*brdf), arguments);
}

}  // namespace lobe::app
