#include "fit/area_table.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>

#include "fit/lobe_samples.hpp"
#include "fit/row_fit.hpp"

namespace lobe::fit {
namespace {

constexpr size_t kFitDraws = 512;      // of each search
constexpr size_t kWeightDraws = 2048;  // of weights and albedos
constexpr int kWidthNodes = 28;
/// Of metals with exact Fresnel equations up to 0.051, which are fitted well; beyond, one shape does not hold
/// all.
constexpr double kMostColorDistance = 0.055;

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

/// Errors count for more where less is allowed: to 60 degrees of view, then to 85.
double importanceOf(double oneMinusCos) {
    constexpr double kSteep = 0.5, kGrazing = 0.0872;  // cosines of 60 and 85 degrees
    const double cosine = 1.0 - oneMinusCos;
    return cosine >= kSteep ? 1.0 : cosine >= kGrazing ? 0.4 : 0.15;
}

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
std::vector<NodeLobe> coloured(const Numbers& fit, const std::vector<TermSample>& samples,
                               const Target& target) {
    std::vector<std::vector<double>> colors(3);
    for (const TermSample& s : samples)
        for (size_t c = 0; c < colors.size(); ++c)
            colors[c].push_back(target.of(s.terms)[static_cast<int>(c)]);
    const Shapes shapes = shapesOf(fit);
    const std::vector<Weights> weights =
        weightsFor(shapes, {std::exp(fit[kWeightAt]), std::exp(fit[kLobeNumbers + kWeightAt])},
                   lobeSamples(samples, target), colors);
    std::vector<NodeLobe> lobes;
    for (size_t j = 0; j < kLobes; ++j)
        lobes.push_back({shapes[j], {weights[0][j], weights[1][j], weights[2][j]}});
    return lobes;
}

double baseFactor(const std::vector<TermSample>& samples) {
    double sum = 0.0;
    for (const TermSample& s : samples)
        sum += s.terms.base * s.cosine / (glm::pi<double>() * s.density);
    return sum / static_cast<double>(kWeightDraws);
}

/// The most that a term has of the light among all, where each weighs 0.04, as of glass, to 1. Not below a
/// hundredth.
double shareOf(const std::vector<Target>& targets, size_t target, const std::vector<TermSample>& samples) {
    constexpr double kLeastWeight = 0.04, kLeastShare = 0.01;
    double own = 0.0, others = 0.0;
    for (const TermSample& s : samples)
        for (size_t t = 0; t < targets.size(); ++t)
            (t == target ? own : others) += meanOf(targets[t].of(s.terms)) / s.density;
    return own > 0.0 ? std::max(own / (own + kLeastWeight * others), kLeastShare) : 1.0;
}

/// A row's terms at its nodes and halfway between them.
class RowTerms {
public:
    RowTerms(const Brdf& brdf, const ParameterValues& values, ThreadTeam& team)
        : places_(2 * kAngleNodes - 1) {
        static const std::vector<glm::dvec3> draws = spreadDraws(kWeightDraws);
        const auto first = std::span(draws).first(kFitDraws), rest = std::span(draws).subspan(kFitDraws);
        team.each(places_.size(), [&](size_t p) {
            const View view(oneMinusCosAt(0.5 * static_cast<double>(p)));
            Place& place = places_[p];
            place.searched = sampleTerms(brdf, values, view, first);
            if (p % 2 != 0) return;
            place.all = place.searched;
            const std::vector<TermSample> more = sampleTerms(brdf, values, view, rest);
            place.all.insert(place.all.end(), more.begin(), more.end());
        });
    }

    /// For weights and albedos.
    const std::vector<TermSample>& node(size_t n) const { return places_[2 * n].all; }

