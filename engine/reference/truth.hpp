/// The true picture of a scene: every pixel's radiance with its own remaining error.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "image/image.hpp"
#include "reference/pixel.hpp"

namespace lobe::reference {

struct TruthRequest {
    int width = 1280, height = 720;
    TruthOptions options;
    double relativeError = 0.002;  ///< standard error wanted of each pixel, of its radiance and half the mean
    /// Stop when they are over, with what was reached by then, but not before each pixel has been looked at.
    std::optional<double> seconds;
    long long mostRays = 1 << 22;  ///< a pixel, beyond which it is left as it is
    unsigned threads = 0;          ///< 0: one a core
};

struct TruthProgress {
    double relativeError = 0.0;  ///< of the present round
    double done = 0.0;           ///< of that round's pixels, 0 to 1
};

struct TruthResult {
    /// R G B A; error.R G B: standard errors; emission.R ... fog.R G B: radiance by source, of those that the
    /// scene has; depth.Z, normal.X Y Z, material.id of the nearest surface at the pixel's centre; effort.Y:
    /// the relative error that the pixel was computed for.
    Image image;
    /// Root mean square over pixels of standard error / (radiance + half the mean radiance).
    double relativeError = 0.0;
    size_t unfinished = 0;  ///< pixels that are not as good as wanted
    size_t badTexels = 0;   ///< of the environment
};

/// Rounds of less and less error, in tiles, on all cores. A picture that an earlier call gave is gone on with
/// where it is not good enough yet. Pixels are the same whatever the number of threads, but for `seconds`.
/// Once `stop` is set the call returns what it has. `checkpoint`, every half minute, gets what is there.
TruthResult computeTruth(std::shared_ptr<const Scene> scene, const Camera& camera,
                         const TruthRequest& request, const Image* earlier, const std::atomic<bool>& stop,
                         const std::function<void(const TruthProgress&)>& progress,
                         const std::function<void(const Image&)>& checkpoint);

/// Channel names of a scene's truth, in order.
std::vector<std::string> truthChannels(const Scene& scene);

}  // namespace lobe::reference
