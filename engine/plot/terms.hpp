/// The lecture's table of lobes: ambient, diffuse, specular and total reflection at a few incidences.
#pragma once

#include <array>

#include "plot/lobes.hpp"

namespace lobe::plot {

inline constexpr std::array<const char*, 4> kTermNames{"ambient", "diffuse", "specular", "total"};

struct TermsRequest {
    Model model;
    std::vector<double> incidences{60.0, 25.0, 0.0};  ///< degrees, a row each
    double ambientRadiance = 0.1;  ///< of surroundings, for light of irradiance 1 on a facing surface
    Channel channel = Channel::luminance;
    double azimuth = 0.0;
};

/// One row: cells in the order of kTermNames, all over the same angles. Values are radiance for an irradiance
/// of 1 on a facing surface.
struct TermsRow {
    double incidence;
    std::array<std::vector<LobePoint>, 4> cells;
};

struct Terms {
    TermsRequest request;
    std::vector<TermsRow> rows;
};

/// Whether a model's parameters tell its diffuse from its specular part.
bool hasTerms(const Brdf& brdf);

/// The specular part is the model without `diffuse`; the diffuse part the model without `specular` where that
/// leaves the rest as it was, else what is left of the whole. The total is evaluated, not added up. Throws
/// UsageError for models without such terms.
Terms computeTerms(const Sampler& sampler, const TermsRequest& request);

}  // namespace lobe::plot
