#include "plot/slice.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "plot/geometry.hpp"
#include "shading/merl.hpp"

namespace lobe::plot {
namespace {

void setTones(Slice& slice) {
    std::vector<double> positive;
    for (const SliceCell& cell : slice.cells)
        for (int c = 0; c < 3; ++c)
            if (cell.f[c] > 0.0) positive.push_back(cell.f[c]);
    if (positive.empty()) return;
    std::sort(positive.begin(), positive.end());
    slice.reference = positive[positive.size() / 10];
    slice.brightest = positive[positive.size() - 1 - positive.size() / 100];
    const double scale = 255.0 / std::log1p(slice.brightest / slice.reference);
    for (SliceCell& cell : slice.cells)
        for (int c = 0; c < 3; ++c)
            cell.tone[static_cast<size_t>(c)] = static_cast<uint8_t>(
                std::lround(std::min(scale * std::log1p(cell.f[c] / slice.reference), 255.0)));
}

}  // namespace

Slice computeSlice(const Sampler& sampler, const SliceRequest& request) {
    requireScatters(request.model);
    Slice slice{request, 0.0, 0.0, {}};
    std::vector<Pair> pairs;
    const auto angle = [&](int i) { return 90.0 * (i + 0.5) / request.cells; };
    for (int d = 0; d < request.cells; ++d)
        for (int h = 0; h < request.cells; ++h) {
            slice.cells.push_back({angle(h), angle(d), glm::dvec3(0.0), {}});
            const Directions directions = shading::fromHalfAndDifference(
                glm::radians(angle(h)), glm::radians(angle(d)), glm::radians(request.phiD));
            pairs.push_back({directions.wi, directions.wo});
        }
    const std::vector<Sample> samples = sampler.sample(request.model, pairs);
    for (size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].wi.z > 0.0) slice.cells[i].f = samples[i].fCos / pairs[i].wi.z;
    setTones(slice);
    return slice;
}

}  // namespace lobe::plot
