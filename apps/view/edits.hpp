/// What a person has changed of a scene's materials and lights, beside the settings.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "settings.hpp"

namespace lobe::view {

/// Values are shared and never change: a copy of the edits is cheap, and the same edits have the same
/// pointers.
struct Edits {
    std::map<int, std::shared_ptr<const Material>> materials = {};  ///< by index, in place of the scene's
    std::shared_ptr<const std::vector<Light>> lights = {};  ///< in place of all of the scene's; null: those

    bool empty() const { return materials.empty() && lights == nullptr; }
    bool operator==(const Edits&) const = default;
};

/// Changes materials and lights. Materials that the scene does not have are left out.
void applyEdits(Scene& scene, const Edits& edits);

/// Whether its values are as many as its model has now: files of models may have changed since.
bool fitsModel(const Material& material);

/// The scene as it is drawn: as loaded, as the settings change it, as it was edited. A copy of its own.
std::shared_ptr<Scene> composedScene(const std::shared_ptr<const Scene>& base, const app::Settings& settings,
                                     const Edits& edits);

/// A material of the scene with another model: what stands for it in that model, as `--brdf` does for all.
Material withModel(const Scene& scene, const Material& material, const Brdf& brdf);

}  // namespace lobe::view
