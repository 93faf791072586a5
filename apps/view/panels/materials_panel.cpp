#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/tone.hpp"
#include "panels.hpp"
#include "plan/summary.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

void put(Viewer& viewer, int index, Material material, const std::string& tag) {
    Edits edits = viewer.document.edits();
    edits.materials[index] = std::make_shared<const Material>(std::move(material));
    viewer.document.edit(std::move(edits), tag);
}

/// The edited one, which may not have been drawn yet, or the drawn one.
const Material& present(const Viewer& viewer, int index) {
    const auto found = viewer.document.edits().materials.find(index);
    return found != viewer.document.edits().materials.end()
               ? *found->second
               : viewer.drawn()->materials[static_cast<size_t>(index)];
}

std::string titleOf(const Material& material, int index) {
    return std::to_string(index) + "  " + (material.name.empty() ? "(no name)" : material.name);
}

void drawParameterTooltip(const Parameter& parameter) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetTooltip("%s\n%g to %g%s%s%s", parameter.description.c_str(), parameter.minimum,
                      parameter.maximum, parameter.unit == "1" ? "" : " ",
                      parameter.unit == "1" ? "" : parameter.unit.c_str(),
                      "\nright click: default; Ctrl+click: type a value");
}

/// One parameter's control. True if it changed `values`.
bool drawParameter(const Parameter& parameter, double* values) {
    const auto [low, high] = parameter.usual.value_or(std::pair(parameter.minimum, parameter.maximum));
    const std::string label = parameter.name + (parameter.unit == "1" ? "" : " [" + parameter.unit + "]");
    if (parameter.kind == ParameterKind::choice) {
        const auto at = static_cast<size_t>(values[0]);
        bool changed = false;
        if (ImGui::BeginCombo(label.c_str(), parameter.choices[at].c_str())) {
            for (size_t i = 0; i < parameter.choices.size(); ++i)
                if (ImGui::Selectable(parameter.choices[i].c_str(), i == at)) {
                    values[0] = static_cast<double>(i);
                    changed = true;
                }
            ImGui::EndCombo();
        }
        return changed;
    }
    // What spans many powers of ten is turned in ratios.
    const bool wide = low > 0.0 && high / low > 100.0;
    const char* format = high < 1e-2 ? "%.3e" : "%.4g";
    if (parameter.kind == ParameterKind::scalar)
        return ImGui::SliderScalar(label.c_str(), ImGuiDataType_Double, values, &low, &high, format,
                                   wide ? ImGuiSliderFlags_Logarithmic : 0);
    if (parameter.maximum <= 1.0 && parameter.minimum >= 0.0) {
        float rgb[3] = {static_cast<float>(values[0]), static_cast<float>(values[1]),
                        static_cast<float>(values[2])};
        if (!ImGui::ColorEdit3(label.c_str(), rgb, ImGuiColorEditFlags_Float)) return false;
        for (size_t c = 0; c < 3; ++c)
            values[c] = double{rgb[c]};
        return true;
    }
    return ImGui::SliderScalarN(label.c_str(), ImGuiDataType_Double, values, 3, &low, &high, format,
                                wide ? ImGuiSliderFlags_Logarithmic : 0);
}

/// Whether the interface that the material has reads the parameter.
bool isRead(const Brdf& brdf, const Material& material, const Parameter& parameter) {
    if (parameter.group != "fresnel" || parameter.name == "fresnel") return true;
    const int index = brdf.parameterIndex("fresnel");
    if (index < 0) return true;
    const auto type = static_cast<shading::FresnelType>(
        static_cast<int>(material.values[static_cast<size_t>(brdf.valueOffset(index))]));
    if (parameter.name == "f0") return type == shading::FresnelType::schlick;
    if (parameter.name == "k") return type == shading::FresnelType::conductor;
    if (parameter.name == "eta")
        return type == shading::FresnelType::dielectric || type == shading::FresnelType::conductor;
    return true;
}

