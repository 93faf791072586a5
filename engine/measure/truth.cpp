#include "measure/truth.hpp"

#include <chrono>
#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "image/metrics.hpp"
#include "passes/renderer.hpp"

namespace lobe::measure {
namespace {

/// Four times the samples of the best that can be chosen.
constexpr int kSamples = 64;

}  // namespace

TruthSource convergedTruth(gl::Context& context) {
    return [&context](const Scene& scene, const Camera& camera, int width, int height) {
        const auto start = std::chrono::steady_clock::now();
        RenderOptions options;
        options.width = width;
        options.height = height;
        options.quality = qualityPreset("converged");
        Renderer renderer(context);
        const auto shared = std::make_shared<const Scene>(scene);
        const auto render = [&](int samples) {
            options.quality.samples = samples;
            renderer.setScene(shared, options);
            return renderer.render(camera).image;
        };
        options.aovs = {Aov::radiance, Aov::depth, Aov::normal, Aov::materialId};
        Truth truth;
        truth.image = render(kSamples);
        if (const NonFinite bad = countNonFinite(truth.image); bad.pixels > 0)
            throw Error(ExitCode::nonFinite,
                        scene.file + ": the converged picture has " + std::to_string(bad.pixels) +
                            " non-finite pixels, the first at " + std::to_string(bad.firstX) + "," +
                            std::to_string(bad.firstY));
        // The first half of the samples is a picture of its own, and the second half errs to the other side:
        // half their difference is the first half's distance from the whole.
        truth.standardError = std::sqrt(
            measureError(render(kSamples / 2), truth.image, {.perceptual = false})[Metric::relMse].value_or(
                0.0));
        truth.method = "converged";
        truth.note = "the engine's preset converged with " + std::to_string(kSamples) +
                     " samples a pixel: errors that all settings share are not seen";
        truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return truth;
    };
}

}  // namespace lobe::measure
