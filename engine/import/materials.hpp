/// glTF materials as Lobe's.
#pragma once

#include <vector>

#include "import/document.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// All materials of the file, checked. TextureSlot::texture is still an index into the glTF file's textures.
std::vector<Material> readMaterials(Document& document);

/// What a primitive without a material is made of (glTF specification, 3.7.2.1).
Material defaultMaterial();

/// A textureInfo object. A texture coordinate set that is not supported leaves the slot empty, with a
/// warning.
TextureSlot readTextureSlot(const nlohmann::json& info, const std::string& property, Document& document);

/// LOBE_materials_brdf: sets brdf, values, textures and textureChannels. Throws InputError.
void readNamedBrdf(const nlohmann::json& extension, const std::string& property, Document& document,
                   Material& material);

/// All texture slots of a material that are in use.
std::vector<TextureSlot*> textureSlots(Material& material);

}  // namespace lobe
