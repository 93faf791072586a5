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

    std::vector<double> light, error, upTo;
    double total = 0.0;
    for (const TermSample& s : samples) {
        glm::dvec3 exact(0.0), fitted(0.0);
        for (size_t t = 0; t < 2; ++t)
            exact += weights.terms[t] * s.terms.terms[t];
        for (const TableLobe& lobe : point.lobes)
            fitted += lobe.weight * lobe.lobe.density(s.w);
        const glm::dvec3 mean(1.0 / 3.0);
        light.push_back(glm::dot(exact, mean) / s.density);
        error.push_back(glm::dot(fitted - exact, mean) / s.density);
        upTo.push_back(total += light.back());
    }
    if (!(total > 0.0)) return {};
    Pcg32 random(options.seed);
    const glm::dmat3 toView = glm::transpose(view.frame);
    double sumError = 0.0, sumLight = 0.0, worst = 0.0;
    for (int disc = 0; disc < options.discs; ++disc) {
        glm::dvec3 centre = toView * uniformHemisphere({random.uniform(), random.uniform()});
        if (disc % 2 == 0) {
            const auto found = std::lower_bound(upTo.begin(), upTo.end(), random.uniform() * total);
            centre = samples[std::min(static_cast<size_t>(found - upTo.begin()), samples.size() - 1)].w;
        }
        const double cosine = std::cos(glm::radians(random.uniform(options.smallest, options.largest)));
        double lightOfDisc = 0.0, errorOfDisc = 0.0;
        for (size_t i = 0; i < samples.size(); ++i) {
            if (glm::dot(samples[i].w, centre) < cosine) continue;
            lightOfDisc += light[i];
            errorOfDisc += error[i];
        }
        sumLight += lightOfDisc;
        sumError += std::abs(errorOfDisc);
        worst = std::max(worst, std::abs(errorOfDisc));
    }
    if (!(sumLight > 0.0)) return {};
    return {sumError / sumLight, worst * options.discs / sumLight};
}

}  // namespace lobe::fit
