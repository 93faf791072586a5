/// Where shadow maps lie: tiles in the layers of one array texture, by light.
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace lobe {

/// What shadow maps a plan holds, and how they are read.
struct PlannedShadowMaps {
    int size = 0;        ///< texels a side of each layer; 0: no maps
    int whole = 0;       ///< lights with a layer of their own: directional, narrow spots
    int cubes = 0;       ///< lights with six quarters of a layer: points, wide spots
    int filterSide = 1;  ///< bilinear comparisons a side of the filter

    int layers() const { return whole + (6 * cubes + 3) / 4; }
};

/// A square of a layer, in texels.
struct ShadowTile {
    int layer = 0, x = 0, y = 0, size = 0;
};

/// Wider cones than this (63 degrees from the axis) take the six faces of a cube: one map of twice a face's
/// side would have larger texels in its middle.
bool needsCube(const Light& light);

/// Comparisons a side of the square filter that has at most `taps` of them.
int filterSide(int taps);

/// Tile of a light with a layer of its own, counted among these; a cascade's is a quarter of it.
ShadowTile wholeTile(const PlannedShadowMaps& maps, int index);
ShadowTile quarterOf(const ShadowTile& tile, int quarter);
/// Tile of a cube's face (0 to 5), cubes counted among themselves.
ShadowTile cubeTile(const PlannedShadowMaps& maps, int cube, int face);

}  // namespace lobe
