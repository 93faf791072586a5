// Shadow maps: how many, how large, and the pass that draws them.
#include <algorithm>

#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {
namespace {

/// Of all maps together; above it they are made smaller.
constexpr size_t kMostBytes = size_t{512} << 20;
/// Below it shadows would be worth nothing: the plan refuses.
constexpr int kSmallestMap = 128;

size_t bytesOf(const PlannedShadowMaps& maps) {
    return static_cast<size_t>(maps.layers()) * static_cast<size_t>(maps.size) *
           static_cast<size_t>(maps.size) * 4;
}

std::string sizeText(int size) {
    return std::to_string(size) + " x " + std::to_string(size);
}

}  // namespace

void Planner::planShadowMaps() {
    const auto casting = [this](LightType type) {
        return plan_.shadowOf(type) == PlannedShadow::maps ? scene_.castingLights(type) : 0;
    };
    PlannedShadowMaps& maps = plan_.shadowMaps;
    const int wide = casting(LightType::spot) > 0 ? scene_.wideShadowSpots : 0;
    maps.whole = casting(LightType::directional) + casting(LightType::spot) - wide;
    maps.cubes = casting(LightType::point) + wide;
    for (const auto& [type, lights] : scene_.bodyLights)
        maps.cubes += casting(type);
    if (maps.layers() == 0) {
        const std::string reason =
            plan_.anyShadow() ? "all shadows are found by rays" : "no shadow is sought";
        leaveOut("pass", "shadow.maps", reason);
        leaveOut("channel", "shadow.maps", reason);
        return;
    }
    maps.filterSide = filterSide(plan_.quality.shadowTaps);
    planShadowMapSize();
    const std::string lights = plural(maps.whole + maps.cubes, "light");
    std::string holds;
    const auto say = [&holds](int count, const std::string& what) {
        if (count > 0) holds += (holds.empty() ? "" : "; ") + what;
    };
    say(casting(LightType::directional),
        plural(casting(LightType::directional), "directional light") +
            ": a layer each, or a quarter of it for each of four depths of the view");
    say(casting(LightType::spot) - wide,
        plural(casting(LightType::spot) - wide, "spot light") + ": a layer each");
    say(maps.cubes, std::to_string(maps.cubes) + " of points, wide spots or lights with a body" +
                        ": six faces of a cube, a quarter of a layer each");
    addChannel("shadow.maps", "DEPTH_COMPONENT32F", "depth from the light; " + holds,
               plural(maps.layers(), "layer") + " of " + sizeText(maps.size) + ", " +
                   std::to_string(bytesOf(maps) >> 20) +
                   " MiB; depth that grows towards the light keeps its digits");
    PlannedPass pass{"shadow.maps", "shadow/map.frag", {}, {}, {"shadow.maps"}, ""};
    for (size_t i = 0; i < plan_.surfaces.size(); ++i) {
        const SurfaceFeatures& features = plan_.surfaces[i];
        if (features.alphaMode == AlphaMode::blend) continue;
        Defines defines;
        if (!plan_.reversedDepth) defines["WRITE_DEPTH"] = "1";
        if (features.alphaMode == AlphaMode::mask) {
            defines["ALPHA_MASK"] = "1";
            if (features.usesUv(0)) defines["UV0"] = "1";
            if (features.usesUv(1)) defines["UV1"] = "1";
            if (features.vertexColors) defines["VERTEX_COLORS"] = "1";
        }
        pass.variants.push_back({"", static_cast<int>(i), defines});
    }
    pass.reason = lights + (maps.whole + maps.cubes == 1 ? " casts" : " cast") +
                  " shadows by maps; drawn once a scene, and where parallel light's follow the camera";
    plan_.passes.push_back(pass);
    const std::string side = std::to_string(maps.filterSide);
    plan_.notes.push_back("shadow maps: " + side + " x " + side +
                          " bilinear comparisons a look; edges are off by about " +
                          std::to_string(maps.filterSide) + " texels at most");
    if (scene_.blendedCasters)
        plan_.notes.emplace_back("shadow maps: blended surfaces cast no shadow in them; rays have them");
}

/// The size that is asked for, or what the driver and kMostBytes allow.
void Planner::planShadowMapSize() {
    PlannedShadowMaps& maps = plan_.shadowMaps;
    const int asked = plan_.quality.shadowSize;
    maps.size = std::min(asked, capabilities_.maxTextureSize);
    while (maps.size >= kSmallestMap && bytesOf(maps) > kMostBytes)
        maps.size /= 2;
    const int lights = maps.whole + maps.cubes;
    if (maps.size < kSmallestMap || maps.layers() > capabilities_.maxArrayLayers)
        throw ContextError("shadow maps of " + plural(lights, "light") + " take " +
                           plural(maps.layers(), "layer") + "; expected at most " +
                           std::to_string(capabilities_.maxArrayLayers) + " layers and " +
                           std::to_string(kMostBytes >> 20) + " MiB at " + sizeText(kSmallestMap) +
                           "; --shadow-method rays has no such limit");
    if (maps.size == asked) return;
    plan_.notes.push_back(
        "shadow maps: " + sizeText(maps.size) + " in place of " + sizeText(asked) + ", since " +
        (asked > capabilities_.maxTextureSize ? "the driver's textures are no larger"
                                              : plural(maps.layers(), "layer") + " would take more than " +
                                                    std::to_string(kMostBytes >> 20) + " MiB"));
}

void Planner::shadowMapDefines(Defines& defines, LightType type) const {
    if (plan_.shadowOf(type) != PlannedShadow::maps) return;
    defines["SHADOW_SIDE"] = std::to_string(plan_.shadowMaps.filterSide);
    if (!isPunctual(type)) defines["SHADOW_TAPS"] = std::to_string(plan_.quality.shadowTaps);
    if (type == LightType::spot && scene_.wideShadowSpots > 0) defines["WIDE_SPOT_SHADOWS"] = "1";
}

}  // namespace lobe
