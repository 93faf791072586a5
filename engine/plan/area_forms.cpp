#include "plan/area_forms.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

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

double component(const Bitmap& bitmap, size_t index) {
    switch (bitmap.type) {
        case ComponentType::u8:
            return std::to_integer<int>(bitmap.data[index]) / 255.0;
        case ComponentType::u16: {
            uint16_t value;
            std::memcpy(&value, bitmap.data.data() + index * sizeof value, sizeof value);
            return value / 65535.0;
        }
        default: {
            float value;
            std::memcpy(&value, bitmap.data.data() + index * sizeof value, sizeof value);
            return value;
        }
    }
}

/// Least and most of one channel of a texture; filters stay between them.
std::pair<double, double> rangeOf(const Scene& scene, const TextureSlot& slot, int channel) {
    const int image = slot ? scene.textures[static_cast<size_t>(slot.texture)].image : -1;
    if (image < 0) return {1.0, 1.0};
    const Bitmap& bitmap = scene.images[static_cast<size_t>(image)];
    if (bitmap.channels == 0 || bitmap.data.empty()) return {1.0, 1.0};
    const auto channels = static_cast<size_t>(bitmap.channels);
    const size_t stored = channels <= 2 ? 0 : std::min(static_cast<size_t>(channel), channels - 1);
    std::pair<double, double> range{HUGE_VAL, -HUGE_VAL};
    for (size_t i = stored; i < bitmap.data.size() / bitmap.bytesPerComponent(); i += channels) {
        const double value = component(bitmap, i);
        range = {std::min(range.first, value), std::max(range.second, value)};
    }
    return range;
}

std::pair<double, double> widthsOf(const Scene& scene, const Brdf& brdf, const std::vector<Use>& uses) {
    const int parameter = brdf.area->width.empty() ? -1 : brdf.parameterIndex(brdf.area->width);
    if (parameter < 0) return {0.0, 0.0};
    const auto index = static_cast<size_t>(parameter);
    const auto& [least, most] = brdf.area->widths;
    std::pair<double, double> range{HUGE_VAL, -HUGE_VAL};
    for (const Use& use : uses) {
        const Material& material = *use.material;
        const double value = material.values[static_cast<size_t>(brdf.valueOffset(parameter))];
        auto [low, high] = index < material.textures.size()
                               ? rangeOf(scene, material.textures[index], material.textureChannels[index])
                               : std::pair(1.0, 1.0);
        range.first = std::min(range.first, std::clamp(low * value, least, most));
        range.second = std::max(range.second, std::clamp(high * value, least, most));
    }
    return range;
}

AreaForm formOf(const Scene& scene, const Brdf& brdf, const std::vector<Use>& uses) {
    AreaForm form{{&brdf, uses.front().material->values}, "", 0, {}, 0};
    if (!brdf.area) {
        form.refusal = "no fit serves its lobe";
        return form;
    }
    const AreaModel& area = *brdf.area;
    for (const Use& use : uses) {
        if (const auto reason = fit::refusal({&brdf, use.material->values})) form.refusal = *reason;
        if (fit::huesDiffer(brdf, use.material->values)) form.request.colorsVary = true;
    }
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
    form.widths = widthsOf(scene, brdf, uses);
    form.terms = area.terms == 0 ? 0 : form.request.colorsVary ? area.terms : 1;
    return form;
}

}  // namespace

std::map<std::string, AreaForm> areaForms(const Scene& scene) {
    std::map<std::string, std::vector<Use>> uses;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        const Material& material = scene.materials[static_cast<size_t>(primitive.material)];
        if (findBrdf(material.brdf) != nullptr)
            uses[material.brdf].push_back({&material, !primitive.colors.empty()});
    }
    std::map<std::string, AreaForm> forms;
    auto row = static_cast<int>(tableRows(scene.materials));
    for (const auto& [model, of] : uses) {
        AreaForm form = formOf(scene, requireBrdf(model), of);
        form.firstRow = row;
        if (form.refusal.empty()) row += fit::tableTexels(form.request);
        forms.emplace(model, std::move(form));
    }
    return forms;
}

}  // namespace lobe
