#include "plot/sampler.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "harness/comparison.hpp"

namespace lobe::plot {
namespace {

/// Keeps the textures of one evaluation within the smallest limits there are.
constexpr size_t kRowsAtOnce = size_t{1} << 17;

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void requireFinite(const Model& model, const Pair& pair, const Sample& sample) {
    if (isFinite(sample.fCos) && isFinite(sample.ambient) && isFinite(sample.mirror)) return;
    throw Error(ExitCode::nonFinite,
                model.brdf->name + ": a value is not finite; " + harness::describe(rowOf(model, pair)));
}

Sample twinSample(const Model& model, const Pair& pair) {
    const Directions d = harness::directionsOf(rowOf(model, pair));
    return {model.brdf->fCos(d, model.values), model.brdf->ambient(model.values),
            model.brdf->mirror ? model.brdf->mirror(d.wo.z, model.values) : glm::dvec3(0.0)};
}

}  // namespace

double channelOf(const glm::dvec3& rgb, Channel channel) {
    switch (channel) {
        case Channel::red:
            return rgb.r;
        case Channel::green:
            return rgb.g;
        case Channel::blue:
            return rgb.b;
        case Channel::luminance:
            break;
    }
    // Equal channels keep their value to the last digit.
    return rgb.r == rgb.g && rgb.g == rgb.b ? rgb.r : glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

harness::BrdfRow rowOf(const Model& model, const Pair& pair) {
    const auto count = static_cast<std::ptrdiff_t>(model.brdf->valueCount());
    harness::BrdfRow row{"plot", glm::vec3(pair.wi), glm::vec3(pair.wo), {}, model.brdf->table ? 0 : -1};
    row.values.assign(model.values.begin(), model.values.begin() + count);
    return row;
}

const harness::BrdfEvaluator& Sampler::evaluatorFor(const Brdf& brdf) const {
    auto& evaluator = evaluators_[brdf.name];
    if (!evaluator) evaluator = std::make_unique<harness::BrdfEvaluator>(*library_, brdf);
    return *evaluator;
}

std::vector<Sample> Sampler::sample(const Model& model, std::span<const Pair> pairs) const {
    std::vector<Sample> samples;
    samples.reserve(pairs.size());
    if (isTwin()) {
        for (const Pair& pair : pairs)
            samples.push_back(twinSample(model, pair));
    } else {
        std::vector<TableRows> tables;
        if (model.brdf->table) {
            const auto table = model.brdf->tableOf(model.values);
            tables.emplace_back(table.begin(), table.end());
        }
        for (size_t start = 0; start < pairs.size(); start += kRowsAtOnce) {
            std::vector<harness::BrdfRow> rows;
            for (const Pair& pair : pairs.subspan(start, std::min(kRowsAtOnce, pairs.size() - start)))
                rows.push_back(rowOf(model, pair));
            for (const harness::BrdfResult& result : evaluatorFor(*model.brdf).evaluate(rows, tables))
                samples.push_back(
                    {glm::dvec3(result.fCos), glm::dvec3(result.ambient), glm::dvec3(result.mirror)});
        }
    }
    for (size_t i = 0; i < samples.size(); ++i)
        requireFinite(model, pairs[i], samples[i]);
    return samples;
}

}  // namespace lobe::plot
