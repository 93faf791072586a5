/// Fits along the angles of view, of one lobe at one width: all angles at once, so that what is interpolated
/// between them fits as well as they do.
#pragma once

#include <vector>

#include "base/thread_team.hpp"
#include "fit/lobe_search.hpp"

namespace lobe::fit {

/// Samples at nodes 0, 1, ... and halfway between them: 2 n - 1 in turn for n nodes, and how much each
/// counts.
struct RowSamples {
    std::vector<SearchSamples> places;
    std::vector<double> importance;

    size_t nodes() const { return places.size() / 2 + 1; }
    const SearchSamples& node(size_t n) const { return places[2 * n]; }
};

struct RowFit {
    std::vector<Numbers> nodes;
    /// Mean of the costs by their importance, over the places that count: not those that reflect nothing, nor
    /// those beside them.
    double cost = 0.0;
};

/// The best of several searches. Lobes are round at the first node.
RowFit fitRow(const RowSamples& samples, bool cosines, ThreadTeam& team);
/// The one of the same kind as that of another row, of a width not far off: so that what is interpolated
/// between both fits too. If nothing comes of it, a fresh one.
RowFit fitRowLike(const RowFit& other, const RowSamples& ofOther, const RowSamples& samples, bool cosines,
                  ThreadTeam& team);

}  // namespace lobe::fit
