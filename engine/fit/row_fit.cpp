#include "fit/row_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lobe::fit {
namespace {

/// Where searches begin: nodes' places along the row. Lobes differ most from round ones at 69 degrees and are
/// still resolved there; at 0 they are round.
constexpr std::array<std::array<double, 2>, 2> kBeginnings{{{0.75, 0.5}, {0.0, 0.975}}};
/// Of a node's numbers to its neighbour's, in units of the root of the cost: holds what the samples do not.
constexpr double kSmoothness = 5e-3;
constexpr int kMostSteps = 60;

/// The numbers halfway between two nodes as tables are interpolated, and what their derivatives by those of
/// the nodes are.
struct Between {
    Numbers numbers;
    Numbers byFirst, bySecond;

    Between(const Numbers& a, const Numbers& b, double albedoA, double albedoB, double albedo)
        : numbers(0.5 * (a + b)), byFirst(Numbers::Constant(0.5)), bySecond(byFirst) {
        for (int i = kWeightAt; i < kAllNumbers; i += kLobeNumbers) {
            const double ofA = albedoA * std::exp(a[i]), ofB = albedoB * std::exp(b[i]);
            numbers[i] = std::log(0.5 * (ofA + ofB) / albedo);
            byFirst[i] = ofA / (ofA + ofB);
            bySecond[i] = ofB / (ofA + ofB);
        }
    }
};

/// All nodes' numbers, and the sum of costs over a row.
class RowSearch {
public:
    RowSearch(const RowSamples& samples, bool cosines, ThreadTeam& team)
        : samples_(samples), cosines_(cosines), team_(team) {}

    RowFit improved(std::vector<Numbers> nodes) {
        RowFit fit{std::move(nodes), HUGE_VAL};
        if (!evaluate(fit.nodes)) return fit;
        double objective = objective_;
        const auto accept = [&] {
            gather(fit.nodes);
            objective = objective_;
        };
        accept();
        double damping = 1e-3;
        int idle = 0;
        for (int i = 0; i < kMostSteps && idle < 2; ++i) {
            const std::vector<Numbers> next = step(fit.nodes, damping);
            if (!evaluate(next) || !(objective_ < objective)) {
                damping *= 8.0;
                if (damping > 1e5) break;
                continue;
            }
            constexpr double kLittle = 4e-3;
            idle = objective - objective_ < kLittle * objective ? idle + 1 : 0;
            fit.nodes = next;
            damping = std::max(damping * 0.2, 1e-7);
            accept();
        }
        evaluate(fit.nodes);
        double sum = 0.0, total = 0.0;
        for (size_t p = 0; p < slopes_.size(); ++p) {
            if (!counts(p)) continue;
            sum += samples_.importance[p] * slopes_[p].cost;
            total += samples_.importance[p];
        }
        fit.cost = total > 0.0 ? sum / total : 0.0;
        return fit;
    }

private:
    FitOptions optionsAt(size_t node) const {
        FitOptions options;
        options.cosines = cosines_;
        options.roundAbout = node == 0;
        return options;
    }

    Between between(const std::vector<Numbers>& nodes, size_t first) const {
        return {nodes[first], nodes[first + 1], samples_.node(first).albedo(),
                samples_.node(first + 1).albedo(), samples_.places[2 * first + 1].albedo()};
    }

    bool counts(size_t place) const {
        if (samples_.places[place].dark()) return false;
        // Beside a dark node weights are of nothing.
        return place % 2 == 0 || !(samples_.places[place - 1].dark() || samples_.places[place + 1].dark());
    }

    /// Fills slopes_ and objective_. False where a lobe is folded over.
    bool evaluate(const std::vector<Numbers>& nodes) {
        slopes_.assign(samples_.places.size(), {});
        std::vector<char> folded(slopes_.size(), 0);
        team_.each(slopes_.size(), [&](size_t p) {
            if (!counts(p)) return;
            const Numbers numbers = p % 2 == 0 ? nodes[p / 2] : between(nodes, p / 2).numbers;
            if (const auto slope = slopeAt(numbers, samples_.places[p], cosines_))
                slopes_[p] = *slope;
            else
                folded[p] = 1;
        });
        if (std::find(folded.begin(), folded.end(), 1) != folded.end()) return false;
        objective_ = 0.0;
        for (size_t p = 0; p < slopes_.size(); ++p)
            objective_ += samples_.importance[p] * slopes_[p].cost;
        for (size_t n = 0; n + 1 < nodes.size(); ++n)
            objective_ += kSmoothness * kSmoothness * (nodes[n + 1] - nodes[n]).squaredNorm();
        return true;
    }

    /// Derivatives by the nodes' numbers, from slopes_.
    void gather(const std::vector<Numbers>& nodes) {
        const size_t count = nodes.size();
        gradients_.assign(count, Numbers::Zero());
        diagonal_.assign(count, Curvature::Zero());
        beside_.assign(count, Curvature::Zero());
        const double smooth = kSmoothness * kSmoothness;
        for (size_t p = 0; p < slopes_.size(); ++p) {
            const size_t n = p / 2;
            const double importance = samples_.importance[p];
            if (p % 2 == 0) {
                gradients_[n] += importance * slopes_[p].gradient;
                diagonal_[n] += importance * slopes_[p].curvature;
                continue;
            }
            const Numbers apart = smooth * (nodes[n + 1] - nodes[n]);
            gradients_[n] -= apart;
            gradients_[n + 1] += apart;
            diagonal_[n].diagonal().array() += smooth;
            diagonal_[n + 1].diagonal().array() += smooth;
            beside_[n].diagonal().array() -= smooth;
            if (!counts(p)) continue;
            const Between middle = between(nodes, n);
            const auto first = middle.byFirst.asDiagonal(), second = middle.bySecond.asDiagonal();
            gradients_[n] += importance * (first * slopes_[p].gradient);
            gradients_[n + 1] += importance * (second * slopes_[p].gradient);
            diagonal_[n] += importance * (first * slopes_[p].curvature * first);
            diagonal_[n + 1] += importance * (second * slopes_[p].curvature * second);
            beside_[n] += importance * (first * slopes_[p].curvature * second);
        }
    }

