#include "plan/area_forms.hpp"

#include <algorithm>

#include "scene/brdf_tables.hpp"

namespace lobe {
namespace {

struct Use {
    const Material* material;
    bool vertexColors;
};

/// Whether a texture, vertex colours or the materials among themselves vary a parameter.
bool varies(const Brdf& brdf, size_t index, const std::vector<Use>& uses) {
    const Parameter& parameter = brdf.parameters[index];
    const auto offset = static_cast<size_t>(brdf.valueOffset(static_cast<int>(index)));
    const auto components = static_cast<size_t>(parameter.components());
    return std::any_of(uses.begin(), uses.end(), [&](const Use& use) {
        if (use.vertexColors && parameter.name == brdf.baseColorParameter) return true;
        const Material& material = *use.material;
        if (index < material.textures.size() && material.textures[index]) return true;
        const ParameterValues &here = material.values, &first = uses.front().material->values;
        return !std::equal(here.begin() + static_cast<std::ptrdiff_t>(offset),
                           here.begin() + static_cast<std::ptrdiff_t>(offset + components),
                           first.begin() + static_cast<std::ptrdiff_t>(offset));
    });
}

AreaForm formOf(const Brdf& brdf, const std::vector<Use>& uses) {
    AreaForm form{{&brdf, uses.front().material->values}, "", 0, 0};
    if (!brdf.area) {
        form.refusal = "no fit serves its lobe";
        return form;
    }
    const AreaModel& area = *brdf.area;
    for (const Use& use : uses)
        if (const auto reason = fit::refusal({&brdf, use.material->values})) form.refusal = *reason;
    for (size_t i = 0; i < brdf.parameters.size(); ++i) {
        if (!varies(brdf, i, uses)) continue;
        const std::string& name = brdf.parameters[i].name;
        if (std::find(area.colors.begin(), area.colors.end(), name) != area.colors.end())
            form.request.colorsVary = true;
        else if (name == area.width)
            form.request.widthVaries = true;
        else
            form.refusal = "its " + name + " varies";
    }
    form.terms = area.terms == 0 ? 0 : form.request.colorsVary ? area.terms : 1;
    return form;
}

}  // namespace

std::map<std::string, AreaForm> areaForms(const Scene& scene) {
    std::map<std::string, std::vector<Use>> uses;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        const Material& material = scene.materials[static_cast<size_t>(primitive.material)];
        if (findBrdf(material.brdf) != nullptr) uses[material.brdf].push_back({&material, !primitive.colors.empty()});
    }
    std::map<std::string, AreaForm> forms;
    auto row = static_cast<int>(tableRows(scene.materials));
    for (const auto& [model, of] : uses) {
        AreaForm form = formOf(requireBrdf(model), of);
        form.firstRow = row;
        if (form.refusal.empty()) row += fit::tableTexels(form.request);
        forms.emplace(model, std::move(form));
    }
    return forms;
}

}  // namespace lobe
