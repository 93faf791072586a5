#include "plot/terms.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "plot/geometry.hpp"

namespace lobe::plot {
namespace {

/// Of the whole: the parts of a model that couples them differ by far more, of one that does not by rounding.
constexpr double kCoupled = 1e-3;

bool isRgb(const Brdf& brdf, const char* name) {
    const int index = brdf.parameterIndex(name);
    return index >= 0 && brdf.parameters[static_cast<size_t>(index)].kind == ParameterKind::rgb;
}

Model without(Model model, const char* parameter) {
    const auto offset = static_cast<size_t>(model.brdf->valueOffset(model.brdf->parameterIndex(parameter)));
    for (size_t c = 0; c < 3; ++c)
        model.values[offset + c] = 0.0;
    return model;
}

struct Parts {
    std::vector<double> diffuse, specular, whole;
};

std::vector<double> valuesOf(const Sampler& sampler, const Model& model, std::span<const Pair> pairs,
                             Channel channel) {
    std::vector<double> values;
    for (const Sample& sample : sampler.sample(model, pairs))
        values.push_back(channelOf(sample.fCos, channel));
    return values;
}

Parts partsOf(const Sampler& sampler, const Model& model, std::span<const Pair> pairs, Channel channel) {
    Parts parts{{},
                valuesOf(sampler, without(model, "diffuse"), pairs, channel),
                valuesOf(sampler, model, pairs, channel)};
    if (isRgb(*model.brdf, "specular")) {
        parts.diffuse = valuesOf(sampler, without(model, "specular"), pairs, channel);
        bool coupled = false;
        for (size_t i = 0; i < pairs.size(); ++i)
            coupled |=
                std::abs(parts.diffuse[i] + parts.specular[i] - parts.whole[i]) > kCoupled * parts.whole[i];
        if (!coupled) return parts;
    }
    parts.diffuse.clear();
    for (size_t i = 0; i < pairs.size(); ++i)
        parts.diffuse.push_back(std::max(parts.whole[i] - parts.specular[i], 0.0));
    return parts;
}

}  // namespace

bool hasTerms(const Brdf& brdf) {
    return isRgb(brdf, "diffuse") && (isRgb(brdf, "specular") || brdf.lobeSharpness(brdf.defaults()) > 0.0);
}

Terms computeTerms(const Sampler& sampler, const TermsRequest& request) {
    const Model& model = request.model;
    if (!hasTerms(*model.brdf)) {
        std::string names;
        for (const Brdf& brdf : allBrdfs())
            if (hasTerms(brdf)) names += (names.empty() ? "" : ", ") + brdf.name;
        throw UsageError(model.brdf->name +
                         ": has no diffuse and specular terms to tell apart; expected one of " + names);
    }
    Terms result{request, {}};
    for (double incidence : request.incidences) {
        requireIncidence(incidence);
        const glm::dvec3 wi = toLight(incidence, request.azimuth);
        TermsRow row{incidence, {}};
        const Pair normal{wi, wi};
        const double ambient =
            request.ambientRadiance *
            channelOf(sampler.sample(model, std::span(&normal, 1)).front().ambient, request.channel);
        row.cells[3] = sampleLobe(incidence, [&](const std::vector<double>& angles) {
            return valuesOf(sampler, model, pairsAt(wi, angles, request.azimuth), request.channel);
        });
        std::vector<double> angles;
        for (const LobePoint& point : row.cells[3])
            angles.push_back(point.angle);
        const Parts parts = partsOf(sampler, model, pairsAt(wi, angles, request.azimuth), request.channel);
        for (size_t i = 0; i < angles.size(); ++i) {
            row.cells[0].push_back({angles[i], ambient});
            row.cells[1].push_back({angles[i], parts.diffuse[i]});
            row.cells[2].push_back({angles[i], parts.specular[i]});
            row.cells[3][i].value = ambient + parts.whole[i];
        }
        result.rows.push_back(std::move(row));
    }
    return result;
}

}  // namespace lobe::plot
