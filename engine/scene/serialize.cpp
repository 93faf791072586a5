#include "scene/serialize.hpp"

#include <cereal/cereal.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <cstring>
#include <type_traits>

#include "base/error.hpp"

namespace lobe::scene_archive {

/// Archives over memory: cereal's own go through streams, which costs a copy and a call a value.
class MemoryOutput : public cereal::OutputArchive<MemoryOutput, cereal::AllowEmptyClassElision> {
public:
    explicit MemoryOutput(std::vector<std::byte>& bytes)
        : cereal::OutputArchive<MemoryOutput, cereal::AllowEmptyClassElision>(this), bytes_(bytes) {}

    void raw(const void* data, size_t size) {
        const auto* from = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), from, from + size);
    }

private:
    std::vector<std::byte>& bytes_;
};

class MemoryInput : public cereal::InputArchive<MemoryInput, cereal::AllowEmptyClassElision> {
public:
    explicit MemoryInput(std::span<const std::byte> bytes)
        : cereal::InputArchive<MemoryInput, cereal::AllowEmptyClassElision>(this), bytes_(bytes) {}

    void raw(void* data, size_t size) {
        require(size);
        if (size > 0) {
            std::memcpy(data, bytes_.data(), size);
        }
        bytes_ = bytes_.subspan(size);
    }

    /// Throws unless that many bytes are left: asked before memory is taken for them.
    void require(size_t size) const {
        if (size > bytes_.size()) {
            throw InputError("a scene in memory: cut off; expected " + std::to_string(size) + " more bytes");
        }
    }

    bool atEnd() const { return bytes_.empty(); }

private:
    std::span<const std::byte> bytes_;
};

template<typename T>
std::enable_if_t<std::is_arithmetic_v<T>> save(MemoryOutput& archive, const T& value) {
    archive.raw(&value, sizeof value);
}

template<typename T>
std::enable_if_t<std::is_arithmetic_v<T>> load(MemoryInput& archive, T& value) {
    archive.raw(&value, sizeof value);
}

template<typename T>
void save(MemoryOutput& archive, const cereal::SizeTag<T>& tag) {
    archive(static_cast<uint64_t>(tag.size));
}

template<typename T>
void load(MemoryInput& archive, cereal::SizeTag<T>& tag) {
    uint64_t size = 0;
    archive(size);
    archive.require(size);  // no element takes less than a byte
    tag.size = size;
}

template<typename T>
void save(MemoryOutput& archive, const cereal::BinaryData<T>& data) {
    archive.raw(data.data, data.size);
}

template<typename T>
void load(MemoryInput& archive, cereal::BinaryData<T>& data) {
    archive.raw(data.data, data.size);
}

template<typename T>
void save(MemoryOutput& archive, const cereal::NameValuePair<T>& pair) {
    archive(pair.value);
}

template<typename T>
void load(MemoryInput& archive, cereal::NameValuePair<T>& pair) {
    archive(pair.value);
}

/// A vector of plain structures as one block.
template<typename T>
void block(MemoryOutput& archive, std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    archive(static_cast<uint64_t>(values.size()));
    archive.raw(values.data(), values.size() * sizeof(T));
}

template<typename T>
void block(MemoryInput& archive, std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    uint64_t count = 0;
    archive(count);
    if (count > SIZE_MAX / sizeof(T)) {
        throw InputError("a scene in memory: no array has " + std::to_string(count) + " elements");
    }
    archive.require(count * sizeof(T));
    values.resize(count);
    archive.raw(values.data(), count * sizeof(T));
}

template<typename Archive, glm::length_t N, typename T>
void serialize(Archive& archive, glm::vec<N, T>& value) {
    for (glm::length_t i = 0; i < N; ++i) {
        archive(value[i]);
    }
}

template<typename Archive>
void serialize(Archive& archive, glm::dmat4& value) {
    archive(value[0], value[1], value[2], value[3]);
}

template<typename Archive>
void serialize(Archive& archive, Bitmap& bitmap) {
    archive(bitmap.width, bitmap.height, bitmap.channels, bitmap.type);
    block(archive, bitmap.data);
}

template<typename Archive>
void serialize(Archive& archive, Sampler& sampler) {
    archive(sampler.wrapS, sampler.wrapT, sampler.magnify, sampler.minify, sampler.mip);
}

template<typename Archive>
void serialize(Archive& archive, Texture& texture) {
    archive(texture.image, texture.sampler);
}

template<typename Archive>
void serialize(Archive& archive, TextureSlot& slot) {
    archive(slot.texture, slot.uvSet, slot.offset, slot.rotation, slot.scale);
}

