/// Scenes built in memory for tests.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe::test {

/// A material of a registered model, with its default parameters.
inline int addMaterial(Scene& scene, const std::string& brdf) {
    Material material;
    material.name = brdf + std::to_string(scene.materials.size());
    material.brdf = brdf;
    if (const Brdf* model = findBrdf(brdf)) {
        material.values = model->defaults();
        material.textures.resize(model->parameters.size());
        material.textureChannels.resize(model->parameters.size());
    }
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

inline void setParameter(Material& material, const std::string& name, const glm::dvec3& value) {
    const Brdf& brdf = requireBrdf(material.brdf);
    const int index = brdf.parameterIndex(name);
    if (index < 0) throw std::logic_error("no parameter " + name);
    const int offset = brdf.valueOffset(index);
    for (int c = 0; c < brdf.parameters[static_cast<size_t>(index)].components(); ++c)
        material.values[static_cast<size_t>(offset + c)] = value[c];
}

inline void addInstance(Scene& scene, int primitive, const glm::dmat4& worldFromLocal = glm::dmat4(1.0)) {
    scene.instances.push_back({primitive, worldFromLocal, "node" + std::to_string(scene.instances.size())});
}

/// A square of the given half size in the plane z = 0, facing +Z, with UV 0..1.
inline int addQuad(Scene& scene, int material, float half) {
    Primitive quad;
    quad.material = material;
    quad.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
    quad.normals.assign(4, glm::vec3(0, 0, 1));
    quad.tangents.assign(4, glm::vec4(1, 0, 0, 1));
    quad.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    quad.indices = {0, 1, 2, 0, 2, 3};
    scene.primitives.push_back(quad);
    return static_cast<int>(scene.primitives.size()) - 1;
}

/// A unit sphere of n x 2n quads with exact normals.
inline int addSphere(Scene& scene, int material, int n = 48) {
    Primitive sphere;
    sphere.material = material;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= 2 * n; ++j) {
            const double theta = std::numbers::pi * i / n;
            const double phi = std::numbers::pi * j / n;
            const glm::vec3 p(std::sin(theta) * std::cos(phi), std::cos(theta),
                              -std::sin(theta) * std::sin(phi));
            sphere.positions.push_back(p);
            sphere.normals.push_back(p);
            sphere.uvs[0].emplace_back(j / (2.0 * n), static_cast<double>(i) / n);
        }
    const auto index = [n](int i, int j) { return static_cast<uint32_t>(i * (2 * n + 1) + j); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j)
            for (uint32_t v : {index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j),
                               index(i + 1, j + 1), index(i, j + 1)})
                sphere.indices.push_back(v);
    scene.primitives.push_back(sphere);
    return static_cast<int>(scene.primitives.size()) - 1;
}

inline Light directional(const glm::dvec3& direction, const glm::dvec3& irradiance) {
    Light light;
    light.type = LightType::directional;
    light.direction = glm::normalize(direction);
    light.intensity = irradiance;
    return light;
}

inline Light point(const glm::dvec3& position, const glm::dvec3& intensity,
                   std::optional<double> range = {}) {
    Light light;
    light.type = LightType::point;
    light.position = position;
    light.intensity = intensity;
    light.range = range;
    return light;
}

inline Light spot(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& intensity,
                  double inner, double outer) {
    Light light;
    light.type = LightType::spot;
    light.position = position;
    light.direction = glm::normalize(target - position);
    light.intensity = intensity;
    light.innerConeAngle = inner;
    light.outerConeAngle = outer;
    return light;
}

/// An image of one channel count filled by f(x, y, c) in 0..255.
template<class F>
int addImage(Scene& scene, int width, int height, int channels, F f) {
    Bitmap bitmap{width, height, channels, ComponentType::u8, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                bitmap.data.push_back(static_cast<std::byte>(f(x, y, c)));
    scene.images.push_back(bitmap);
    scene.imageNames.push_back("image" + std::to_string(scene.images.size()));
    scene.textures.push_back({static_cast<int>(scene.images.size()) - 1, {}});
    return static_cast<int>(scene.textures.size()) - 1;
}

}  // namespace lobe::test
