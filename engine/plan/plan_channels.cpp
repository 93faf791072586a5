// Channels: what the G-buffer and the pictures hold, and in which formats.
#include <algorithm>

#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {

namespace {

/// A parameter whose range lies within 0..1 fits a normalised format; others need float.
bool fitsUnorm(const Parameter& parameter) {
    return parameter.minimum >= 0.0 && parameter.maximum <= 1.0;
}

std::string unormFormat(int components, int bits) {
    static const char* const letters[] = {"", "R", "RG", "RGBA", "RGBA"};
    return std::string(letters[components]) + (bits == 32 ? "32F" : std::to_string(bits));
}

/// Lobe sharpness (|d ln f / d theta_h|, 1/rad) up to which a normal of 2x16 bits (off by at most 6.4e-5 rad)
/// changes the lobe by less than 1 %.
constexpr double kSharpnessOf16Bits = 0.01 / 6.4e-5;

}  // namespace

void Planner::planModels() {
    plan_.masked = scene_.brdfs.size() > 1 && needsDeferredTargets_;
    int stencil = 0;
    for (const BrdfFacts& facts : scene_.brdfs) {
        PlannedBrdf brdf;
        brdf.name = facts.name;
        brdf.stencil = plan_.masked ? ++stencil : 0;
        brdf.perMaterial.assign(facts.perMaterial.begin(), facts.perMaterial.end());
        plan_.brdfs.push_back(brdf);
        if (const Brdf* model = findBrdf(facts.name); model != nullptr && !model->file.empty())
            plan_.notes.push_back("model " + facts.name + ": loaded from " + model->file +
                                  "; it has no twin to be checked against");
    }
    if (stencil > 255) throw InputError("scene uses more than 255 reflectance models; expected at most 255");
}

void Planner::planGeometryChannels() {
    if (!plan_.reversedDepth) {
        plan_.notes.push_back(
            "depth: standard with linear z in a channel, since the context lacks ARB_clip_control");
    }
    const bool stencil = plan_.masked;
    const std::string format = plan_.reversedDepth ? (stencil ? "DEPTH32F_STENCIL8" : "DEPTH_COMPONENT32F")
                                                   : (stencil ? "DEPTH24_STENCIL8" : "DEPTH_COMPONENT24");
    addChannel("depth", format, stencil ? "depth, and the model's mask value in stencil" : "depth",
               plan_.reversedDepth ? "reversed, so that position has relative error 6e-8 at every distance"
                                   : "for visibility only");
    if (!stencil)
        leaveOut("channel", "stencil",
                 scene_.brdfs.size() <= 1 ? "one shading model covers all pixels: nothing to mask"
                                          : "forward shading needs no mask");
    if (!needsDeferredTargets_) {
        leaveOut("channel", "normal", deferred_ ? "no opaque surface" : "forward shading has no G-buffer");
        return;
    }
    const bool needsPosition = anyLight_ || wants(Aov::depth) || wants(Aov::position);
    if (!plan_.reversedDepth && needsPosition)
        addTarget("linear_z", "R32F", "distance along the view axis, m", "position, without clip control");
    planNormal();
    planGeometricNormal();
    planTangent();
    planMaterialId();
    planParameters();
    planOcclusionChannels();
}

void Planner::planNormal() {
    const bool punctual = scene_.directionalLights + scene_.pointLights + scene_.spotLights > 0;
    double sharpness = 0.0;
    bool read = false;
    for (const BrdfFacts& facts : scene_.brdfs) {
        sharpness = std::max(sharpness, facts.sharpness);
        read |= (punctual && scattersLight(facts.name)) ||
                (!scene_.bodyLights.empty() && showsBodies(facts.name)) || showsEnvironment(facts.name);
    }
    if (!read && !wants(Aov::normal)) {
        leaveOut("channel", "normal",
                 !anyLight_                                         ? "no light reads it"
                 : scene_.bodyLights.empty() && !scene_.environment ? "no opaque surface shows punctual light"
                                                                    : "no opaque surface shows these lights");
        return;
    }
    const int asked = plan_.quality.normalBits;
    const bool full = plan_.quality.gbufferBits == 32;
    const bool sharp = sharpness > kSharpnessOf16Bits;
    normalBits_ = asked != 0 ? asked : full || sharp ? 32 : 16;
    addTarget("normal", unormFormat(2, normalBits_), "octahedral shading normal",
              asked != 0 ? "normal_bits asks for " + std::to_string(asked) + " bits: off by at most " +
                               (asked == 8    ? "1.7e-2"
                                : asked == 16 ? "6.4e-5"
                                              : "3.2e-7") +
                               " rad"
              : full  ? "quality asks for full precision"
              : sharp ? "the sharpest lobe needs a normal better than 6.4e-5 rad"
                      : "16 bits change no lobe here by more than 1 %");
}

