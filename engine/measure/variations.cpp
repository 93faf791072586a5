#include "measure/variations.hpp"

#include <algorithm>
#include <map>

namespace lobe::measure {
namespace {

template<class Vector>
Vector middle(const Vector& a, const Vector& b) {
    return (a + b) * 0.5f;
}

/// Adds the middle of two vertices to every array that there is.
uint32_t addMiddle(Primitive& primitive, uint32_t a, uint32_t b) {
    const auto unit = [](const glm::vec3& v) {
        const float length = glm::length(v);
        return length > 0.0f ? v / length : v;
    };
    primitive.positions.push_back(middle(primitive.positions[a], primitive.positions[b]));
    if (!primitive.normals.empty())
        primitive.normals.push_back(unit(middle(primitive.normals[a], primitive.normals[b])));
    if (!primitive.tangents.empty()) {
        const glm::vec4 sum = middle(primitive.tangents[a], primitive.tangents[b]);
        primitive.tangents.emplace_back(unit(glm::vec3(sum)), primitive.tangents[a].w);
    }
    for (std::vector<glm::vec2>& uv : primitive.uvs)
        if (!uv.empty()) uv.push_back(middle(uv[a], uv[b]));
    if (!primitive.colors.empty())
        primitive.colors.push_back(middle(primitive.colors[a], primitive.colors[b]));
    return static_cast<uint32_t>(primitive.positions.size() - 1);
}

void subdivide(Primitive& primitive) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto between = [&](uint32_t a, uint32_t b) {
        const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), 0u);
        if (isNew) place->second = addMiddle(primitive, a, b);
        return place->second;
    };
    std::vector<uint32_t> indices;
    indices.reserve(4 * primitive.indices.size());
    for (size_t t = 0; t < primitive.indices.size(); t += 3) {
        const uint32_t a = primitive.indices[t], b = primitive.indices[t + 1], c = primitive.indices[t + 2];
        const uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
        indices.insert(indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    primitive.indices = std::move(indices);
}

}  // namespace

Scene withLightCopies(const Scene& scene, int copies) {
    Scene result = scene;
    result.lights.clear();
    for (Light light : scene.lights) {
        light.intensity /= copies;
        result.lights.insert(result.lights.end(), static_cast<size_t>(copies), light);
    }
    return result;
}

Scene withFinerTriangles(const Scene& scene, int levels) {
    Scene result = scene;
    for (Primitive& primitive : result.primitives)
        for (int level = 0; level < levels; ++level)
            subdivide(primitive);
    return result;
}

Scene withMaterialParts(const Scene& scene, int parts) {
    Scene result = scene;
    result.primitives.clear();
    result.instances.clear();
    std::vector<std::vector<int>> partsOf;
    for (const Primitive& primitive : scene.primitives) {
        const size_t triangles = primitive.triangleCount();
        const size_t count =
            std::clamp<size_t>(static_cast<size_t>(parts), 1, std::max<size_t>(1, triangles));
        partsOf.emplace_back();
        for (size_t p = 0; p < count; ++p) {
            Primitive part = primitive;
            const auto at = [&](size_t end) {
                return primitive.indices.begin() + static_cast<std::ptrdiff_t>(3 * (triangles * end / count));
            };
            part.indices.assign(at(p), at(p + 1));
            if (p > 0) {
                result.materials.push_back(scene.materials[static_cast<size_t>(primitive.material)]);
                part.material = static_cast<int>(result.materials.size()) - 1;
            }
            partsOf.back().push_back(static_cast<int>(result.primitives.size()));
            result.primitives.push_back(std::move(part));
        }
    }
    for (const Instance& instance : scene.instances)
        for (const int part : partsOf[static_cast<size_t>(instance.primitive)]) {
            result.instances.push_back(instance);
            result.instances.back().primitive = part;
        }
    return result;
}

}  // namespace lobe::measure