/// A picture of at most 128 texels a side: every nth texel.
Bitmap smaller(const Bitmap& bitmap) {
    const int step = std::max(1, (std::max(bitmap.width, bitmap.height) + 127) / 128);
    Bitmap result{
        (bitmap.width + step - 1) / step, (bitmap.height + step - 1) / step, 3, ComponentType::u8, {}};
    const auto size = bitmap.bytesPerComponent();
    for (int y = 0; y < bitmap.height; y += step)
        for (int x = 0; x < bitmap.width; x += step)
            for (int c = 0; c < 3; ++c) {
                const int channel = bitmap.channels >= 3 ? c : 0;
                const size_t at =
                    (static_cast<size_t>(y) * static_cast<size_t>(bitmap.width) + static_cast<size_t>(x)) *
                        static_cast<size_t>(bitmap.channels) +
                    static_cast<size_t>(channel);
                // Of 16 bits the high byte (little-endian); of floats the part from 0 to 1.
                std::byte code = bitmap.data[at * size + (size == 2 ? 1 : 0)];
                if (size == 4) {
                    float value = 0.0F;
                    std::memcpy(&value, bitmap.data.data() + at * size, sizeof value);
                    code = static_cast<std::byte>(encodeSrgb8(value));
                }
                result.data.push_back(code);
            }
    return result;
}

void drawTexture(Viewer& viewer, const std::string& of, const TextureSlot& slot) {
    if (!slot || !viewer.document.scene()) return;
    const Scene& scene = *viewer.document.scene();
    if (static_cast<size_t>(slot.texture) >= scene.textures.size()) return;
    const int image = scene.textures[static_cast<size_t>(slot.texture)].image;
    if (image < 0) return;
    const Bitmap& bitmap = scene.images[static_cast<size_t>(image)];
    WindowTexture& texture = viewer.textures[image];
    if (!texture && !bitmap.data.empty()) texture.set(smaller(bitmap), true);
    if (!texture) return;
    const float side = 2.5F * ImGui::GetTextLineHeight();
    ImGui::Image(texture.id(), {side, side});
    if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::Image(texture.id(), {8.0F * side, 8.0F * side * static_cast<float>(texture.height()) /
                                                     static_cast<float>(texture.width())});
        ImGui::EndTooltip();
    }
    ImGui::SameLine();
    ImGui::TextDisabled("%s times %s\n%dx%d texels", of.c_str(),
                        static_cast<size_t>(image) < scene.imageNames.size()
                            ? scene.imageNames[static_cast<size_t>(image)].c_str()
                            : "an image",
                        bitmap.width, bitmap.height);
}

void drawParameters(Viewer& viewer, int index, const Brdf& brdf) {
    Material material = present(viewer, index);
    ImGui::PushItemWidth(-0.42F * ImGui::GetContentRegionAvail().x);
    for (size_t i = 0; i < brdf.parameters.size(); ++i) {
        const Parameter& parameter = brdf.parameters[i];
        const auto at = static_cast<size_t>(brdf.valueOffset(static_cast<int>(i)));
        if (parameter.kind == ParameterKind::table) {
            ImGui::Text("%s: %zu rows of the table", parameter.name.c_str(),
                        brdf.tableOf(material.values).size() / 4);
            continue;
        }
        ImGui::PushID(static_cast<int>(i));
        const bool read = isRead(brdf, material, parameter);
        ImGui::BeginDisabled(!read);
        bool changed = drawParameter(parameter, material.values.data() + at);
        viewer.mark("parameter " + parameter.name);
        ImGui::EndDisabled();
        if (!read && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
            ImGui::SetTooltip("without effect: the type of the interface does not read it");
        else
            drawParameterTooltip(parameter);
        if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
            for (int c = 0; c < parameter.components(); ++c)
                material.values[at + static_cast<size_t>(c)] = parameter.defaultValue[c];
            changed = true;
        }
        drawTexture(viewer, parameter.name, material.textures[i]);
        if (changed) {
            for (int c = 0; c < parameter.components(); ++c) {
                double& value = material.values[at + static_cast<size_t>(c)];
                value = std::clamp(value, parameter.minimum, parameter.maximum);
            }
            viewer.attempt([&] {
                validateParameters(brdf, material.values, material.name);
                put(viewer, index, material, "material " + parameter.name);
            });
        }
        ImGui::PopID();
    }
    ImGui::PopItemWidth();
}