void Planner::planGeometricNormal() {
    if (!plan_.anyShadow())
        return leaveOut("channel", "geometric_normal", "no shadow is sought from the surface");
    addTarget("geometric_normal", "RG16", "octahedral normal of the triangle, towards the eye",
              "the way to a light starts beside the surface, not at its shading normal");
}

void Planner::planTangent() {
    const bool used = std::any_of(scene_.brdfs.begin(), scene_.brdfs.end(),
                                  [](const BrdfFacts& facts) { return facts.usesTangent; });
    if (!used || !anyLight_) {
        leaveOut("channel", "tangent", used ? "no light reads it" : "no model in use is anisotropic");
        return;
    }
    addTarget("tangent", "R32F", "direction of the tangent about the normal, with its handedness in the sign",
              "an anisotropic model is turned by it; 32 bits turn a lobe of 1000 : 1 by less than 0.1 %");
}

/// The rows that models read beside their parameters.
void Planner::planTable() {
    for (const auto& [what, materials] : scene_.bands)
        plan_.notes.push_back("Fresnel's equations: " + what + " of wavelength, for " +
                              plural(materials, "material") + "; exact in each, then summed to linear sRGB");
    if (plan_.quality.fresnel == FresnelEquations::schlick) {
        plan_.notes.emplace_back(
            "Fresnel's equations: Schlick's approximation of the same F0 where exact ones were");
        for (const auto& [why, materials] : scene_.keptFresnel)
            plan_.notes.push_back("Fresnel's equations: exact in " + plural(materials, "material") +
                                  ", since " + why);
    }
    if (scene_.bands.empty())
        leaveOut("program part", "bands of wavelength",
                 "no metal is to be evaluated in more than red, green and blue");
    if (scene_.tableRows == 0) {
        leaveOut("buffer", "table of models", "no model in use reads lobes, measurements or bands");
        return;
    }
    const auto most = static_cast<size_t>(capabilities_.maxTextureBufferTexels);
    if (scene_.tableRows > most)
        throw ContextError("the scene's materials have tables of " + std::to_string(scene_.tableRows) +
                           " rows; expected at most " + std::to_string(most) +
                           ", what the driver's buffers hold");
    plan_.notes.push_back("table of models: " + std::to_string(scene_.tableRows) +
                          " rows of lobes, measurements or bands, " +
                          std::to_string(scene_.tableRows * 16 / 1024) + " KiB");
}

void Planner::planMaterialId() {
    const bool table = std::any_of(plan_.brdfs.begin(), plan_.brdfs.end(),
                                   [](const PlannedBrdf& b) { return !b.perMaterial.empty(); });
    table_ = table && (anyLight_ || wants(Aov::albedo) || wants(Aov::roughness));
    if (!table_)
        leaveOut("buffer", "material table",
                 "no parameter differs between materials of one model and reads it");
    if (!table_ && !wants(Aov::materialId)) {
        leaveOut("channel", "material",
                 scene_.materialsInUse.size() <= 1 ? "one material" : "nothing is looked up by material");
        return;
    }
    const int last = scene_.materialsInUse.empty() ? 0 : scene_.materialsInUse.back();
    addTarget("material",
              last < 255     ? "R8UI"
              : last < 65535 ? "R16UI"
                             : "R32UI",
              "index of the material + 1",
              table_ ? "constants that differ by material are looked up in a table" : "asked for as AOV");
}

