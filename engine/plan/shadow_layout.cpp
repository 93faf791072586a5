#include "plan/shadow_layout.hpp"

#include <cmath>
#include <numbers>

namespace lobe {
namespace {

constexpr double kTangentOfWidestSpot = 2.0;

}  // namespace

bool needsCube(const Light& light) {
    if (light.type != LightType::spot) return light.type != LightType::directional;
    return light.outerConeAngle >= 0.5 * std::numbers::pi ||
           std::tan(light.outerConeAngle) > kTangentOfWidestSpot;
}

int filterSide(int taps) {
    int side = 1;
    while ((side + 1) * (side + 1) <= taps)
        ++side;
    return side;
}

ShadowTile wholeTile(const PlannedShadowMaps& maps, int index) {
    return {index, 0, 0, maps.size};
}

ShadowTile quarterOf(const ShadowTile& tile, int quarter) {
    const int size = tile.size / 2;
    return {tile.layer, tile.x + quarter % 2 * size, tile.y + quarter / 2 * size, size};
}

ShadowTile cubeTile(const PlannedShadowMaps& maps, int cube, int face) {
    const int index = 6 * cube + face;
    return quarterOf(wholeTile(maps, maps.whole + index / 4), index % 4);
}

}  // namespace lobe
