#include "edits.hpp"

#include <algorithm>

#include "plan/summary.hpp"
#include "scene/brdf_tables.hpp"
#include "shot_scene.hpp"

namespace lobe::view {

bool fitsModel(const Material& material) {
    const Brdf* brdf = findBrdf(material.brdf);
    return brdf == nullptr || (material.values.size() >= static_cast<size_t>(brdf->valueCount()) &&
                               material.textures.size() == brdf->parameters.size());
}

void applyEdits(Scene& scene, const Edits& edits) {
    const auto inScene = [&](const TextureSlot& slot) {
        return !slot || static_cast<size_t>(slot.texture) < scene.textures.size();
    };
    const auto known = [&](const Material& m) {
        return std::all_of(m.textures.begin(), m.textures.end(), inScene) && inScene(m.baseColorTexture) &&
               inScene(m.metallicRoughnessTexture) && inScene(m.normalTexture) &&
               inScene(m.occlusionTexture) && inScene(m.emissionTexture);
    };
    for (const auto& [index, material] : edits.materials)
        if (index >= 0 && static_cast<size_t>(index) < scene.materials.size() && fitsModel(*material) &&
            known(*material))
            scene.materials[static_cast<size_t>(index)] = *material;
    if (!edits.materials.empty()) placeTables(scene.materials);
    if (edits.lights) scene.lights = *edits.lights;
}

std::shared_ptr<Scene> composedScene(const std::shared_ptr<const Scene>& base, const app::Settings& settings,
                                     const Edits& edits) {
    const std::shared_ptr<const Scene> prepared = app::preparedScene(base, settings);
    // What was changed is a copy already, made as one that may change and known to nobody else.
    std::shared_ptr<Scene> scene =
        prepared == base ? std::make_shared<Scene>(*base) : std::const_pointer_cast<Scene>(prepared);
    applyEdits(*scene, edits);
    return scene;
}

Material withModel(const Scene& scene, const Material& material, const Brdf& brdf) {
    if (material.brdf == brdf.name) return material;
    Scene only;  // what withBrdf() reads
    only.materials = {material};
    only.textures = scene.textures;
    only.images = scene.images;
    if (material.brdf == kUnlit) only.materials[0].brdf = "metallic_roughness";
    if (only.materials[0].brdf != material.brdf) {
        const Brdf& plain = requireBrdf("metallic_roughness");
        only.materials[0].values = plain.fromMetallicRoughness(material.metallicRoughness);
        only.materials[0].textures.assign(plain.parameters.size(), {});
        only.materials[0].textureChannels.assign(plain.parameters.size(), 0);
    }
    return withBrdf(only, brdf).materials[0];
}

}  // namespace lobe::view