void Planner::planParameters() {
    const bool read = anyLight_ || wants(Aov::albedo) || wants(Aov::roughness);
    // Targets are shared by all models: each fills them from the first component, normalised values apart
    // from those that need float.
    std::vector<std::string> holds[2];
    int components[2] = {0, 0};
    for (int group : {0, 1}) {
        for (size_t b = 0; b < plan_.brdfs.size(); ++b) {
            const BrdfFacts& facts = scene_.brdfs[b];
            if (facts.name == kUnlit || facts.perPixel.empty()) continue;
            const Brdf& brdf = requireBrdf(facts.name);
            int used = 0;
            std::string names;
            for (int p : facts.perPixel) {
                const Parameter& parameter = brdf.parameters[static_cast<size_t>(p)];
                if (fitsUnorm(parameter) != (group == 0)) continue;
                if (!read) {
                    leaveOut("channel", facts.name + "." + parameter.name, "no light reads it");
                    continue;
                }
                // An RGB triple is kept within one target.
                if (used % 4 + parameter.components() > 4) used += 4 - used % 4;
                plan_.brdfs[b].perPixel.push_back({p, used / 4 + (group == 0 ? 0 : 100), used % 4});
                used += parameter.components();
                names += (names.empty() ? "" : " ") + parameter.name;
            }
            components[group] = std::max(components[group], used);
            if (!names.empty()) holds[group].push_back(facts.name + ": " + names);
        }
    }
    const int unormTargets = (components[0] + 3) / 4;
    for (PlannedBrdf& brdf : plan_.brdfs)
        for (ParameterPlace& place : brdf.perPixel)
            if (place.target >= 100) place.target += unormTargets - 100;
    for (int group : {0, 1})
        for (int first = 0; first < components[group]; first += 4) {
            const int count = std::min(4, components[group] - first);
            std::string what;
            for (const std::string& h : holds[group])
                what += (what.empty() ? "" : "; ") + h;
            const int index = (group == 0 ? 0 : unormTargets) + first / 4;
            addTarget("parameters" + std::to_string(index),
                      unormFormat(count, group == 0 ? plan_.quality.gbufferBits : 32), what,
                      "textures or vertex colours vary it" +
                          std::string(group == 1 ? "; its range needs float" : ""));
        }
    for (size_t b = 0; b < plan_.brdfs.size(); ++b) {
        if (scene_.brdfs[b].name == kUnlit) continue;
        const Brdf& brdf = requireBrdf(scene_.brdfs[b].name);
        for (int p = 0; p < static_cast<int>(brdf.parameters.size()); ++p)
            if (!scene_.brdfs[b].perPixel.contains(p))
                leaveOut("channel", brdf.name + "." + brdf.parameters[static_cast<size_t>(p)].name,
                         scene_.brdfs[b].perMaterial.contains(p)
                             ? "constant per material: kept in the material table"
                             : "the same everywhere: a uniform");
    }
}

void Planner::planRadiance() {
    const bool half = plan_.quality.radianceBits == 16;
    const std::string format = radianceFormat();
    addChannel("radiance", format, "radiance and coverage",
               half ? "radiance_bits asks for 16 bits: each light adds an error of up to 1e-3; from 65504 on "
                      "radiance is infinite"
                    : "32-bit float until output");
    const bool emitted = scene_.emission || scene_.ambient || unlit_;
    gbufferRadiance_ = hasDeferredSurface_ && emitted;
    if (gbufferRadiance_) plan_.gbufferTargets.push_back("radiance");
    if (!scene_.emission) leaveOut("pass", "emission", "no material emits");
    if (!scene_.ambient) leaveOut("pass", "ambient", "the scene has no ambient light");
    if (contributions_) {
        plan_.contributionTargets = {"emission", "ambient", "directional", "point", "spot"};
        for (const auto& [type, count] : scene_.bodyLights)
            plan_.contributionTargets.emplace_back(nameOf(type));
        if (scene_.environment) plan_.contributionTargets.emplace_back("environment");
        if (scene_.fog) plan_.contributionTargets.emplace_back("fog");
        plan_.contributionTargets.emplace_back("transparent");
        for (const std::string& name : plan_.contributionTargets)
            addChannel("contribution." + name, format, "radiance from " + name, "asked for as AOV");
        if (gbufferRadiance_) {
            plan_.gbufferTargets.pop_back();
            plan_.gbufferTargets.push_back("contribution.emission");
            plan_.gbufferTargets.push_back("contribution.ambient");
        }
    }
    if (static_cast<int>(plan_.gbufferTargets.size()) > capabilities_.maxColorAttachments)
        throw ContextError("the scene needs " + std::to_string(plan_.gbufferTargets.size()) +
                           " G-buffer targets; the driver has " +
                           std::to_string(capabilities_.maxColorAttachments));
}

void Planner::planVertexData() {
    if (!scene_.tangents) leaveOut("vertex data", "tangents", "no normal map and no anisotropic model");
    if (!scene_.vertexColors) leaveOut("vertex data", "colours", "no primitive has them");
    for (int set : {0, 1})
        if (std::none_of(plan_.surfaces.begin(), plan_.surfaces.end(),
                         [set](const SurfaceFeatures& f) { return f.usesUv(set); }))
            leaveOut("vertex data", "UV set " + std::to_string(set), "no texture in use is placed by it");
}

}  // namespace lobe