template<typename Archive>
void serialize(Archive& archive, MetallicRoughness& surface) {
    archive(surface.baseColor, surface.metallic, surface.roughness);
}

template<typename Archive>
void serialize(Archive& archive, Material& material) {
    archive(material.name, material.brdf, material.values, material.textures, material.textureChannels);
    archive(material.metallicRoughness, material.baseColorTexture, material.metallicRoughnessTexture);
    archive(material.alpha, material.alphaMode, material.alphaCutoff, material.doubleSided);
    archive(material.normalTexture, material.normalScale, material.occlusionTexture,
            material.occlusionStrength);
    archive(material.emission, material.emissionTexture, material.fileIndex);
}

template<typename Archive>
void serialize(Archive& archive, Primitive& primitive) {
    archive(primitive.name, primitive.material);
    block(archive, primitive.positions);
    block(archive, primitive.normals);
    block(archive, primitive.tangents);
    for (std::vector<glm::vec2>& uvs : primitive.uvs) {
        block(archive, uvs);
    }
    block(archive, primitive.colors);
    block(archive, primitive.indices);
}

template<typename Archive>
void serialize(Archive& archive, Instance& instance) {
    archive(instance.primitive, instance.worldFromLocal, instance.node, instance.castsShadow);
}

template<typename Archive>
void serialize(Archive& archive, Light& light) {
    archive(light.name, light.type, light.position, light.direction, light.intensity, light.range,
            light.innerConeAngle, light.outerConeAngle, light.axis, light.width, light.height, light.radius,
            light.length, light.castsShadow, light.image);
}

template<typename Archive>
void serialize(Archive& archive, Sky& sky) {
    archive(sky.model, sky.zenith, sky.horizon, sky.ground, sky.turbidity, sky.sunElevation, sky.sunAzimuth,
            sky.sunDiameter);
}

template<typename Archive>
void serialize(Archive& archive, ImageBasedLight& light) {
    archive(light.faces, light.harmonics);
}

template<typename Archive>
void serialize(Archive& archive, EnvironmentSource& source) {
    archive(source.sky, source.imageBased);
}

template<typename Archive>
void serialize(Archive& archive, Environment& environment) {
    archive(environment.image, environment.radiance, environment.intensity);
    archive(environment.worldFromMap[0], environment.worldFromMap[1], environment.worldFromMap[2]);
    archive(environment.background, environment.backgroundImage, environment.castsShadow, environment.sun);
    archive(environment.source, environment.notes);
}

template<typename Archive>
void serialize(Archive& archive, Fog& fog) {
    archive(fog.extinction, fog.radiance, fog.heightFalloff, fog.height, fog.scattering, fog.anisotropy);
}

template<typename Archive>
void serialize(Archive& archive, Camera& camera) {
    archive(camera.name, camera.worldFromCamera, camera.orthographic, camera.verticalFov, camera.aspect,
            camera.xMag, camera.yMag, camera.zNear, camera.zFar);
}

template<typename Archive>
void serialize(Archive& archive, Scene& scene) {
    archive(scene.name, scene.file, scene.contentHash, scene.images, scene.imageNames, scene.textures);
    archive(scene.materials, scene.primitives, scene.instances, scene.lights, scene.cameras);
    archive(scene.ambientRadiance, scene.environment, scene.fog, scene.warnings, scene.animationDurations);
}

}  // namespace lobe::scene_archive

CEREAL_SETUP_ARCHIVE_TRAITS(lobe::scene_archive::MemoryInput, lobe::scene_archive::MemoryOutput)

namespace lobe {

std::vector<std::byte> toBytes(const Scene& scene) {
    // Nearly all of a scene is vertices: room for them at once saves copying as the bytes grow.
    size_t vertexBytes = 0;
    for (const Primitive& p : scene.primitives) {
        vertexBytes += p.positions.size() * sizeof(glm::vec3) + p.normals.size() * sizeof(glm::vec3) +
                       p.tangents.size() * sizeof(glm::vec4) + p.uvs[0].size() * sizeof(glm::vec2) +
                       p.uvs[1].size() * sizeof(glm::vec2) + p.colors.size() * sizeof(glm::vec4) +
                       p.indices.size() * sizeof(uint32_t) + sizeof(Primitive);
    }
    std::vector<std::byte> bytes;
    bytes.reserve(vertexBytes);
    scene_archive::MemoryOutput archive(bytes);
    archive(scene);
    return bytes;
}

Scene sceneFromBytes(std::span<const std::byte> bytes) {
    Scene scene;
    scene_archive::MemoryInput archive(bytes);
    archive(scene);
    if (!archive.atEnd()) {
        throw InputError("a scene in memory: goes on after its end");
    }
    return scene;
}

}  // namespace lobe
