#include "fit/area_table.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "fit/lobe_samples.hpp"

namespace lobe::fit {
namespace {

constexpr size_t kFitDraws = 1024;     // of each search
constexpr size_t kWeightDraws = 4096;  // of weights and albedos
constexpr int kWidthNodes = 24;
/// Where rows may begin: 69 degrees, where lobes differ most from round ones and are still resolved; 49; and
/// 0, where they are round.
constexpr std::array kFreshNodes{30, 20, 0};
constexpr int kSmoothings = 2;

/// What one fit stands for: a term on its own, or all terms with the material's colours.
struct Target {
    bool baked;
    size_t term;  ///< where not baked
    AreaWeights weights;

    glm::dvec3 of(const AreaTerms& terms) const {
        if (!baked) return terms.terms[term];
        return weights.terms[0] * terms.terms[0] + weights.terms[1] * terms.terms[1];
    }
};

double meanOf(const glm::dvec3& rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3.0;
}

std::vector<LobeSample> lobeSamples(const std::vector<TermSample>& samples, const Target& target) {
    std::vector<LobeSample> result;
    result.reserve(samples.size());
    for (const TermSample& s : samples)
        result.push_back({s.w, meanOf(target.of(s.terms)), s.density});
    return result;
}

bool isDark(const std::vector<LobeSample>& samples) {
    return std::all_of(samples.begin(), samples.end(), [](const LobeSample& s) { return !(s.value > 0.0); });
}

LobeFit between(const LobeFit& a, const LobeFit& b, double share) {
    LobeFit fit = a;
    for (size_t j = 0; j < kLobes; ++j) {
        for (size_t i = 0; i < fit.shapes[j].size(); ++i)
            fit.shapes[j][i] += share * (b.shapes[j][i] - a.shapes[j][i]);
        fit.weights[j] += share * (b.weights[j] - a.weights[j]);
    }
    return fit;
}

/// One width: fits along the angles of view, each from its neighbour's, so that their numbers change
/// continuously.
class Row {
public:
    Row(const std::vector<std::vector<TermSample>>& samples, const Target& target, bool cosines) {
        options_.cosines = cosines;
        for (const auto& ofNode : samples)
            samples_.push_back(lobeSamples(ofNode, target));
    }

    /// Some beginnings lead to a place where two kinds of fit meet, which are no good in between.
    std::vector<LobeFit> fits(const std::vector<LobeFit>& likeThese) {
        std::vector<LobeFit> best;
        double least = HUGE_VAL;
        for (int node : kFreshNodes) {
            fitFrom(node, likeThese);
            const auto [cost, added] = costBetween();
            if (cost < least) {
                least = cost;
                best = fits_;
            }
            if (added < kGoodBetween) break;
        }
        return best;
    }

private:
    /// About 1 % of the light of discs.
    static constexpr double kGoodBetween = 3e-3;

    void fitFrom(int fresh, const std::vector<LobeFit>& likeThese) {
        fits_.assign(samples_.size(), {});
        const auto last = static_cast<int>(samples_.size()) - 1;
        startAt(fresh, likeThese);
        for (int n = fresh + 1; n <= last; ++n)
            improveAt(n, fit(n - 1));
        for (int n = fresh - 1; n > 0; --n)
            improveAt(n, fit(n + 1));
        if (fresh > 0) roundAt0();
        for (int pass = 0; pass < kSmoothings; ++pass)
            for (int n = 1; n < last; ++n)
                improveAt(n, between(fit(n - 1), fit(n + 1), 0.5));
    }

    /// Largest cost where a node is interpolated from its neighbours, and the most that this adds, up to 85
    /// degrees.
    std::pair<double, double> costBetween() {
        constexpr int kLastChecked = 37;
        double most = 0.0, added = 0.0;
        for (int n = 1; n <= kLastChecked; ++n) {
            const auto& samples = samples_[static_cast<size_t>(n)];
            if (isDark(samples)) continue;
            const LobeFit middle = between(fit(n - 1), fit(n + 1), 0.5);
            const double cost = costOf(middle, samples, kFitDraws, options_.cosines);
            most = std::max(most, cost);
            added = std::max(added, cost - fit(n).cost);
        }
        return {most, added};
    }

    LobeFit& fit(int node) { return fits_[static_cast<size_t>(node)]; }

    void improveAt(int node, const LobeFit& start) {
        const auto& samples = samples_[static_cast<size_t>(node)];
        fit(node) = isDark(samples) ? start : improve(start, samples, kFitDraws, options_);
    }

