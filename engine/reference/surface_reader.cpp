#include "reference/surface_reader.hpp"

#include <algorithm>
#include <cmath>

#include "math/sphere.hpp"

namespace lobe::reference {
namespace {

struct TextureCoordinate {
    glm::dvec2 uv{0.0}, dx{0.0}, dy{0.0};
};

glm::dvec3 interpolated(const std::array<glm::dvec3, 3>& values, const glm::dvec3& weights) {
    return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
}

/// The frame about n whose x axis is the part of `tangent` at right angles to n; any frame where that has no
/// such part. tangent.w is glTF's handedness.
glm::dmat3 frameWithTangent(const glm::dvec3& n, const glm::dvec4& tangent) {
    const glm::dvec3 given(tangent);
    const glm::dvec3 t = given - n * glm::dot(n, given);
    // Below this floats, in which tangents are stored, hold no direction.
    if (!(glm::length(t) > 1e-6 * glm::length(given))) return frameAbout(n);
    const glm::dvec3 x = glm::normalize(t);
    return {x, (tangent.w < 0.0 ? -1.0 : 1.0) * glm::cross(n, x), n};
}

}  // namespace

/// A point of a triangle, with its interpolated attributes.
struct SurfaceReader::Place {
    const Mesh& mesh;
    std::array<size_t, 3> corners;
    const glm::dvec3& weights;
    const Footprint& footprint;

    Place(const Mesh& surface, const Hit& hit, const Footprint& change)
        : mesh(surface), corners(surface.corners(hit.triangle)), weights(hit.weights), footprint(change) {}

