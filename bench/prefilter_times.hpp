/// How long an environment takes to be prefiltered, against what has to be read and written.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace lobe::bench {

struct PrefilterTime {
    std::string what;        ///< "map", "tree", a model, "one model", "nine models"
    double seconds = 0.0;    ///< by the clock, least of the rounds
    double processor = 0.0;  ///< s of all cores together, which other programs hardly change
    double bytes = 0.0;      ///< that are read and written at least
    double samples = 0.0;    ///< of the map's levels that layers are sums of
    double floor = 0.0;  ///< s of all cores together: those bytes copied, those samples read from one level
};

/// Of all widths of the nine models that have one lobe about one axis, from `narrowest` to 1.
std::vector<PrefilterTime> prefilterTimes(const Bitmap& bitmap, double narrowest, int rounds,
                                          const std::function<void(const PrefilterTime&)>& done);

}  // namespace lobe::bench
