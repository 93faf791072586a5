#include "import/materials.hpp"

#include <algorithm>
#include <map>

#include "import/refuse.hpp"

namespace lobe {

using nlohmann::json;

namespace {

constexpr const char* kMetallicRoughness = "metallic_roughness";
constexpr const char* kThinTransmission = "thin_transmission";
constexpr const char* kUnlit = "unlit";
constexpr uint8_t kRoughnessChannel = 1;  // glTF packs roughness into green, metallic into blue
constexpr uint8_t kMetallicChannel = 2;

glm::dvec3 rgb(const std::vector<double>& values) {
    return {values[0], values[1], values[2]};
}

TextureSlot slotIn(const json& object, const char* name, const std::string& property, Document& document) {
    const auto found = object.find(name);
    return found == object.end() ? TextureSlot{} : readTextureSlot(*found, property + "." + name, document);
}

void setMetallicRoughness(Material& material, const char* model = kMetallicRoughness) {
    const Brdf& brdf = requireBrdf(model);
    material.brdf = brdf.name;
    material.values = brdf.fromMetallicRoughness(material.metallicRoughness);
    material.textures.assign(brdf.parameters.size(), {});
    material.textureChannels.assign(brdf.parameters.size(), 0);
    const auto index = [&](const char* parameter) {
        return static_cast<size_t>(brdf.parameterIndex(parameter));
    };
    material.textures[index("baseColor")] = material.baseColorTexture;
    material.textures[index("metallic")] = material.metallicRoughnessTexture;
    material.textureChannels[index("metallic")] = kMetallicChannel;
    material.textures[index("roughness")] = material.metallicRoughnessTexture;
    material.textureChannels[index("roughness")] = kRoughnessChannel;
}

/// KHR_materials_transmission: what is behind shows through the surface, as through a thin pane.
void setTransmission(const json& extension, const std::string& property, Document& document,
                     Material& material) {
    const double factor = extension.value("transmissionFactor", 0.0);
    if (factor == 0.0) {
        return setMetallicRoughness(material);
    }
    setMetallicRoughness(material, kThinTransmission);
    const auto index = static_cast<size_t>(requireBrdf(kThinTransmission).parameterIndex("transmission"));
    material
        .values[static_cast<size_t>(requireBrdf(kThinTransmission).valueOffset(static_cast<int>(index)))] =
        factor;
    material.textures[index] = slotIn(extension, "transmissionTexture", property, document);
    if (material.metallicRoughness.roughness > 0.0) {
        document.warn(property, "what shows through the surface is not blurred by its roughness");
    }
}

/// An unlit surface shows its base colour alone (KHR_materials_unlit); all else would be read for nothing.
void setUnlit(Material& material) {
    material.brdf = kUnlit;
    material.values.clear();
    material.textures.clear();
    material.textureChannels.clear();
    material.metallicRoughnessTexture = {};
    material.normalTexture = {};
    material.occlusionTexture = {};
    material.emissionTexture = {};
    material.emission = glm::vec3(0.0f);
}

void readEmission(const tinygltf::Material& source, const json& object, Material& material) {
    double strength = 1.0;
    if (const json* extension = findExtension(object, "KHR_materials_emissive_strength")) {
        strength = extension->value("emissiveStrength", 1.0);
    }
    material.emission = glm::vec3(rgb(source.emissiveFactor) * strength);
    if (material.emission == glm::vec3(0.0f)) {
        material.emissionTexture = {};  // multiplied by nothing
    }
}

void readAlpha(const tinygltf::Material& source, Material& material) {
    material.alpha = static_cast<float>(source.pbrMetallicRoughness.baseColorFactor[3]);
    material.alphaMode = source.alphaMode == "MASK"    ? AlphaMode::mask
                         : source.alphaMode == "BLEND" ? AlphaMode::blend
                                                       : AlphaMode::opaque;
    material.alphaCutoff = static_cast<float>(source.alphaCutoff);
    material.doubleSided = source.doubleSided;
}

Material readMaterial(Document& document, size_t index) {
    const tinygltf::Material& source = document.model.materials[index];
    const json& object = document.json["materials"][index];
    const std::string property = at("materials", index);
    Material material;
    material.name = source.name.empty() ? property : source.name;
    const tinygltf::PbrMetallicRoughness& surface = source.pbrMetallicRoughness;
    material.metallicRoughness = {rgb(surface.baseColorFactor), surface.metallicFactor,
                                  surface.roughnessFactor};
    if (const auto found = object.find("pbrMetallicRoughness"); found != object.end()) {
        const std::string inner = property + ".pbrMetallicRoughness";
        material.baseColorTexture = slotIn(*found, "baseColorTexture", inner, document);
        material.metallicRoughnessTexture = slotIn(*found, "metallicRoughnessTexture", inner, document);
    }
    material.normalTexture = slotIn(object, "normalTexture", property, document);
    material.normalScale = static_cast<float>(source.normalTexture.scale);
    material.occlusionTexture = slotIn(object, "occlusionTexture", property, document);
    material.occlusionStrength = static_cast<float>(source.occlusionTexture.strength);
    material.emissionTexture = slotIn(object, "emissiveTexture", property, document);
    readAlpha(source, material);
    readEmission(source, object, material);
    if (const json* brdf = findExtension(object, "LOBE_materials_brdf")) {
        readNamedBrdf(*brdf, property + ".extensions.LOBE_materials_brdf", document, material);
    } else if (findExtension(object, "KHR_materials_unlit") != nullptr) {
        setUnlit(material);
    } else if (const json* transmission = findExtension(object, "KHR_materials_transmission")) {
        setTransmission(*transmission, property + ".extensions.KHR_materials_transmission", document,
                        material);
    } else {
        setMetallicRoughness(material);
    }
    return material;
}

/// One warning an extension of materials that is not rendered.
void warnOfUnsupported(Document& document) {
    std::map<std::string, int> materialsWith;
    for (const json& material : document.json.value("materials", json::array())) {
        const auto extensions = material.find("extensions");
        if (extensions != material.end()) {
            for (const auto& [name, value] : extensions->items()) {
                ++materialsWith[name];
            }
        }
    }
    for (const std::string& name : supportedExtensions()) {
        materialsWith.erase(name);
    }
    for (const auto& [name, count] : materialsWith) {
        document.warn("materials", name + " of " + std::to_string(count) +
                                       (count == 1 ? " material" : " materials") +
                                       " is not supported and left out");
    }
}

}  // namespace

TextureSlot readTextureSlot(const json& info, const std::string& property, Document& document) {
    TextureSlot slot;
    slot.texture = info["index"].get<int>();
    slot.uvSet = info.value("texCoord", 0);
    if (const json* transform = findExtension(info, "KHR_texture_transform")) {
        const auto pair = [&](const char* name, glm::vec2 otherwise) {
            const auto found = transform->find(name);
            return found == transform->end() ? otherwise
                                             : glm::vec2((*found)[0].get<float>(), (*found)[1].get<float>());
        };
        slot.offset = pair("offset", glm::vec2(0.0f));
        slot.scale = pair("scale", glm::vec2(1.0f));
        slot.rotation = transform->value("rotation", 0.0f);
        slot.uvSet = transform->value("texCoord", slot.uvSet);
    }
    if (slot.uvSet > 1) {
        document.warn(property, "uses TEXCOORD_" + std::to_string(slot.uvSet) +
                                    ", of which only 0 and 1 are supported; left out");
        return {};
    }
    return slot;
}

std::vector<Material> readMaterials(Document& document) {
    std::vector<Material> materials;
    for (size_t i = 0; i < document.model.materials.size(); ++i) {
        materials.push_back(readMaterial(document, i));
    }
    warnOfUnsupported(document);
    return materials;
}

Material defaultMaterial() {
    Material material;
    material.name = "default";
    setMetallicRoughness(material);
    return material;
}

std::vector<TextureSlot*> textureSlots(Material& material) {
    std::vector<TextureSlot*> slots{&material.baseColorTexture, &material.metallicRoughnessTexture,
                                    &material.normalTexture, &material.occlusionTexture,
                                    &material.emissionTexture};
    for (TextureSlot& slot : material.textures) {
        slots.push_back(&slot);
    }
    std::erase_if(slots, [](const TextureSlot* slot) { return !*slot; });
    return slots;
}

}  // namespace lobe
