// What is put into a scene before it is planned: another model for all materials, light where there is none.
#include <algorithm>
#include <numbers>

#include "plan/summary.hpp"
#include "scene/brdf_tables.hpp"

namespace lobe {
namespace {

double componentValue(const Bitmap& bitmap, size_t index) {
    switch (bitmap.type) {
        case ComponentType::u8:
            return std::to_integer<int>(bitmap.data[index]) / 255.0;
        case ComponentType::u16:
            return reinterpret_cast<const uint16_t*>(bitmap.data.data())[index] / 65535.0;
        case ComponentType::f32:
            return static_cast<double>(reinterpret_cast<const float*>(bitmap.data.data())[index]);
    }
    return 0.0;
}

/// Mean of one channel of a texture; 1 where there is none (the value that multiplies to nothing).
double meanOfChannel(const Scene& scene, const TextureSlot& slot, int channel) {
    if (!slot) return 1.0;
    const int image = scene.textures[static_cast<size_t>(slot.texture)].image;
    if (image < 0) return 1.0;
    const Bitmap& bitmap = scene.images[static_cast<size_t>(image)];
    if (bitmap.channels == 0 || bitmap.data.empty()) return 1.0;
    // Grey images stand for equal red, green and blue.
    const int stored = bitmap.channels <= 2 ? 0 : std::min(channel, bitmap.channels - 1);
    const size_t pixels = static_cast<size_t>(bitmap.width) * static_cast<size_t>(bitmap.height);
    double sum = 0.0;
    for (size_t i = 0; i < pixels; ++i)
        sum += componentValue(bitmap, i * static_cast<size_t>(bitmap.channels) + static_cast<size_t>(stored));
    return sum / static_cast<double>(pixels);
}

bool takesLight(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        return scene.materials[static_cast<size_t>(primitive.material)].brdf != kUnlit;
    });
}

}  // namespace

Scene withBrdf(const Scene& scene, const Brdf& brdf) {
    Scene result = scene;
    const int baseColor = brdf.parameterIndex(brdf.baseColorParameter);
    for (Material& material : result.materials) {
        if (material.brdf == kUnlit || material.brdf == brdf.name) continue;
        MetallicRoughness description = material.metallicRoughness;
        TextureSlot baseColorTexture = material.baseColorTexture;
        if (material.brdf != "metallic_roughness") {
            // A named model's own colour says more than the glTF material that it replaces.
            const Brdf& old = requireBrdf(material.brdf);
            const int color = old.parameterIndex(old.baseColorParameter);
            if (color >= 0) {  // a model from a file need not have one
                const auto offset = static_cast<size_t>(old.valueOffset(color));
                description.baseColor = {material.values[offset], material.values[offset + 1],
                                         material.values[offset + 2]};
                baseColorTexture = material.textures[static_cast<size_t>(color)];
            }
        }
        description.roughness *= meanOfChannel(scene, material.metallicRoughnessTexture, 1);
        description.metallic *= meanOfChannel(scene, material.metallicRoughnessTexture, 2);
        material.brdf = brdf.name;
        material.values = brdf.fromMetallicRoughness(description);
        material.textures.assign(brdf.parameters.size(), TextureSlot{});
        material.textureChannels.assign(brdf.parameters.size(), 0);
        if (baseColor >= 0) material.textures[static_cast<size_t>(baseColor)] = baseColorTexture;
        if (brdf.name == "metallic_roughness") {
            // Its own textures are kept: the factors, not the means.
            MetallicRoughness factors = material.metallicRoughness;
            factors.baseColor = description.baseColor;
            material.values = brdf.fromMetallicRoughness(factors);
            const int roughness = brdf.parameterIndex("roughness");
            const int metallic = brdf.parameterIndex("metallic");
            for (int p : {roughness, metallic}) {
                material.textures[static_cast<size_t>(p)] = material.metallicRoughnessTexture;
                material.textureChannels[static_cast<size_t>(p)] = p == roughness ? 1 : 2;
            }
        }
    }
    placeTables(result.materials);
    return result;
}

Scene withoutShadows(const Scene& scene) {
    Scene result = scene;
    for (Light& light : result.lights)
        light.castsShadow = false;
    if (result.environment) result.environment->castsShadow = false;
    return result;
}

bool addDefaultLight(Scene& scene, const Camera& camera) {
    if (!scene.lights.empty() || scene.ambientRadiance || scene.environment || !takesLight(scene))
        return false;
    const glm::dmat3 worldFromCamera(camera.worldFromCamera);
    Light key;
    key.name = "default key";
    key.type = LightType::directional;
    // From over the left shoulder: 40 degrees to the left of the line of sight, 35 above it.
    key.direction = glm::normalize(worldFromCamera * glm::dvec3(0.527, -0.574, -0.627));
    key.intensity = glm::dvec3(std::numbers::pi);  // a facing white Lambert surface shows radiance 1
    scene.lights.push_back(key);
    scene.ambientRadiance = glm::dvec3(0.15);
    return true;
}

}  // namespace lobe
