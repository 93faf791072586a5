#include "reference/surface.hpp"

#include <algorithm>
#include <cmath>

#include "math/sphere.hpp"

namespace lobe::reference {
namespace {

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0.0 ? glm::normalize(v / largest) : glm::dvec3(0.0);
}

template<class Value>
auto blended(const std::vector<Value>& values, const std::array<uint32_t, 3>& corner,
             const glm::dvec3& weights) {
    using Wide = glm::vec<Value::length(), double>;
    return weights.x * Wide(values[corner[0]]) + weights.y * Wide(values[corner[1]]) +
           weights.z * Wide(values[corner[2]]);
}

/// Cofactors: the inverse transpose also of matrices that have none, up to the determinant's size.
glm::dmat3 normalMatrix(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

/// z: the normal; x: what of the tangent is perpendicular to it.
glm::dmat3 tangentFrame(const glm::dvec3& normal, const glm::dvec4& tangent) {
    const glm::dvec3 along = glm::dvec3(tangent);
    const glm::dvec3 across = along - normal * glm::dot(normal, along);
    constexpr double kParallel = 1e-6;  // as the shaders have it: no direction is left
    if (!(glm::length(across) > kParallel * glm::length(along))) return frameAbout(normal);
    const glm::dvec3 x = unitOrZero(across);
    return {x, (tangent.w < 0.0 ? -1.0 : 1.0) * glm::cross(normal, x), normal};
}

}  // namespace

Surfaces::Surfaces(const Scene& scene) : scene_(scene), textures_(scene) {
    for (const Instance& instance : scene.instances) {
        const glm::dmat3 linear(instance.worldFromLocal);
        normalFromLocal_.push_back(normalMatrix(linear));
        mirrored_.push_back(glm::determinant(linear) < 0.0);
    }
}

const Primitive& Surfaces::primitiveOf(unsigned instance) const {
    return scene_.primitives[static_cast<size_t>(scene_.instances[instance].primitive)];
}

const Material& Surfaces::materialOf(unsigned instance) const {
    return scene_.materials[static_cast<size_t>(primitiveOf(instance).material)];
}

AlphaMode Surfaces::alphaMode(unsigned instance) const {
    return materialOf(instance).alphaMode;
}

bool Surfaces::doubleSided(unsigned instance) const {
    return materialOf(instance).doubleSided;
}

std::array<uint32_t, 3> Surfaces::indices(const Facet& facet) const {
    const uint32_t* first = &primitiveOf(facet.instance).indices[size_t{3} * facet.triangle];
    return {first[0], first[1], first[2]};
}

std::array<glm::dvec3, 3> Surfaces::corners(const Facet& facet) const {
    const Primitive& primitive = primitiveOf(facet.instance);
    const glm::dmat4& world = scene_.instances[facet.instance].worldFromLocal;
    std::array<glm::dvec3, 3> result;
    const auto corner = indices(facet);
    for (size_t i = 0; i < 3; ++i)
        result[i] = glm::dvec3(world * glm::dvec4(primitive.positions[corner[i]], 1.0));
    return result;
}

double Surfaces::distanceTo(const Facet& facet, const Ray& ray) const {
    const auto [a, b, c] = corners(facet);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    return glm::dot(a - ray.origin, normal) / glm::dot(ray.direction, normal);
}

bool Surfaces::frontSeen(const Facet& facet, const glm::dvec3& direction) const {
    const auto [a, b, c] = corners(facet);
    return (glm::dot(glm::cross(b - a, c - a), direction) < 0.0) != mirrored_[facet.instance];
}

/// By the volumes that the ray spans with the edges (Moller, Trumbore 1997): exact where the ray passes a
/// corner.
glm::dvec3 Surfaces::weightsAt(const Facet& facet, const Ray& ray) const {
    const auto [a, b, c] = corners(facet);
    const glm::dvec3 pa = a - ray.origin, pb = b - ray.origin, pc = c - ray.origin;
    const glm::dvec3 volumes(glm::dot(ray.direction, glm::cross(pb, pc)),
                             glm::dot(ray.direction, glm::cross(pc, pa)),
                             glm::dot(ray.direction, glm::cross(pa, pb)));
    const double sum = volumes.x + volumes.y + volumes.z;
    return sum != 0.0 ? volumes / sum : glm::dvec3(1.0 / 3.0);
}

UvFootprint Surfaces::footprint(const Facet& facet, int set, const glm::dvec3& weights, const glm::dvec3& dx,
                                const glm::dvec3& dy, bool known) const {
    const auto& uvs = primitiveOf(facet.instance).uvs[static_cast<size_t>(set)];
    const auto corner = indices(facet);
    UvFootprint result{blended(uvs, corner, weights), {}, {}, known};
    if (known) {
        result.dx = blended(uvs, corner, dx - weights);
        result.dy = blended(uvs, corner, dy - weights);
    }
    return result;
}

double Surfaces::alphaAt(const Facet& facet, const glm::dvec3& weights, const glm::dvec3& dx,
                         const glm::dvec3& dy, bool known) const {
    const Material& material = materialOf(facet.instance);
    const Primitive& primitive = primitiveOf(facet.instance);
    double alpha = double{material.alpha};
    if (material.baseColorTexture)
        alpha *= textures_
                     .read(material.baseColorTexture, true,
                           footprint(facet, material.baseColorTexture.uvSet, weights, dx, dy, known))
                     .a;
    if (!primitive.colors.empty()) alpha *= blended(primitive.colors, indices(facet), weights).a;
    if (material.alphaMode == AlphaMode::mask) return alpha < double{material.alphaCutoff} ? 0.0 : 1.0;
    return std::clamp(alpha, 0.0, 1.0);
}

double Surfaces::coverage(const Facet& facet, const PixelRay& ray) const {
    if (alphaMode(facet.instance) == AlphaMode::opaque) return 1.0;
    return alphaAt(facet, weightsAt(facet, ray), weightsAt(facet, ray.dx), weightsAt(facet, ray.dy), true);
}

double Surfaces::coverage(const Facet& facet, const Ray& ray) const {
    if (alphaMode(facet.instance) == AlphaMode::opaque) return 1.0;
    return alphaAt(facet, weightsAt(facet, ray), {}, {}, false);
}

SurfacePoint Surfaces::at(const Facet& facet, const PixelRay& ray) const {
    SurfacePoint point;
    point.facet = facet;
    point.material = primitiveOf(facet.instance).material;
    const glm::dvec3 weights = weightsAt(facet, ray);
    const auto [a, b, c] = corners(facet);
    point.position = weights.x * a + weights.y * b + weights.z * c;
    point.extent = std::max({glm::distance(point.position, a), glm::distance(point.position, b),
                             glm::distance(point.position, c)});
    const glm::dvec3 normal = unitOrZero(glm::cross(b - a, c - a));
    point.geometricNormal = glm::dot(normal, ray.direction) < 0.0 ? normal : -normal;
    const glm::dvec3 dx = weightsAt(facet, ray.dx), dy = weightsAt(facet, ray.dy);
    if (alphaMode(facet.instance) == AlphaMode::blend) point.alpha = alphaAt(facet, weights, dx, dy, true);
    shade(point, weights, dx, dy, frontSeen(facet, ray.direction));
    return point;
}

void Surfaces::shade(SurfacePoint& point, const glm::dvec3& weights, const glm::dvec3& dx,
                     const glm::dvec3& dy, bool front) const {
    const Facet& facet = point.facet;
    const Primitive& primitive = primitiveOf(facet.instance);
    const Material& material = materialOf(facet.instance);
    const auto corner = indices(facet);
    const auto read = [&](const TextureSlot& slot, bool srgb) {
        return textures_.read(slot, srgb, footprint(facet, slot.uvSet, weights, dx, dy, true));
    };
    const glm::dvec3 color =
        primitive.colors.empty() ? glm::dvec3(1.0) : glm::dvec3(blended(primitive.colors, corner, weights));
    point.brdf = findBrdf(material.brdf);
    if (point.brdf == nullptr) {
        point.emission = material.metallicRoughness.baseColor * color;
        if (material.baseColorTexture) point.emission *= glm::dvec3(read(material.baseColorTexture, true));
        return;
    }
    point.values = material.values;
    for (size_t p = 0; p < material.textures.size(); ++p) {
        const Parameter& parameter = point.brdf->parameters[p];
        const auto offset = static_cast<size_t>(point.brdf->valueOffset(static_cast<int>(p)));
        if (material.textures[p]) {
            const glm::dvec4 texel = read(material.textures[p], parameter.textureIsSrgb);
            for (int c = 0; c < parameter.components(); ++c)
                point.values[offset + static_cast<size_t>(c)] *=
                    texel[parameter.kind == ParameterKind::rgb ? c : material.textureChannels[p]];
        }
        if (parameter.name == point.brdf->baseColorParameter)
            for (int c = 0; c < 3; ++c)
                point.values[offset + static_cast<size_t>(c)] *= color[c];
    }
    point.emission = glm::dvec3(material.emission);
    if (material.emissionTexture && material.emission != glm::vec3(0.0F))
        point.emission *= glm::dvec3(read(material.emissionTexture, true));
    if (material.occlusionTexture)
        point.occlusion =
            1.0 + double{material.occlusionStrength} * (read(material.occlusionTexture, false).r - 1.0);

    // Vertex normals and tangents are made unit, blended, and not made unit again before the normal map.
    const glm::dmat3& normalFromLocal = normalFromLocal_[facet.instance];
    const glm::dmat3 worldFromLocal(scene_.instances[facet.instance].worldFromLocal);
    glm::dvec3 vertexNormal(0.0);
    glm::dvec4 tangent(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto index = corner[static_cast<size_t>(i)];
        vertexNormal += weights[i] * unitOrZero(normalFromLocal * glm::dvec3(primitive.normals[index]));
        if (!primitive.tangents.empty()) {
            const glm::dvec4 given(primitive.tangents[index]);
            tangent += weights[i] * glm::dvec4(unitOrZero(worldFromLocal * glm::dvec3(given)), given.w);
        }
    }
    glm::dvec3 normal = vertexNormal;
    if (material.normalTexture && !primitive.tangents.empty()) {
        const glm::dvec3 texel = (glm::dvec3(read(material.normalTexture, false)) * 2.0 - 1.0) *
                                 glm::dvec3(double{material.normalScale}, double{material.normalScale}, 1.0);
        const glm::dvec3 along(tangent);
        normal = along * texel.x + (tangent.w * glm::cross(vertexNormal, along)) * texel.y +
                 vertexNormal * texel.z;
    }
    if (!front) normal = -normal;
    // Where vertex normals cancel out, the shaders take +Z.
    constexpr double kCancelled = 1e-12;
    normal = glm::dot(normal, normal) > kCancelled ? glm::normalize(normal) : glm::dvec3(0.0, 0.0, 1.0);
    point.frame = primitive.tangents.empty() || !point.brdf->traits.usesTangent
                      ? frameAbout(normal)
                      : tangentFrame(normal, tangent);
}

}  // namespace lobe::reference
