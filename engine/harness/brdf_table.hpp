/// Tables of directions and parameters for a reflectance model, its GLSL evaluated over them, and its twin
/// beside it.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "harness/evaluator.hpp"
#include "shading/brdf.hpp"

namespace lobe::harness {

/// One configuration. Everything is a float first: GLSL and twin see the same numbers.
struct BrdfRow {
    std::string kind;           ///< "random", "grazing", ...
    glm::vec3 wi, wo;           ///< unit to float rounding
    std::vector<float> values;  ///< in the order of ParameterValues, without the table
    int table = -1;             ///< index into the tables of the model's examples
};

/// Configurations of every kind, `perKind` each, directions in the local frame: anywhere on the upper
/// hemisphere, grazing to 1e-7 rad (either or both), normal incidence, L = V, L near -V, near the mirrored
/// direction at distances of 1e-4 to 10 widths of the lobe. Parameters cover their ranges, evenly and by
/// powers of ten, with their ends.
std::vector<BrdfRow> brdfRows(const Brdf& brdf, int perKind, uint64_t seed);

/// Configurations that no scene should contain and no shader may trip over: below the horizon, on it,
/// denormal cosines, L = -V exactly, directions of zero length.
std::vector<BrdfRow> hostileRows(const Brdf& brdf, uint64_t seed);

/// Tables one after the other, as GLSL reads them, and where each starts.
struct PackedTables {
    std::vector<float> floats;
    std::vector<int> firstRow;
};
PackedTables packTables(std::span<const TableRows> tables);
PackedTables packTables(const Brdf& brdf);  ///< those of its examples

/// What the GLSL functions of a model gave for one row.
struct BrdfResult {
    glm::vec3 fCos, ambient;
    float roughness;
    glm::vec3 mirror;  ///< for wo's angle; 0 where the model has no such part
};

/// The GLSL of a model, with directions given in the local frame.
class BrdfEvaluator {
public:
    BrdfEvaluator(const gl::ShaderLibrary& library, const Brdf& brdf);
    std::vector<BrdfResult> evaluate(const std::vector<BrdfRow>& rows) const;
    /// With tables other than the examples: BrdfRow::table is an index into `tables`.
    std::vector<BrdfResult> evaluate(const std::vector<BrdfRow>& rows,
                                     std::span<const TableRows> tables) const;

private:
    const Brdf& brdf_;
    Evaluator evaluator_;
};

/// The same through common/dirs.glsl: directions given in world axes, with a unit normal a row.
class WorldBrdfEvaluator {
public:
    WorldBrdfEvaluator(const gl::ShaderLibrary& library, const Brdf& brdf);
    std::vector<glm::vec3> evaluate(const std::vector<BrdfRow>& rows,
                                    const std::vector<glm::vec3>& normals) const;

private:
    const Brdf& brdf_;
    Evaluator evaluator_;
};

/// The directions that a row's floats stand for: normalised in double.
Directions directionsOf(const BrdfRow& row);
/// With the numbers of its table, which are rounded to floats as GLSL sees them.
ParameterValues valuesOf(const Brdf& brdf, const BrdfRow& row);

}  // namespace lobe::harness
