/// Values of a model for pairs of directions, from the GLSL that renders or from the double twin.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/brdf_table.hpp"
#include "plot/model.hpp"

namespace lobe::plot {

/// Unit vectors in the local frame, z the normal: to the light, to the eye. They are rounded to floats before
/// they are used, for twin and GLSL alike.
struct Pair {
    glm::dvec3 wi, wo;
};

struct Sample {
    glm::dvec3 fCos;     ///< f_r cos(theta_i), 1/sr
    glm::dvec3 ambient;  ///< factor of ambient radiance
    glm::dvec3 mirror;   ///< reflectance into the mirrored direction at wo's angle; 0 for most models
};

enum class Channel { luminance, red, green, blue };

/// One number of three; luminance has Rec. 709's weights.
double channelOf(const glm::dvec3& rgb, Channel channel);

class Sampler {
public:
    /// The double twins.
    Sampler() = default;
    /// The GLSL, on the context that is current; `library` must outlive the sampler.
    explicit Sampler(const gl::ShaderLibrary& library) : library_(&library) {}

    bool isTwin() const { return library_ == nullptr; }

    /// One sample a pair. Throws Error with ExitCode::nonFinite where a value is not finite.
    std::vector<Sample> sample(const Model& model, std::span<const Pair> pairs) const;

private:
    const harness::BrdfEvaluator& evaluatorFor(const Brdf& brdf) const;

    const gl::ShaderLibrary* library_ = nullptr;
    mutable std::map<std::string, std::unique_ptr<harness::BrdfEvaluator>> evaluators_;
};

/// The row that holds the pair in floats; its table is the one at index 0 of a list of one.
harness::BrdfRow rowOf(const Model& model, const Pair& pair);

}  // namespace lobe::plot