    /// The damped step: block by block elimination, as each node is coupled to its neighbours alone.
    std::vector<Numbers> step(const std::vector<Numbers>& from, double damping) const {
        const size_t count = from.size();
        std::vector<Curvature> free(count), upper(count);
        std::vector<Numbers> right(count);
        std::vector<Eigen::LDLT<Curvature>> pivots(count);
        for (size_t n = 0; n < count; ++n)
            free[n] = freedom(from[n], gradients_[n], optionsAt(n));
        for (size_t n = 0; n < count; ++n) {
            Curvature block = free[n].transpose() * diagonal_[n] * free[n];
            for (int i = 0; i < kAllNumbers; ++i)
                block(i, i) += damping * (block(i, i) + 1e-6) + 1e-9;
            right[n] = -(free[n].transpose() * gradients_[n]);
            if (n > 0) {
                block -= upper[n - 1].transpose() * pivots[n - 1].solve(upper[n - 1]);
                right[n] -= upper[n - 1].transpose() * pivots[n - 1].solve(right[n - 1]);
            }
            if (n + 1 < count) upper[n] = free[n].transpose() * beside_[n] * free[n + 1];
            pivots[n].compute(block);
        }
        std::vector<Numbers> to(count);
        for (size_t n = count; n-- > 0;) {
            if (n + 1 < count) right[n] -= upper[n] * right[n + 1];
            right[n] = pivots[n].solve(right[n]);
            to[n] = stepped(from[n], free[n] * right[n]);
        }
        return to;
    }

    const RowSamples& samples_;
    bool cosines_;
    ThreadTeam& team_;
    std::vector<Slope> slopes_;
    double objective_ = 0.0;
    std::vector<Numbers> gradients_;
    std::vector<Curvature> diagonal_, beside_;
};

/// Numbers that are the same all about, as they are where the eye looks straight down.
Numbers round(Numbers numbers) {
    for (int o = 0; o < kAllNumbers; o += kLobeNumbers) {
        numbers[o] = numbers[o + 2] = 0.5 * (numbers[o] + numbers[o + 2]);
        numbers[o + 1] = numbers[o + 3] = 0.0;
    }
    return numbers;
}

/// Fits from one node on, each from its neighbour's.
std::vector<Numbers> continued(const RowSamples& samples, size_t fresh, bool cosines) {
    std::vector<Numbers> nodes(samples.nodes(), Numbers::Zero());
    FitOptions options;
    options.cosines = cosines;
    const auto improveAt = [&](size_t n, const Numbers& start) {
        nodes[n] = samples.node(n).dark() ? start : improve(start, samples.node(n), options).numbers;
    };
    if (samples.node(fresh).dark()) return nodes;
    FitOptions thorough = options;
    thorough.evaluations = 100;
    thorough.roundAbout = fresh == 0;
    nodes[fresh] = fitFresh(samples.node(fresh), thorough).numbers;
    for (size_t n = fresh + 1; n < nodes.size(); ++n)
        improveAt(n, nodes[n - 1]);
    for (size_t n = fresh; n-- > 1;)
        improveAt(n, nodes[n + 1]);
    if (fresh > 0) {
        options.roundAbout = true;
        improveAt(0, round(nodes[1]));
    }
    return nodes;
}

/// Fits of another row, wider or narrower as its lobes are.
std::vector<Numbers> rescaled(std::vector<Numbers> nodes, const RowSamples& from, const RowSamples& to) {
    for (size_t n = 0; n < nodes.size(); ++n) {
        const double narrower = std::log(from.node(n).medianSlope() / to.node(n).medianSlope());
        for (int o = 0; o < kAllNumbers; o += kLobeNumbers) {
            nodes[n][o] += narrower;
            nodes[n][o + 2] += narrower;
        }
    }
    return nodes;
}

}  // namespace

RowFit fitRowLike(const RowFit& other, const RowSamples& ofOther, const RowSamples& samples, bool cosines,
                  ThreadTeam& team) {
    RowFit fit = RowSearch(samples, cosines, team).improved(rescaled(other.nodes, ofOther, samples));
    return std::isfinite(fit.cost) ? fit : fitRow(samples, cosines, team);
}

RowFit fitRow(const RowSamples& samples, bool cosines, ThreadTeam& team) {
    RowSearch search(samples, cosines, team);
    // Starts from two ends that come to the same are taken for the best there is.
    constexpr double kAlike = 1.05;
    RowFit best;
    for (const std::array<double, 2>& pair : kBeginnings) {
        std::array<RowFit, 2> fits;
        team.each(pair.size(), [&](size_t i) {
            const auto fresh = static_cast<size_t>(pair[i] * static_cast<double>(samples.nodes() - 1));
            fits[i].nodes = continued(samples, fresh, cosines);
        });
        for (RowFit& fit : fits) {
            fit = search.improved(std::move(fit.nodes));
            if (best.nodes.empty() || fit.cost < best.cost) best = fit;
        }
        if (std::max(fits[0].cost, fits[1].cost) < kAlike * best.cost) break;
    }
    return best;
}

}  // namespace lobe::fit
