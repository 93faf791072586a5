#pragma once

#include <algorithm>
#include <ctime>
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
        const std::clock_t start = std::clock();
        renderer_.setScene(std::make_shared<Scene>(scene), options);
        renderer_.render(camera_);  // compiles
        setUp_ = 1e3 * secondsSince(start);
    }

    /// Keeps the least time.
    void draw() {
        const std::clock_t start = std::clock();
        renderer_.render(camera_);
        least_ = std::min(least_, secondsSince(start));
    }
    /// Of the processor, all threads of this process: other programs hardly change it.
    double seconds() const { return least_; }
    /// Of the processor, ms, for what is made once a scene and the first picture.
    double setUp() const { return setUp_; }

private:
    static double secondsSince(std::clock_t start) {
        return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }

    Renderer renderer_;
    Camera camera_;
    double setUp_ = 0.0;
    double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace lobe::bench
