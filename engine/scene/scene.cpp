#include "scene/scene.hpp"

#include <algorithm>
#include <glm/gtc/constants.hpp>

namespace lobe {

void Bounds::add(const glm::dvec3& point) {
    lower = empty ? point : glm::min(lower, point);
    upper = empty ? point : glm::max(upper, point);
    empty = false;
}

glm::dvec3 radianceOf(const Light& light) {
    constexpr double kPi = glm::pi<double>();
    const double disk = kPi * light.radius * light.radius;
    switch (light.type) {
        case LightType::rect:
        case LightType::disk:
            return light.intensity;
        case LightType::sphere:
            return light.intensity / disk;
        case LightType::tube:
            return light.intensity / (2.0 * light.radius * light.length + disk);
        default:
            return glm::dvec3(0.0);
    }
}

bool seesThrough(const Material& material) {
    const Brdf* brdf = findBrdf(material.brdf);
    return brdf != nullptr && brdf->transmittance &&
           brdf->transmittance(1.0, material.values) != glm::dvec3(0.0);
}

Bounds Scene::bounds() const {
    std::vector<Bounds> local(primitives.size());
    for (size_t i = 0; i < primitives.size(); ++i)
        for (const glm::vec3& position : primitives[i].positions)
            local[i].add(position);
    Bounds world;
    for (const Instance& instance : instances) {
        const Bounds& box = local[static_cast<size_t>(instance.primitive)];
        if (box.empty) continue;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1) != 0 ? box.upper.x : box.lower.x,
                                   (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                   (corner & 4) != 0 ? box.upper.z : box.lower.z);
            world.add(glm::dvec3(instance.worldFromLocal * glm::dvec4(point, 1.0)));
        }
    }
    return world;
}

size_t Scene::triangleCount() const {
    size_t count = 0;
    for (const Instance& instance : instances)
        count += primitives[static_cast<size_t>(instance.primitive)].triangleCount();
    return count;
}

}  // namespace lobe
