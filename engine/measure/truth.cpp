#include "measure/truth.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "image/edges.hpp"
#include "image/metrics.hpp"
#include "passes/renderer.hpp"
#include "reference/truth.hpp"
#include "shading/brdf.hpp"

namespace lobe::measure {
namespace {

/// Four times the samples of the best that can be chosen.
constexpr int kSamples = 64;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of a truth with the channels error.R G B: root of what relmse would be of a picture that errs by these.
double ownError(const Image& image) {
    double sum = 0.0;
    for (const char* channel : {"R", "G", "B"}) {
        const std::optional<Plane> value = channelOf(image, channel);
        const std::optional<Plane> error = channelOf(image, std::string("error.") + channel);
        if (!value || !error) return 0.0;
        for (size_t i = 0; i < value->size(); ++i)
            sum += (*error)[i] * (*error)[i] / ((*value)[i] * (*value)[i] + 0.01);
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(image.pixelCount())));
}

}  // namespace

TruthSource convergedTruth(gl::Context& context) {
    return [&context](const std::shared_ptr<const Scene>& scene, const Camera& camera, int width,
                      int height) {
        const auto start = std::chrono::steady_clock::now();
        RenderOptions options;
        options.width = width;
        options.height = height;
        options.quality = qualityPreset("converged");
        Renderer renderer(context);
        const auto render = [&](int samples) {
            options.quality.samples = samples;
            renderer.setScene(scene, options);
            return renderer.render(camera).image;
        };
        options.aovs = {Aov::radiance, Aov::depth, Aov::normal, Aov::materialId};
        Truth truth;
        truth.image = render(kSamples);
        if (const NonFinite bad = countNonFinite(truth.image); bad.pixels > 0)
            throw Error(ExitCode::nonFinite,
                        scene->file + ": the converged picture has " + std::to_string(bad.pixels) +
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
        truth.seconds = secondsSince(start);
        return truth;
    };
}

TruthSource referenceTruth(double seconds, const std::atomic<bool>& stop) {
    return
        [=, &stop](const std::shared_ptr<const Scene>& scene, const Camera& camera, int width, int height) {
            const auto start = std::chrono::steady_clock::now();
            for (const Material& material : scene->materials)
                if (const Brdf* brdf = findBrdf(material.brdf)) requireTwin(*brdf);
            reference::TruthRequest request;
            request.width = width;
            request.height = height;
            request.options.filter = reference::PixelFilter::box;
            request.seconds = seconds;
            const reference::TruthResult result = reference::computeTruth(
                scene, camera, request, nullptr, stop, [](const reference::TruthProgress&) {},
                [](const Image&) {});
            Truth truth;
            truth.image = result.image;
            truth.standardError = ownError(result.image);
            truth.method = "reference";
            truth.note = "double precision, without OpenGL, the mean over each pixel; " +
                         std::to_string(result.unfinished) + " pixels are less exact than wanted";
            truth.seconds = secondsSince(start);
            return truth;
        };
}

TruthSource bestTruth(gl::Context& context, double seconds, const std::atomic<bool>& stop) {
    return [reference = referenceTruth(seconds, stop), converged = convergedTruth(context)](
               const std::shared_ptr<const Scene>& scene, const Camera& camera, int width, int height) {
        const bool twins =
            std::all_of(scene->materials.begin(), scene->materials.end(), [](const Material& material) {
                const Brdf* brdf = findBrdf(material.brdf);
                return brdf == nullptr || brdf->fCos != nullptr;
            });
        return (twins ? reference : converged)(scene, camera, width, height);
    };
}

}  // namespace lobe::measure