    /// Of one of the targets.
    RowSamples of(const std::vector<Target>& targets, size_t target, ThreadTeam& team) const {
        std::vector<std::optional<SearchSamples>> places(places_.size());
        std::vector<double> share(places_.size());
        team.each(places.size(), [&](size_t p) {
            places[p].emplace(lobeSamples(places_[p].searched, targets[target]), kFitDraws);
            share[p] = shareOf(targets, target, places_[p].searched);
        });
        RowSamples samples;
        for (size_t p = 0; p < places.size(); ++p) {
            samples.places.push_back(std::move(*places[p]));
            samples.importance.push_back(importanceOf(oneMinusCosAt(0.5 * static_cast<double>(p))) *
                                         share[p] * share[p]);
        }
        return samples;
    }

private:
    struct Place {
        std::vector<TermSample> searched, all;
    };
    std::vector<Place> places_;
};

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
    if (brdf.area->refuses)
        if (const std::string reason = brdf.area->refuses(request.values); !reason.empty()) return reason;
    if (brdf.area->terms == 0 || request.colorsVary || huesDiffer(brdf, request.values)) return {};
    const double apart = colorDistance(brdf, request.values);
    if (apart <= kMostColorDistance) return {};
    return "its colours' lobes differ in shape, by " + std::to_string(std::lround(100.0 * apart)) +
           " % of their light";
}

double colorDistance(const Brdf& brdf, std::span<const double> values) {
    static const std::vector<glm::dvec3> draws = spreadDraws(256);
    const AreaWeights weights = brdf.area->weights(values);
    double most = 0.0;
    for (double degrees : {0.0, 30.0, 60.0, 75.0}) {
        const double sine = std::sin(0.5 * glm::radians(degrees));
        std::vector<glm::dvec3> light;
        glm::dvec3 albedo(0.0);
        for (const TermSample& s : sampleTerms(brdf, values, View(2.0 * sine * sine), draws)) {
            light.push_back((weights.terms[0] * s.terms.terms[0] + weights.terms[1] * s.terms.terms[1]) /
                            s.density);
            albedo += light.back();
        }
        const double all = albedo.r + albedo.g + albedo.b;
        for (int c = 0; c < 3; ++c) {
            if (!(albedo[c] > 0.0)) continue;
            double apart = 0.0;
            for (const glm::dvec3& sample : light)
                apart += std::abs(sample[c] / albedo[c] - (sample.r + sample.g + sample.b) / all);
            most = std::max(most, 0.5 * apart);
        }
    }
    return most;
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

bool huesDiffer(const Brdf& brdf, std::span<const double> values) {
    if (!brdf.area || brdf.area->terms < 2) return false;
    constexpr double kAlike = 0.02;  // of the fits' own errors
    const auto [first, second] = brdf.area->weights(values).terms;
    for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3;
        const double one = first[c] * second[d], other = first[d] * second[c];
        if (std::abs(one - other) > kAlike * std::max(one, other)) return true;
    }
    return false;
}

int tableTexels(const TableRequest& request) {
    const int terms = request.brdf->area->terms;
    AreaTable table;
    table.terms = request.colorsVary || terms == 0 ? terms : 1;
    return 1 + (request.widthVaries ? kWidthNodes : 1) * kAngleNodes * table.nodeTexels();
}

double oneMinusCosAt(double node) {
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
    ThreadTeam team;
    return makeTable(request, team);
}

AreaTable makeTable(const TableRequest& request, ThreadTeam& team) {
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
    std::vector<std::optional<std::pair<RowSamples, RowFit>>> previous(static_cast<size_t>(table.terms));
    std::vector<std::vector<Node>> rows(static_cast<size_t>(widths));
    // From wide to narrow: wide lobes differ most from round ones.
    const bool widestLast = area.width != "shininess";
    for (int i = 0; i < widths; ++i) {
        const int row = widestLast ? widths - 1 - i : i;
        ParameterValues values = request.values;
        if (request.widthVaries) values[widthOffset] = std::exp(low + (high - low) * row / (widths - 1));
        const RowTerms terms(*request.brdf, values, team);
        std::vector<Node>& nodes = rows[static_cast<size_t>(row)];
        nodes.resize(kAngleNodes);
        if (area.baseVaries)
            team.each(nodes.size(), [&](size_t n) { nodes[n].base = baseFactor(terms.node(n)); });
        const std::vector<Target> targets = targetsOf(request, values);
        for (size_t t = 0; t < targets.size(); ++t) {
            RowSamples samples = terms.of(targets, t, team);
            RowFit fit = previous[t] ? fitRowLike(previous[t]->second, previous[t]->first, samples,
                                                  table.cosines, team)
                                     : fitRow(samples, table.cosines, team);
            std::vector<std::vector<NodeLobe>> lobes(nodes.size());
            team.each(nodes.size(),
                      [&](size_t n) { lobes[n] = coloured(fit.nodes[n], terms.node(n), targets[t]); });
            for (size_t n = 0; n < nodes.size(); ++n)
                nodes[n].lobes.insert(nodes[n].lobes.end(), lobes[n].begin(), lobes[n].end());
            previous[t] = {std::move(samples), std::move(fit)};
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
