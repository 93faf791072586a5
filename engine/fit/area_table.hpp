/// Fits of a material's lobe for all angles of view, and for all widths where a texture varies the width, as
/// a table that GLSL reads (light/transformed_lobe.glsl).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/thread_team.hpp"
#include "fit/lobe_fit.hpp"
#include "shading/brdf.hpp"

namespace lobe::fit {

/// Changes whenever the same values would be fitted otherwise: part of the key under which tables are kept.
inline constexpr int kFitVersion = 3;

/// What a table is made for.
struct TableRequest {
    const Brdf* brdf;
    ParameterValues values;
    /// A texture varies one of AreaModel::colors: one fit a term, which pixels weigh. Else one fit of all
    /// with the material's own colours.
    bool colorsVary = false;
    /// A texture varies AreaModel::width.
    bool widthVaries = false;
};

/// The request with what varies, and so is not in the table, at the model's defaults: alike for all materials
/// that one table serves.
TableRequest normalised(TableRequest request);

/// Whether the weights of a model's two terms differ in hue: lobes that stand for both in the mean of the
/// colours are then wrong in each, and one fit a term is made (`colorsVary`).
bool huesDiffer(const Brdf& brdf, std::span<const double> values);

/// The largest distance of a colour's lobe from the mean of the colours', each of them of albedo 1: half the
/// integral of the absolute difference, over angles of view to 75 degrees.
double colorDistance(const Brdf& brdf, std::span<const double> values);

/// Texels of its table.
int tableTexels(const TableRequest& request);

/// Why no table is made for these values, in words, or nothing if one is.
std::optional<std::string> refusal(const TableRequest& request);

/// Four numbers a texel. The first: number of angles, of widths, ln of the least width, widths per unit of
/// ln. Then the nodes, angle by angle within a width: a texel with the base's factor; then, for each term,
/// for each lobe: the first four of LobeShape5; weight in red, green and blue, ln k.
struct AreaTable {
    int terms = 1;         ///< 0: Lambert's part alone
    bool cosines = false;  ///< k is 1 in all
    std::vector<float> texels;

    int angles() const { return static_cast<int>(texels[0]); }
    int widths() const { return static_cast<int>(texels[1]); }
    int nodeTexels() const { return 1 + 2 * static_cast<int>(kLobes) * terms; }
};

/// The angle of view at which a node stands: 1 - cos of it. Nodes are at equal steps of the angle whose
/// squared cosine is N.V, from 0 to what N.V = 1e-4 gives.
inline constexpr int kAngleNodes = 41;
inline constexpr double kLeastCosine = 1e-4;
double oneMinusCosAt(double node);
/// The place among the nodes, 0 .. kAngleNodes - 1, of any angle.
double angleCoordinate(double oneMinusCos);

/// Fits all nodes, on all cores or with the threads that are given: alike on any number of them.
AreaTable makeTable(const TableRequest& request);
AreaTable makeTable(const TableRequest& request, ThreadTeam& team);

/// A lobe as the table has it at one angle and width, by linear interpolation of its numbers.
struct TableLobe {
    TransformedLobe lobe;
    glm::dvec3 weight{0.0};
};
struct TablePoint {
    double base = 1.0;
    std::vector<TableLobe> lobes;  ///< kLobes of each term
};
/// The twin of transformed_lobe_fetch in GLSL. `width` counts where the table spans widths.
TablePoint at(const AreaTable& table, double oneMinusCos, double width);

}  // namespace lobe::fit