void drawPresets(Viewer& viewer, int index, const Brdf& brdf) {
    Material material = present(viewer, index);
    if (!brdf.presets.empty() && ImGui::BeginCombo("published surface", "choose...")) {
        for (const BrdfPreset& preset : brdf.presets) {
            if (ImGui::Selectable(preset.name.c_str())) {
                material.values = preset.values;
                std::fill(material.textures.begin(), material.textures.end(), TextureSlot{});
                put(viewer, index, material, "");
            }
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", preset.source.c_str());
        }
        ImGui::EndCombo();
    }
    const int fresnel = brdf.parameterIndex("fresnel");
    if (fresnel < 0 || brdf.parameterIndex("eta") < 0 || !ImGui::BeginCombo("metal", "choose...")) return;
    for (const shading::Metal& metal : shading::metals())
        if (ImGui::Selectable(metal.name.c_str())) {
            shading::setMetal(brdf, material.values, metal);
            for (const char* name : {"eta", "k"})
                material.textures[static_cast<size_t>(brdf.parameterIndex(name))] = {};
            put(viewer, index, material, "");
        }
    ImGui::EndCombo();
}

void drawModelChoice(Viewer& viewer, int index) {
    const Material& material = present(viewer, index);
    if (!ImGui::BeginCombo("model", material.brdf.c_str())) {
        viewer.mark("model");
        return;
    }
    for (const std::string& name : brdfNames())
        if (ImGui::Selectable(name.c_str(), name == material.brdf))
            viewer.attempt([&] {
                put(viewer, index, withModel(*viewer.document.scene(), material, requireBrdf(name)), "");
            });
    ImGui::EndCombo();
}

void drawGeneral(Viewer& viewer, int index) {
    Material material = present(viewer, index);
    if (!ImGui::CollapsingHeader("Surface")) return;
    bool changed = false;
    float emission[3] = {material.emission.r, material.emission.g, material.emission.b};
    changed |= ImGui::DragFloat3("emission [W/m\xC2\xB2/sr]", emission, 0.01F, 0.0F, 1e6F, "%.3g");
    if (material.normalTexture)
        changed |= ImGui::SliderFloat("normal scale", &material.normalScale, 0.0F, 4.0F, "%.3g");
    if (material.alphaMode == AlphaMode::mask)
        changed |= ImGui::SliderFloat("alpha cutoff", &material.alphaCutoff, 0.0F, 1.0F, "%.3g");
    if (material.alphaMode == AlphaMode::blend)
        changed |= ImGui::SliderFloat("alpha", &material.alpha, 0.0F, 1.0F, "%.3g");
    drawTexture(viewer, "normals", material.normalTexture);
    drawTexture(viewer, "emission", material.emissionTexture);
    drawTexture(viewer, "occlusion", material.occlusionTexture);
    changed |= ImGui::Checkbox("both sides", &material.doubleSided);
    if (!changed) return;
    material.emission = {std::max(0.0F, emission[0]), std::max(0.0F, emission[1]),
                         std::max(0.0F, emission[2])};
    put(viewer, index, material, "surface");
}

}  // namespace

void drawMaterialsPanel(Viewer& viewer) {
    const DrawnScene* drawn = viewer.drawn();
    if (drawn == nullptr || drawn->materials.empty()) return ImGui::TextDisabled("no picture yet");
    int& index = viewer.ui.material;
    const auto count = static_cast<int>(drawn->materials.size());
    if (index >= count) index = -1;
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::BeginCombo("##material", index < 0 ? "click a surface, or choose here"
                                                  : titleOf(present(viewer, index), index).c_str())) {
        for (int i = 0; i < count; ++i)
            if (ImGui::Selectable(titleOf(present(viewer, i), i).c_str(), i == index)) index = i;
        ImGui::EndCombo();
    }
    viewer.mark("material");
    if (index < 0) return;
    ImGui::BeginChild("material");
    ImGui::PushItemWidth(-0.42F * ImGui::GetContentRegionAvail().x);
    drawModelChoice(viewer, index);
    const Brdf* brdf = findBrdf(present(viewer, index).brdf);
    if (brdf != nullptr) {
        ImGui::TextWrapped("%s. %s", brdf->title.c_str(), brdf->source.c_str());
        drawPresets(viewer, index, *brdf);
    }
    ImGui::PopItemWidth();
    ImGui::Separator();
    if (brdf != nullptr) {
        drawParameters(viewer, index, *brdf);
        drawPolarPlot(viewer, *brdf, present(viewer, index));
    } else {
        ImGui::TextWrapped("Unlit: emission is all there is. A model makes it take light.");
    }
    drawGeneral(viewer, index);
    if (viewer.document.edits().materials.contains(index) && ImGui::Button("As in the file")) {
        Edits edits = viewer.document.edits();
        edits.materials.erase(index);
        viewer.document.edit(std::move(edits));
    }
    ImGui::EndChild();
}

}  // namespace lobe::view
