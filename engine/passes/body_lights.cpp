#include "passes/body_lights.hpp"

#include <algorithm>

#include "shading/punctual.hpp"

namespace lobe {
namespace {

constexpr const char* kNames[] = {"Rect", "Disk", "Sphere", "Tube"};

LightType typeAt(size_t index) {
    return static_cast<LightType>(static_cast<size_t>(LightType::rect) + index);
}

void push(std::vector<float>& data, const glm::dvec3& xyz, double w) {
    for (int i = 0; i < 3; ++i)
        data.push_back(static_cast<float>(xyz[i]));
    data.push_back(static_cast<float>(w));
}

/// A body of less than this is drawn as large as this, with its radiant intensity kept: smaller ones would
/// have a radiance beyond float, and look the same.
constexpr double kSmallestRadius = 1e-12;

Light drawn(const Light& light) {
    Light result = light;
    if (light.type == LightType::sphere || light.type == LightType::tube)
        result.radius = std::max(light.radius, kSmallestRadius);
    return result;
}

/// Half width and half height; radius; half length and radius.
std::pair<double, double> sizesOf(const Light& light) {
    if (light.type == LightType::rect) return {light.width / 2.0, light.height / 2.0};
    if (light.type == LightType::tube) return {light.length / 2.0, light.radius};
    return {light.radius, 0.0};
}

std::string uniform(LightType type, const char* what) {
    return std::string("u") + kNames[static_cast<size_t>(type) - static_cast<size_t>(LightType::rect)] + what;
}

}  // namespace

BodyLights::BodyLights(const Scene& scene, const FramePlan& plan)
    : images_(scene, plan), hasImages_(plan.lightImages), frames_(plan.samples) {
    for (const Light& light : scene.lights)
        if (!isPunctual(light.type))
            lights_[static_cast<size_t>(light.type) - static_cast<size_t>(LightType::rect)].push_back(&light);
    for (size_t i = 0; i < kTypes; ++i)
        shadows_[i] = plan.shadowOf(typeAt(i)) != PlannedShadow::none;
}

void BodyLights::update(const View& view, int frame) {
    frame_ = frame;
    for (size_t i = 0; i < kTypes; ++i) {
        if (lights_[i].empty()) continue;
        std::vector<float> data;
        int casting = 0;
        for (const Light* kept : lights_[i]) {
            const Light light = drawn(*kept);
            const auto [a, b] = sizesOf(light);
            push(data, light.position - view.eye, inverseRange2(light.range));
            push(data, radianceOf(light), shadows_[i] && light.castsShadow ? casting++ : -1);
            push(data, light.axis, a);
            push(data, light.direction, b);
            if (hasImages_ && light.type == LightType::rect) {
                const glm::dvec4 name = images_.nameOf(light);
                push(data, name, name.w);
            }
        }
        buffers_[i] = gl::makeTextureBuffer(GL_RGBA32F, data.data(), data.size() * sizeof(float));
    }
}

std::vector<const Light*> BodyLights::casting(LightType type) const {
    std::vector<const Light*> result;
    for (const Light* light : lights(type))
        if (light->castsShadow) result.push_back(light);
    return result;
}

void BodyLights::setLights(const gl::Program& program, LightType type, int first, int end) {
    program.set(uniform(type, "First"), first);
    program.set(uniform(type, "End"), end);
}

void BodyLights::setPoints(const gl::Program& program, int from, int to, int points) {
    program.set("uAreaPointsFirst", from);
    program.set("uAreaPointsEnd", to);
    program.set("uAreaPointsAll", points);
}

int BodyLights::bind(const gl::Program& program, int firstUnit, int points) const {
    int unit = firstUnit;
    for (size_t i = 0; i < kTypes; ++i) {
        const std::string name = uniform(typeAt(i), "Lights");
        if (!buffers_[i].texture || program.uniform(name) < 0) continue;
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(GL_TEXTURE_BUFFER, buffers_[i].texture.id());
        program.set(name, unit++);
        setLights(program, typeAt(i), 0, static_cast<int>(lights_[i].size()));
    }
    images_.bind(program);
    program.set("uAreaPointsEver", static_cast<float>(points) * static_cast<float>(frames_));
    program.set("uAreaStart", frame_ * points);
    setPoints(program, 0, points, points);
    return unit;
}

}  // namespace lobe
