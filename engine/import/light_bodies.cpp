#include "import/light_bodies.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace lobe {
namespace {

/// Corners of a circle; an outline is off by at most 5e-4 of its radius.
constexpr int kAround = 96;
/// Rings of triangles from pole to equator.
constexpr int kRings = 24;

void addPoint(Primitive& body, const glm::dvec3& position, const glm::dvec3& normal) {
    body.positions.emplace_back(position);
    body.normals.emplace_back(normal);
}

/// x: along `axis`, z: the way that the light goes. Its image's left is where x is largest, its top where y
/// is least.
Primitive rectBody(const Light& light) {
    Primitive body;
    const glm::dvec2 half(light.width / 2, light.height / 2);
    for (const glm::dvec2& corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        addPoint(body, glm::dvec3(corner * half, 0.0), {0.0, 0.0, 1.0});
        if (light.image >= 0) body.uvs[0].emplace_back(0.5 - 0.5 * corner.x, 0.5 + 0.5 * corner.y);
    }
    body.indices = {0, 1, 2, 0, 2, 3};
    return body;
}

Primitive diskBody(const Light& light) {
    Primitive body;
    for (uint32_t i = 0; i < kAround; ++i) {
        const double phi = glm::two_pi<double>() * i / kAround;
        addPoint(body, light.radius * glm::dvec3(std::cos(phi), std::sin(phi), 0.0), {0.0, 0.0, 1.0});
        if (i >= 2) body.indices.insert(body.indices.end(), {0, i - 1, i});
    }
    return body;
}

/// A sphere cut at its equator, whose halves stand apart by the tube's length; poles along x.
Primitive roundBody(const Light& light) {
    Primitive body;
    for (int ring = 0; ring <= 2 * kRings + 1; ++ring) {
        const bool second = ring > kRings;
        const double theta = glm::half_pi<double>() * (second ? ring - 1 : ring) / kRings;
        const double shift = (second ? -0.5 : 0.5) * light.length;
        for (int i = 0; i <= kAround; ++i) {
            const double phi = glm::two_pi<double>() * i / kAround;
            const glm::dvec3 n(std::cos(theta), std::sin(theta) * std::cos(phi),
                               std::sin(theta) * std::sin(phi));
            addPoint(body, light.radius * n + glm::dvec3(shift, 0.0, 0.0), n);
        }
    }
    const uint32_t row = kAround + 1;
    for (uint32_t ring = 0; ring < 2 * kRings + 1; ++ring)
        for (uint32_t i = 0; i < kAround; ++i) {
            const uint32_t a = ring * row + i, b = a + 1, c = a + row, d = c + 1;
            body.indices.insert(body.indices.end(), {a, c, b, b, c, d});
        }
    return body;
}

}  // namespace

void addBody(Scene& scene, const Light& light, int texture) {
    Material material;
    material.name = light.name;
    material.brdf = "unlit";
    material.metallicRoughness.baseColor = radianceOf(light);
    material.baseColorTexture.texture = texture;
    scene.materials.push_back(material);

    Primitive body = light.type == LightType::rect   ? rectBody(light)
                     : light.type == LightType::disk ? diskBody(light)
                                                     : roundBody(light);
    body.name = light.name;
    body.material = static_cast<int>(scene.materials.size()) - 1;
    scene.primitives.push_back(std::move(body));

    const glm::dvec3 z = light.direction, x = light.axis;
    const glm::dmat4 turned(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0),
                            glm::dvec4(light.position, 1.0));
    scene.instances.push_back({static_cast<int>(scene.primitives.size()) - 1, turned, light.name, false});
}

}  // namespace lobe