    void startAt(int node, const std::vector<LobeFit>& likeThese) {
        const auto& samples = samples_[static_cast<size_t>(node)];
        if (isDark(samples)) return;
        FitOptions thorough = options_;
        thorough.evaluations = 150;
        thorough.roundAbout = node == 0;
        fit(node) = fitFresh(samples, kFitDraws, thorough);
        if (likeThese.empty()) return;
        // The neighbour's kind of fit, unless it is much worse: rows are interpolated too.
        const LobeFit like = improve(likeThese[static_cast<size_t>(node)], samples, kFitDraws, thorough);
        constexpr double kMuchWorse = 1.5;
        if (like.cost < kMuchWorse * fit(node).cost) fit(node) = like;
    }

    /// No direction is preferred there.
    void roundAt0() {
        LobeFit start = fit(1);
        for (LobeShape5& shape : start.shapes) {
            shape[0] = shape[2] = 0.5 * (shape[0] + shape[2]);
            shape[1] = shape[3] = 0.0;
        }
        FitOptions options = options_;
        options.roundAbout = true;
        if (!isDark(samples_[0])) start = improve(start, samples_[0], kFitDraws, options);
        fit(0) = start;
    }

    FitOptions options_;
    std::vector<std::vector<LobeSample>> samples_;
    std::vector<LobeFit> fits_;
};

struct NodeLobe {
    LobeShape5 shape;
    glm::dvec3 weight;
};

/// Everything at one node.
struct Node {
    double base = 1.0;
    std::vector<NodeLobe> lobes;
};

/// Colours of the weights, from more draws than the search has.
std::vector<NodeLobe> coloured(const Shapes& shapes, const std::vector<TermSample>& samples,
                               const Target& target) {
    const std::vector<LobeSample> lobe = lobeSamples(samples, target);
    std::vector<NodeLobe> lobes;
    for (const LobeShape5& shape : shapes)
        lobes.push_back({shape, glm::dvec3(0.0)});
    if (isDark(lobe)) return lobes;
    for (int c = 0; c < 3; ++c) {
        std::vector<double> values;
        values.reserve(samples.size());
        for (const TermSample& s : samples)
            values.push_back(target.of(s.terms)[c]);
        const auto weights = weightsFor(shapes, lobe, kWeightDraws, values);
        for (size_t j = 0; j < kLobes; ++j)
            lobes[j].weight[c] = weights[j];
    }
    return lobes;
}

double baseFactor(const std::vector<TermSample>& samples) {
    double sum = 0.0;
    for (const TermSample& s : samples)
        sum += s.terms.base * s.cosine / (glm::pi<double>() * s.density);
    return sum / static_cast<double>(kWeightDraws);
}

void append(std::vector<float>& texels, std::initializer_list<double> numbers) {
    for (double number : numbers)
        texels.push_back(static_cast<float>(number));
}

std::vector<Target> targetsOf(const TableRequest& request, const ParameterValues& values) {
    const AreaModel& area = *request.brdf->area;
    const AreaWeights weights = area.weights(values);
    if (area.terms == 0) return {};
    if (!request.colorsVary) return {{true, 0, weights}};
    std::vector<Target> targets;
    for (int t = 0; t < area.terms; ++t)
        targets.push_back({false, static_cast<size_t>(t), weights});
    return targets;
}

}  // namespace

std::optional<std::string> refusal(const TableRequest& request) {
    const Brdf& brdf = *request.brdf;
    if (!brdf.area) return "no fit serves " + brdf.name;
    if (!brdf.area->refuses) return {};
    const std::string reason = brdf.area->refuses(request.values);
    if (reason.empty()) return {};
    return reason;
}

TableRequest normalised(TableRequest request) {
    const Brdf& brdf = *request.brdf;
    const ParameterValues defaults = brdf.defaults();
    const auto reset = [&](const std::string& name) {
        const int index = brdf.parameterIndex(name);
        if (index < 0) return;
        const auto offset = static_cast<size_t>(brdf.valueOffset(index));
        for (size_t c = 0; c < static_cast<size_t>(brdf.parameters[static_cast<size_t>(index)].components());
             ++c)
            request.values[offset + c] = defaults[offset + c];
    };
    // Where the model's own table lies in a buffer is nothing of the model's.
    if (const int table = brdf.tableParameter(); table >= 0)
        reset(brdf.parameters[static_cast<size_t>(table)].name);
    if (request.colorsVary)
        for (const std::string& color : brdf.area->colors)
            reset(color);
    if (request.widthVaries) reset(brdf.area->width);
    return request;
}

int tableTexels(const TableRequest& request) {
    const int terms = request.brdf->area->terms;
    AreaTable table;
    table.terms = request.colorsVary || terms == 0 ? terms : 1;
    return 1 + (request.widthVaries ? kWidthNodes : 1) * kAngleNodes * table.nodeTexels();
}

double oneMinusCosAt(int node) {
    const double last = std::acos(std::sqrt(kLeastCosine));
    const double sine = std::sin(last * node / (kAngleNodes - 1));
    return sine * sine;
}

double angleCoordinate(double oneMinusCos) {
    const double last = std::acos(std::sqrt(kLeastCosine));
    const double angle = std::atan2(std::sqrt(oneMinusCos), std::sqrt(std::max(1.0 - oneMinusCos, 0.0)));
    return std::min(angle / last, 1.0) * (kAngleNodes - 1);
}

AreaTable makeTable(const TableRequest& request) {
    const AreaModel& area = *request.brdf->area;
    AreaTable table;
    table.cosines = area.powerTail;
    const size_t widthOffset =
        area.width.empty()
            ? 0
            : static_cast<size_t>(request.brdf->valueOffset(request.brdf->parameterIndex(area.width)));
    const int widths = request.widthVaries ? kWidthNodes : 1;
    const double low = std::log(area.widths.first), high = std::log(area.widths.second);
    table.terms = static_cast<int>(targetsOf(request, request.values).size());
    append(table.texels, {kAngleNodes, double(widths), low, widths > 1 ? (widths - 1) / (high - low) : 0.0});
    std::vector<std::vector<LobeFit>> previous(static_cast<size_t>(table.terms));
    std::vector<std::vector<Node>> rows(static_cast<size_t>(widths));
    // From wide to narrow: wide lobes differ most from round ones.
    const bool widestLast = area.width != "shininess";
    for (int i = 0; i < widths; ++i) {
        const int row = widestLast ? widths - 1 - i : i;
        ParameterValues values = request.values;
        if (request.widthVaries) values[widthOffset] = std::exp(low + (high - low) * row / (widths - 1));
        std::vector<std::vector<TermSample>> few, many;
        for (int n = 0; n < kAngleNodes; ++n) {
            const View view(oneMinusCosAt(n));
            few.push_back(sampleTerms(*request.brdf, values, view, kFitDraws));
            many.push_back(sampleTerms(*request.brdf, values, view, kWeightDraws));
        }
        std::vector<Node>& nodes = rows[static_cast<size_t>(row)];
        nodes.resize(kAngleNodes);
        for (size_t n = 0; n < nodes.size(); ++n)
            if (area.baseVaries) nodes[n].base = baseFactor(many[n]);
        const std::vector<Target> targets = targetsOf(request, values);
        for (size_t t = 0; t < targets.size(); ++t) {
            const std::vector<LobeFit> fits = Row(few, targets[t], table.cosines).fits(previous[t]);
            for (size_t n = 0; n < nodes.size(); ++n)
                for (const NodeLobe& lobe : coloured(fits[n].shapes, many[n], targets[t]))
                    nodes[n].lobes.push_back(lobe);
            previous[t] = fits;
        }
    }
    for (const std::vector<Node>& nodes : rows)
        for (const Node& node : nodes) {
            append(table.texels, {node.base, 0.0, 0.0, 0.0});
            for (const NodeLobe& lobe : node.lobes) {
                append(table.texels, {lobe.shape[0], lobe.shape[1], lobe.shape[2], lobe.shape[3]});
                append(table.texels, {lobe.weight.r, lobe.weight.g, lobe.weight.b, lobe.shape[4]});
            }
        }
    return table;
}

TablePoint at(const AreaTable& table, double oneMinusCos, double width) {
    const int angles = table.angles(), widths = table.widths();
    const double x = angleCoordinate(oneMinusCos);
    const double y = widths > 1
                         ? std::clamp((std::log(width) - double(table.texels[2])) * double(table.texels[3]),
                                      0.0, double(widths - 1))
                         : 0.0;
    const int column = std::min(static_cast<int>(x), angles - 2),
              row = std::min(static_cast<int>(y), widths - 1);
    const auto number = [&](int texel, int component) {
        const auto nodeAt = [&](int r, int c) {
            const int node = std::min(r, widths - 1) * angles + c;
            return double(table.texels[4 * static_cast<size_t>(1 + node * table.nodeTexels() + texel) +
                                       static_cast<size_t>(component)]);
        };
        const double s = x - column, t = y - row;
        const double low = nodeAt(row, column) * (1.0 - s) + nodeAt(row, column + 1) * s;
        const double high = nodeAt(row + 1, column) * (1.0 - s) + nodeAt(row + 1, column + 1) * s;
        return low * (1.0 - t) + high * t;
    };
    TablePoint point;
    point.base = number(0, 0);
    for (int i = 0; i < table.terms * static_cast<int>(kLobes); ++i) {
        const int first = 1 + 2 * i;
        const LobeShape5 shape{number(first, 0), number(first, 1), number(first, 2), number(first, 3),
                               number(first + 1, 3)};
        point.lobes.push_back(
            {lobeOf(shape), {number(first + 1, 0), number(first + 1, 1), number(first + 1, 2)}});
    }
    return point;
}

}  // namespace lobe::fit
