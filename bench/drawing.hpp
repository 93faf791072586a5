#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include "passes/renderer.hpp"

namespace lobe::bench {

/// One way to draw a scene, kept so that rounds can go from one to the next.
class Drawing {
public:
    Drawing(gl::Context& context, const Scene& scene, const Quality& quality, int width, int height)
        : renderer_(context), camera_(scene.cameras[0]) {
        RenderOptions options;
        options.width = width;
        options.height = height;
        options.quality = quality;
        options.timePasses = true;
        const auto start = std::chrono::steady_clock::now();
        renderer_.setScene(std::make_shared<Scene>(scene), options);
        setUp_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        renderer_.render(camera_);  // compiles
    }

    /// Keeps the least time of its light passes.
    void draw() {
        double sum = 0.0;
        for (const PassTime& time : renderer_.render(camera_).passTimes)
            if (time.pass.starts_with("light.")) sum += time.milliseconds;
        least_ = std::min(least_, sum);
    }
    double milliseconds() const { return least_; }
    double setUp() const { return setUp_; }

private:
    Renderer renderer_;
    Camera camera_;
    double setUp_ = 0.0;
    double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace lobe::bench
