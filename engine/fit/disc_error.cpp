#include "fit/disc_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "fit/lobe_samples.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"

namespace lobe::fit {

DiscError discError(const TableRequest& request, const AreaTable& table, double oneMinusCos,
                    const DiscOptions& options) {
    const Brdf& brdf = *request.brdf;
    const View view(oneMinusCos);
    const std::vector<TermSample> samples =
        sampleTerms(brdf, request.values, view, spreadDraws(options.draws, options.seed));
    const AreaWeights weights = brdf.area->weights(request.values);
    const int widthIndex = brdf.area->width.empty() ? -1 : brdf.parameterIndex(brdf.area->width);
    const double width =
        widthIndex < 0 ? 1.0 : request.values[static_cast<size_t>(brdf.valueOffset(widthIndex))];
    TablePoint point = at(table, oneMinusCos, width);
    if (request.colorsVary)
        for (size_t i = 0; i < point.lobes.size(); ++i)
            point.lobes[i].weight *= weights.terms[i / kLobes];

    std::vector<glm::dvec3> light, error;
    std::vector<double> upTo;
    double total = 0.0;
    for (const TermSample& s : samples) {
        glm::dvec3 exact(0.0), fitted(0.0);
        for (size_t t = 0; t < 2; ++t)
            exact += weights.terms[t] * s.terms.terms[t];
        for (const TableLobe& lobe : point.lobes)
            fitted += lobe.weight * lobe.lobe.density(s.w);
        light.push_back(exact / s.density);
        error.push_back((fitted - exact) / s.density);
        upTo.push_back(total += light.back().r + light.back().g + light.back().b);
    }
    if (!(total > 0.0)) return {};
    Pcg32 random(options.seed);
    const glm::dmat3 toView = glm::transpose(view.frame);
    glm::dvec3 sumError(0.0), sumLight(0.0), worst(0.0);
    for (int disc = 0; disc < options.discs; ++disc) {
        glm::dvec3 centre = toView * uniformHemisphere({random.uniform(), random.uniform()});
        if (disc % 2 == 0) {
            const auto found = std::lower_bound(upTo.begin(), upTo.end(), random.uniform() * total);
            centre = samples[std::min(static_cast<size_t>(found - upTo.begin()), samples.size() - 1)].w;
        }
        const double cosine = std::cos(glm::radians(random.uniform(options.smallest, options.largest)));
        glm::dvec3 lightOfDisc(0.0), errorOfDisc(0.0);
        for (size_t i = 0; i < samples.size(); ++i) {
            if (glm::dot(samples[i].w, centre) < cosine) continue;
            lightOfDisc += light[i];
            errorOfDisc += error[i];
        }
        sumLight += lightOfDisc;
        sumError += glm::abs(errorOfDisc);
        worst = glm::max(worst, glm::abs(errorOfDisc));
    }
    DiscError result;
    for (int c = 0; c < 3; ++c) {
        if (!(sumLight[c] > 0.0)) continue;
        result.mean = std::max(result.mean, sumError[c] / sumLight[c]);
        result.worst = std::max(result.worst, worst[c] * options.discs / sumLight[c]);
    }
    return result;
}

}  // namespace lobe::fit