    glm::dvec3 normal() const {
        return interpolated(
            {mesh.vertexNormal(corners[0]), mesh.vertexNormal(corners[1]), mesh.vertexNormal(corners[2])},
            weights);
    }
    glm::dvec4 tangent() const {
        glm::dvec4 sum(0.0);
        for (int i = 0; i < 3; ++i)
            sum += weights[i] * mesh.vertexTangent(corners[static_cast<size_t>(i)]);
        return sum;
    }
    bool hasColor() const { return !mesh.primitive().colors.empty(); }
    glm::dvec4 color() const {
        glm::dvec4 sum(hasColor() ? 0.0 : 1.0);
        for (int i = 0; hasColor() && i < 3; ++i)
            sum += weights[i] * glm::dvec4(mesh.primitive().colors[corners[static_cast<size_t>(i)]]);
        return sum;
    }
    /// With KHR_texture_transform: translation * rotation * scale.
    TextureCoordinate coordinate(const TextureSlot& slot) const {
        TextureCoordinate result;
        const std::vector<glm::vec2>& uvs = mesh.primitive().uvs[static_cast<size_t>(slot.uvSet)];
        if (uvs.empty()) {
            result.uv = glm::dvec2(slot.offset);
            return result;
        }
        const double c = std::cos(static_cast<double>(slot.rotation));
        const double s = std::sin(static_cast<double>(slot.rotation));
        const glm::dvec2 scale(slot.scale);
        for (int i = 0; i < 3; ++i) {
            const glm::dvec2 uv = scale * glm::dvec2(uvs[corners[static_cast<size_t>(i)]]);
            const glm::dvec2 turned(c * uv.x + s * uv.y, c * uv.y - s * uv.x);
            result.uv += weights[i] * turned;
            result.dx += footprint.dx[i] * turned;
            result.dy += footprint.dy[i] * turned;
        }
        result.uv += glm::dvec2(slot.offset);
        return result;
    }
};

SurfaceReader::SurfaceReader(const Scene& scene)
    : scene_(scene),
      ambient_(scene.ambientRadiance && *scene.ambientRadiance != glm::dvec3(0.0)),
      readings_(scene.materials.size()) {
    for (const Instance& instance : scene.instances) {
        const int material = scene.primitives[static_cast<size_t>(instance.primitive)].material;
        Reading& reading = readings_[static_cast<size_t>(material)];
        if (!reading.used) reading = prepare(scene.materials[static_cast<size_t>(material)]);
    }
}

SurfaceReader::Reading SurfaceReader::prepare(const Material& material) {
    Reading reading;
    reading.used = true;
    reading.seenThrough = material.alphaMode == AlphaMode::blend || seesThrough(material);
    if (material.alphaMode != AlphaMode::opaque) reading.alpha = prepare(material.baseColorTexture, true);
    if (material.brdf == "unlit") {
        reading.emission = prepare(material.baseColorTexture, true);
        return reading;
    }
    reading.brdf = &requireBrdf(material.brdf);
    for (size_t p = 0; p < material.textures.size(); ++p)
        reading.parameters.push_back(
            prepare(material.textures[p], reading.brdf->parameters[p].textureIsSrgb));
    reading.normal = prepare(material.normalTexture, false);
    if (ambient_) reading.occlusion = prepare(material.occlusionTexture, false);
    if (material.emission != glm::vec3(0.0f)) reading.emission = prepare(material.emissionTexture, true);
    return reading;
}

SurfaceReader::Slot SurfaceReader::prepare(const TextureSlot& slot, bool srgb) {
    if (!slot) return {};
    const int image = scene_.textures[static_cast<size_t>(slot.texture)].image;
    if (image < 0) return {&slot, nullptr};
    std::unique_ptr<TextureReader>& reader = textures_[{image, srgb}];
    if (!reader) reader = std::make_unique<TextureReader>(scene_.images[static_cast<size_t>(image)], srgb);
    return {&slot, reader.get()};
}

const Material& SurfaceReader::materialOf(const Mesh& mesh) const {
    return scene_.materials[static_cast<size_t>(mesh.primitive().material)];
}

const SurfaceReader::Reading& SurfaceReader::readingOf(const Mesh& mesh) const {
    return readings_[static_cast<size_t>(mesh.primitive().material)];
}

glm::dvec4 SurfaceReader::sample(const Slot& slot, const Place& place) const {
    if (slot.reader == nullptr) return glm::dvec4(1.0);
    const TextureCoordinate at = place.coordinate(*slot.slot);
    return slot.reader->sample(scene_.textures[static_cast<size_t>(slot.slot->texture)].sampler, at.uv, at.dx,
                               at.dy);
}

double SurfaceReader::coverage(const Mesh& mesh, const Hit& hit, const Footprint& footprint) const {
    const Material& material = materialOf(mesh);
    if (material.alphaMode == AlphaMode::opaque) return 1.0;
    const Place place(mesh, hit, footprint);
    const double alpha =
        static_cast<double>(material.alpha) * sample(readingOf(mesh).alpha, place).a * place.color().a;
    if (material.alphaMode == AlphaMode::mask)
        return alpha < static_cast<double>(material.alphaCutoff) ? 0.0 : 1.0;
    return std::clamp(alpha, 0.0, 1.0);
}

void SurfaceReader::readFrame(const Reading& reading, const Material& material, const Place& place,
                              bool front, SurfacePoint& point) const {
    glm::dvec3 n = place.normal();
    const bool needsTangent = reading.normal.slot != nullptr || reading.brdf->traits.usesTangent;
    const glm::dvec4 tangent = needsTangent ? place.tangent() : glm::dvec4(0.0, 0.0, 0.0, 1.0);
    if (reading.normal.slot != nullptr) {
        // MikkTSpace: normal, tangent and bitangent are used as interpolated, not made unit again.
        const double scale = static_cast<double>(material.normalScale);
        const glm::dvec3 texel =
            (glm::dvec3(sample(reading.normal, place)) * 2.0 - 1.0) * glm::dvec3(scale, scale, 1.0);
        const glm::dvec3 t(tangent);
        n = t * texel.x + tangent.w * glm::cross(n, t) * texel.y + n * texel.z;
    }
    // Where normals cancel out: the engine's choice, which G-buffers make of no direction.
    n = glm::dot(n, n) > 0.0 ? glm::normalize(front ? n : -n) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dmat3 frame = reading.brdf->traits.usesTangent ? frameWithTangent(n, tangent) : frameAbout(n);
    point.tangent = frame[0];
    point.bitangent = frame[1];
    point.normal = frame[2];
}

void SurfaceReader::readParameters(const Reading& reading, const Material& material, const Place& place,
                                   SurfacePoint& point) const {
    const Brdf& brdf = *reading.brdf;
    const int colored = place.hasColor() ? brdf.parameterIndex(brdf.baseColorParameter) : -1;
    const bool textured = std::any_of(reading.parameters.begin(), reading.parameters.end(),
                                      [](const Slot& slot) { return slot.slot != nullptr; });
    if (colored < 0 && !textured) {
        point.constantValues = &material.values;
        return;
    }
    point.variedValues = material.values;
    const auto multiply = [&](int parameter, const glm::dvec3& factor) {
        const auto offset = static_cast<size_t>(brdf.valueOffset(parameter));
        for (int c = 0; c < brdf.parameters[static_cast<size_t>(parameter)].components(); ++c)
            point.variedValues[offset + static_cast<size_t>(c)] *= factor[c];
    };
    for (size_t p = 0; p < reading.parameters.size(); ++p) {
        if (reading.parameters[p].slot == nullptr) continue;
        const glm::dvec4 texel = sample(reading.parameters[p], place);
        const bool rgb = brdf.parameters[p].kind == ParameterKind::rgb;
        multiply(static_cast<int>(p),
                 rgb ? glm::dvec3(texel) : glm::dvec3(texel[material.textureChannels[p]]));
    }
    if (colored >= 0) multiply(colored, glm::dvec3(place.color()));
}

SurfacePoint SurfaceReader::read(const Mesh& mesh, const Hit& hit, const Footprint& footprint) const {
    const Material& material = materialOf(mesh);
    const Reading& reading = readingOf(mesh);
    const Place place(mesh, hit, footprint);
    SurfacePoint point;
    point.geometricNormal = mesh.facetNormal(hit.triangle) * (hit.front ? 1.0 : -1.0);
    point.brdf = reading.brdf;
    point.alpha = coverage(mesh, hit, footprint);
    point.alphaMode = material.alphaMode;
    point.seenThrough = reading.seenThrough;
    point.material = mesh.primitive().material;
    point.instance = hit.instance;
    point.triangle = hit.triangle;
    if (reading.brdf == nullptr) {
        // KHR_materials_unlit: the base colour is all there is.
        point.emission = material.metallicRoughness.baseColor * glm::dvec3(sample(reading.emission, place)) *
                         glm::dvec3(place.color());
        point.constantValues = &material.values;
        return point;
    }
    readFrame(reading, material, place, hit.front, point);
    readParameters(reading, material, place, point);
    if (material.emission != glm::vec3(0.0f))
        point.emission = glm::dvec3(material.emission) * glm::dvec3(sample(reading.emission, place));
    if (reading.occlusion.slot != nullptr)
        point.occlusion = 1.0 + static_cast<double>(material.occlusionStrength) *
                                    (sample(reading.occlusion, place).r - 1.0);
    return point;
}

}  // namespace lobe::reference
