#include "shadow_maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/timing.hpp"
#include "passes/renderer.hpp"
#include "reference/tracer.hpp"
#include "support/scenes.hpp"

namespace lobe::bench {
namespace {

using namespace lobe::test;

/// Lights of one type in one place: what one more costs is the slope. Unshadowed ones are so cheap that it
/// takes many.
constexpr int kMapped = 5, kPlain = 65;

Scene ballAndPlane(const Light& light, int count) {
    Scene scene;
    const int material = addMaterial(scene, "lambert");
    const glm::dmat4 flat = glm::rotate(glm::dmat4(1.0), -0.5 * std::numbers::pi, glm::dvec3(1, 0, 0));
    addInstance(scene, addQuad(scene, material, 3.0f), flat);
    addInstance(scene, addSphere(scene, material, 67),
                glm::scale(glm::translate(glm::dmat4(1.0), {0, 0.6, 0}), glm::dvec3(0.5)));
    scene.lights.assign(static_cast<size_t>(count), light);
    return scene;
}

Camera eye() {
    Camera camera = lookAt({0.4, 2.2, 3.2}, {0.3, 0.2, 0}, 0.7);
    camera.zNear = 0.05;
    return camera;
}

struct Times {
    double frame = std::numeric_limits<double>::infinity();  ///< ms, maps drawn before
    double first = std::numeric_limits<double>::infinity();  ///< ms, with the maps
};

class Drawn {
public:
    Drawn(gl::Context& context, const Scene& scene, int width, int height, const Quality& quality)
        : renderer_(context),
          clock_(measure::clockOf(context.info())),
          scene_(std::make_shared<Scene>(scene)) {
        options_.width = width;
        options_.height = height;
        options_.quality = quality;
        options_.timePasses = clock_ == measure::Clock::timerQueries;
        renderer_.setScene(scene_, options_);
        image_ = renderer_.render(eye()).image;  // compiles
    }
    /// Keeps the least times.
    void draw() {
        renderer_.setScene(scene_, options_);
        least_.first = std::min(least_.first, measure::timeFrame(renderer_, eye(), clock_).clock);
        for (int i = 0; i < 2; ++i)
            least_.frame = std::min(least_.frame, measure::timeFrame(renderer_, eye(), clock_).clock);
    }
    const Times& least() const { return least_; }
    const Image& image() const { return image_; }

private:
    Renderer renderer_;
    measure::Clock clock_;
    std::shared_ptr<const Scene> scene_;
    RenderOptions options_;
    Image image_;
    Times least_;
};

/// Visibility through each pixel's centre, -1 where nothing is seen.
std::vector<double> truth(const Scene& scene, int width, int height) {
    const View view = makeView(eye(), width, height);
    const reference::Tracer tracer(std::make_shared<Scene>(scene), view.eye);
    const Light& light = scene.lights[0];
    std::vector<double> visible;
    std::vector<reference::SurfacePoint> layers;
    for (int row = 0; row < height; ++row)
        for (int x = 0; x < width; ++x) {
            tracer.surfacesAlong(reference::pixelRay(view, x + 0.5, height - row - 0.5), nullptr, layers);
            if (layers.empty()) {
                visible.push_back(-1.0);
                continue;
            }
            const bool far = light.type == LightType::directional;
            visible.push_back(tracer.visibility(layers[0],
                                                far ? -light.direction : light.position - layers[0].position,
                                                far ? std::numeric_limits<double>::infinity() : 1.0));
        }
    return visible;
}

void compare(const Image& shadowed, const Image& plain, const std::vector<double>& truth,
             ShadowMapResult& result) {
    int pixels = 0, wrong = 0;
    double sum = 0.0;
    for (int y = 0; y < plain.height; ++y)
        for (int x = 0; x < plain.width; ++x) {
            const double v =
                truth[static_cast<size_t>(y) * static_cast<size_t>(plain.width) + static_cast<size_t>(x)];
            const auto full = static_cast<double>(plain.pixel(x, y)[1]);
            if (v < 0.0 || !(full > 0.0)) continue;
            const double off = std::abs(static_cast<double>(shadowed.pixel(x, y)[1]) / full - v);
            ++pixels;
            sum += off;
            wrong += off > 0.5 ? 1 : 0;
        }
    result.error = sum / pixels;
    result.wrong = static_cast<double>(wrong) / pixels;
}

}  // namespace

std::vector<ShadowMapResult> shadowMapResults(gl::Context& context, int width, int height, int rounds,
                                              const std::function<void(const ShadowMapResult&)>& done) {
    const std::pair<const char*, Light> lights[] = {
        {"directional", directional({0.6, -1.0, -0.2}, glm::dvec3(2.0))},
        {"point", point({-1.5, 3.0, 1.0}, glm::dvec3(20.0))},
        {"spot", spot({-1.5, 3.0, 1.0}, {0.2, 0, 0}, glm::dvec3(20.0), 0.6, 0.8)}};
    std::vector<ShadowMapResult> results;
    for (const auto& [name, light] : lights) {
        Quality quality{.samples = 1, .gbufferBits = 32};
        quality.shadows = Shadows::none;
        const Scene one = ballAndPlane(light, 1), mapped = ballAndPlane(light, kMapped);
        const Scene plainMany = ballAndPlane(light, kPlain);
        const std::vector<double> visible = truth(one, width, height);
        Drawn fewPlain(context, one, width, height, quality),
            manyPlain(context, plainMany, width, height, quality);
        quality.shadows = Shadows::hard;
        quality.shadowMethod = ShadowMethod::maps;
        for (const int size : {512, 1024, 2048, 4096})
            for (const int taps : {1, 4, 16, 64}) {
                if (size != 2048 && taps > 4) continue;
                quality.shadowSize = size;
                quality.shadowTaps = taps;
                Drawn fewMapped(context, one, width, height, quality),
                    manyMapped(context, mapped, width, height, quality);
                for (int round = 0; round < rounds; ++round)
                    for (Drawn* drawn : {&fewPlain, &manyPlain, &fewMapped, &manyMapped})
                        drawn->draw();
                const double plain = (manyPlain.least().frame - fewPlain.least().frame) / (kPlain - 1);
                ShadowMapResult result{name, size, taps, 0.0, 0.0, 0.0, 0.0};
                result.lookUp = (manyMapped.least().frame - fewMapped.least().frame) / (kMapped - 1) / plain;
                result.draw = (fewMapped.least().first - fewMapped.least().frame -
                               (fewPlain.least().first - fewPlain.least().frame)) /
                              plain;
                compare(fewMapped.image(), fewPlain.image(), visible, result);
                results.push_back(result);
                done(result);
            }
    }
    return results;
}

}  // namespace lobe::bench
