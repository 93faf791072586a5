/// Arbitrary output variables: pictures of quantities other than radiance.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace lobe {

enum class Aov : uint8_t {
    radiance,      ///< R G B A, W/(m^2 sr); A is coverage
    depth,         ///< depth.Z: metres along the view axis; 0 where nothing is
    position,      ///< position.X Y Z: world, metres
    normal,        ///< normal.X Y Z: world, shading normal
    albedo,        ///< albedo.R G B: the model's ambient reflectance (base colour, k_d)
    materialId,    ///< material.id: index in the file + 1; 0 where nothing is
    roughness,     ///< roughness.Y: metallic_roughness's r; other models: the equivalent r; 1 for Lambert
    contributions  ///< emission, ambient, directional, point, spot, fog, transparent: R G B each, of those
                   ///< that the scene can have; their sum is radiance
};

/// Names as on the command line, in the order of the enumeration: radiance, depth, ..., material_id, ...
const std::vector<std::string>& aovNames();
using AovSet = std::set<Aov>;

}  // namespace lobe
