/// What settings are measured against.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "gl/context.hpp"
#include "image/image.hpp"
#include "scene/scene.hpp"

namespace lobe::measure {

struct Truth {
    Image image;  ///< R G B A, and layers that tell edges (image/edges.hpp)
    /// Of the image's own error: root of the mean of its squared relative error, from independent halves; 0
    /// if not known.
    double standardError = 0.0;
    std::string method;  ///< "reference", "converged"
    double seconds = 0.0;
    std::string note;
};

using TruthSource =
    std::function<Truth(const std::shared_ptr<const Scene>&, const Camera&, int width, int height)>;

/// The engine's own `converged` preset with more samples: knows nothing of errors that all settings share, in
/// the shading itself. The context must be current and outlive the source.
TruthSource convergedTruth(gl::Context& context);

/// reference::computeTruth(), the mean over each pixel, to 0.2 % or for as long as `seconds`. Throws
/// UsageError for a model without a twin.
TruthSource referenceTruth(double seconds, const std::atomic<bool>& stop);

/// The reference, or, of a scene with a model without a twin, the converged picture.
TruthSource bestTruth(gl::Context& context, double seconds, const std::atomic<bool>& stop);

}  // namespace lobe::measure
