/// Looks that all plots share.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plot/lobes.hpp"

namespace lobe::plot {

/// Palette and lines for all pictures.
extern const char* const kStyleCommands;

/// Okabe and Ito's colours, which all common kinds of colour vision tell apart, without yellow, which is too
/// pale for lines; they repeat.
std::string seriesColor(size_t index);

/// Of viridis (van der Walt and Smith, 2015; CC0), 0 to 1 from dark to light, as "#rrggbb".
std::string sequentialColor(double share);

/// "$NAME << EOD" with the lines.
std::string dataBlock(const std::string& name, const std::vector<std::string>& lines);

/// "f_r cos θ_i" and what it is, for axes and captions.
std::string quantityText(Quantity quantity);
std::string channelText(Channel channel);

/// A tick's place on an axis, and what it says.
using Ticks = std::vector<std::pair<double, std::string>>;
std::string ticksText(const Ticks& ticks);

/// The largest of 1, 2 and 5 times a power of ten that is at most `maximum` > 0.
double roundBelow(double maximum);

/// Round values from 0 to `maximum`, about `count` of them.
std::vector<double> roundSteps(double maximum, int count);
/// 1, 2 and 5 times powers of ten from `minimum` to `maximum`, or powers only where those are many.
std::vector<double> roundPowers(double minimum, double maximum);

/// "alpha" or "sigma [m]".
std::string axisName(const Model& model, const std::string& parameter);

/// A rectangle of coloured cells, x in equal steps; y in equal steps, or in equal ratios where it is wide.
struct HeatMap {
    std::string xName, yName, zName;
    std::vector<double> x, y;
    std::vector<std::vector<double>> z;  ///< z[ix][iy]
    double zMinimum = 0.0, zMaximum = 1.0;
    bool zIsLog = false;
    double xStep = 15.0;  ///< between ticks
};
std::string heatMapCommands(const HeatMap& map);

}  // namespace lobe::plot
