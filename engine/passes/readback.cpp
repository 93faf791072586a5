#include "passes/readback.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace lobe {
namespace {

/// Rows of a target, bottom row first as GL counts.
void readTarget(const Targets& targets, const std::string& channel, int components, float* values) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, targets.single(channel));
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, targets.width(), targets.height(), components == 1 ? GL_RED : GL_RGBA, GL_FLOAT,
                 values);
}

std::vector<float> readTarget(const Targets& targets, const std::string& channel, int components) {
    const size_t count = static_cast<size_t>(targets.width()) * static_cast<size_t>(targets.height());
    std::vector<float> values(count * static_cast<size_t>(components));
    readTarget(targets, channel, components, values.data());
    return values;
}

/// Some drivers keep the largest half float in place of what is beyond it: infinite here, as accumulate.frag
/// makes it in each of several samples.
void markOverflow(const FramePlan& plan, float* values, size_t count) {
    constexpr float kLargestHalf = 65504.0f;
    if (plan.quality.radianceBits == 16 && plan.samples == 1)
        std::replace_if(
            values, values + count, [](float value) { return value >= kLargestHalf; },
            std::numeric_limits<float>::infinity());
}

/// Shaders mark pixels whose rays a driver did not let finish by an alpha of infinity (pass/lights.glsl).
void requireFinishedRays(const FramePlan& plan, const float* values, size_t count) {
    if (!plan.rays) return;
    size_t unfinished = 0;
    for (size_t i = 3; i < count; i += 4)
        if (!std::isfinite(values[i])) ++unfinished;
    if (unfinished > 0)
        throw ContextError("rays for shadows: " + std::to_string(unfinished) +
                           " pixels need more steps through the scene than the driver lets a shader make; "
                           "expected fewer lights or triangles on the way, or shadow maps");
}

/// Rows of a target of radiance.
std::vector<float> readRadiance(const FramePlan& plan, const Targets& targets, const std::string& channel) {
    std::vector<float> values = readTarget(targets, channel, 4);
    requireFinishedRays(plan, values.data(), values.size());
    markOverflow(plan, values.data(), values.size());
    return values;
}

void turnOver(Image& image) {
    const size_t row = static_cast<size_t>(image.width) * image.channelCount();
    for (int y = 0; y < image.height / 2; ++y)
        std::swap_ranges(image.pixel(0, y), image.pixel(0, y) + row, image.pixel(0, image.height - 1 - y));
}

/// Copies `count` components of a target into channels of the image from `first` on, turned over.
void place(Image& image, size_t first, size_t count, const std::vector<float>& values, size_t stride) {
    const auto width = static_cast<size_t>(image.width);
    for (int y = 0; y < image.height; ++y) {
        const float* source = values.data() + static_cast<size_t>(image.height - 1 - y) * width * stride;
        float* row = image.pixel(0, y) + first;
        for (size_t x = 0; x < width; ++x)
            std::copy_n(source + x * stride, count, row + x * image.channelCount());
    }
}

struct Layer {
    std::string target;  ///< of Targets; empty: the sum of the contributions
    std::vector<std::string> channels;
    int components;  ///< as stored: 1 or 4
};

std::vector<Layer> layersOf(const FramePlan& plan, const AovSet& aovs) {
    const std::string prefix = plan.samples > 1 ? "accumulated." : "";
    std::vector<Layer> layers;
    if (aovs.contains(Aov::radiance)) layers.push_back({prefix + "radiance", {"R", "G", "B", "A"}, 4});
    const auto data = [&](Aov aov, std::vector<std::string> channels, int components) {
        const std::string target = "aov." + aovNames()[static_cast<size_t>(aov)];
        if (aovs.contains(aov)) layers.push_back({target, std::move(channels), components});
    };
    data(Aov::depth, {"depth.Z"}, 1);
    data(Aov::position, {"position.X", "position.Y", "position.Z"}, 4);
    data(Aov::normal, {"normal.X", "normal.Y", "normal.Z"}, 4);
    data(Aov::albedo, {"albedo.R", "albedo.G", "albedo.B"}, 4);
    data(Aov::materialId, {"material.id"}, 1);
    data(Aov::roughness, {"roughness.Y"}, 1);
    for (const std::string& name : plan.contributionTargets)
        layers.push_back({prefix + "contribution." + name, {name + ".R", name + ".G", name + ".B"}, 4});
    return layers;
}

/// With contributions, radiance is their sum, in the order in which the passes would have added them.
std::vector<float> summedContributions(const FramePlan& plan, const Targets& targets) {
    const std::string prefix = plan.samples > 1 ? "accumulated." : "";
    std::vector<float> sum = readRadiance(plan, targets, prefix + "radiance");
    for (size_t i = 0; i < sum.size(); ++i)
        if (i % 4 != 3) sum[i] = 0.0f;
    for (const std::string& name : plan.contributionTargets) {
        const std::vector<float> part = readRadiance(plan, targets, prefix + "contribution." + name);
        for (size_t i = 0; i < sum.size(); ++i)
            if (i % 4 != 3) sum[i] += part[i];
    }
    return sum;
}

}  // namespace

Image readPicture(const FramePlan& plan, const Targets& targets, const View& view, const AovSet& aovs) {
    const std::vector<Layer> layers = layersOf(plan, aovs);
    std::vector<std::string> names;
    for (const Layer& layer : layers)
        names.insert(names.end(), layer.channels.begin(), layer.channels.end());
    Image image(targets.width(), targets.height(), names);
    if (layers.size() == 1 && layers[0].components == static_cast<int>(names.size()) &&
        targets.has(layers[0].target)) {
        // Radiance alone, as most pictures are: no copy on the way.
        readTarget(targets, layers[0].target, layers[0].components, image.values.data());
        if (layers[0].channels[0] == "R") {
            requireFinishedRays(plan, image.values.data(), image.values.size());
            markOverflow(plan, image.values.data(), image.values.size());
        }
        turnOver(image);
        return image;
    }
    size_t first = 0;
    for (const Layer& layer : layers) {
        // A scene without opaque surfaces has no data AOVs: they stay 0, "nothing is there".
        if (targets.has(layer.target)) {
            const bool sum = layer.channels[0] == "R" && !plan.contributionTargets.empty();
            const bool light =
                layer.channels[0] == "R" || layer.target.find("contribution.") != std::string::npos;
            const std::vector<float> values = sum     ? summedContributions(plan, targets)
                                              : light ? readRadiance(plan, targets, layer.target)
                                                      : readTarget(targets, layer.target, layer.components);
            place(image, first, layer.channels.size(), values, static_cast<size_t>(layer.components));
            if (layer.channels[0] == "position.X")
                for (size_t i = 0; i < image.pixelCount(); ++i) {
                    float* pixel = image.values.data() + i * image.channelCount() + first;
                    const size_t row = i / static_cast<size_t>(image.width);
                    const size_t source =
                        (static_cast<size_t>(image.height) - 1 - row) * static_cast<size_t>(image.width) +
                        i % static_cast<size_t>(image.width);
                    if (values[source * 4 + 3] == 0.0f) continue;
                    for (int c = 0; c < 3; ++c)
                        pixel[c] = static_cast<float>(static_cast<double>(pixel[c]) + view.eye[c]);
                }
        }
        first += layer.channels.size();
    }
    return image;
}

}  // namespace lobe
