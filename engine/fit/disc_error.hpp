/// How far a table is from its model: lights that are discs in the sky, as the fit and as the model reflect
/// them.
#pragma once

#include "fit/area_table.hpp"

namespace lobe::fit {

/// Shares of the mean that the model reflects from such discs at this angle of view, of the colour of red,
/// green and blue that is the farthest off.
struct DiscError {
    double mean = 0.0;   ///< mean of the absolute differences
    double worst = 0.0;  ///< largest of them
};

struct DiscOptions {
    int discs = 150;  ///< half of them centred as the lobe is distributed, half anywhere above the horizon
    double smallest = 2.5, largest = 20.0;  ///< angular radius, degrees: discs of 5 to 40 degrees
    size_t draws = 20000;
    uint64_t seed = 7;
};

/// Of the fitted part, without Lambert's, for the colours in `values`, at one angle of view and width. The
/// error is integrated by samples of the difference, so that it has no noise where there is none.
DiscError discError(const TableRequest& request, const AreaTable& table, double oneMinusCos,
                    const DiscOptions& options = {});

}  // namespace lobe::fit
