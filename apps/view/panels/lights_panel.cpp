#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "panels.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

constexpr double kDegrees = 180.0 / M_PI;

const std::vector<Light>& present(const Viewer& viewer) {
    return viewer.document.edits().lights ? *viewer.document.edits().lights : viewer.drawn()->lights;
}

void put(Viewer& viewer, std::vector<Light> lights, const std::string& tag) {
    Edits edits = viewer.document.edits();
    edits.lights = std::make_shared<const std::vector<Light>>(std::move(lights));
    viewer.document.edit(std::move(edits), tag);
}

/// One that lights the scene visibly: over its left front, as bright on it as a sun of irradiance 3.
Light newLight(const Viewer& viewer, LightType type) {
    const Bounds bounds = viewer.document.scene()->bounds();
    const double size = bounds.radius() > 0.0 ? bounds.radius() : 1.0;
    Light light;
    light.type = type;
    light.name = std::string("new ") + nameOf(type);
    light.position = bounds.center() + glm::normalize(glm::dvec3(-0.6, 1.0, 0.8)) * (1.6 * size);
    light.direction = glm::normalize(bounds.center() - light.position);
    light.axis = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), light.direction));
    light.width = light.height = light.length = 0.5 * size;
    light.radius = type == LightType::tube ? 0.05 * size : 0.25 * size;
    const double far = 1.6 * size;
    constexpr double kIrradiance = 3.0;
    if (type == LightType::directional)
        light.intensity = glm::dvec3(kIrradiance);
    else if (type == LightType::rect)
        light.intensity = glm::dvec3(kIrradiance * far * far / (light.width * light.height));
    else if (type == LightType::disk)
        light.intensity = glm::dvec3(kIrradiance * far * far / (M_PI * light.radius * light.radius));
    else
        light.intensity = glm::dvec3(kIrradiance * far * far);
    light.innerConeAngle = 0.3;
    light.outerConeAngle = 0.5;
    return light;
}

const char* intensityUnit(LightType type) {
    if (type == LightType::directional) return "irradiance [W/m\xC2\xB2]";
    return type == LightType::rect || type == LightType::disk ? "radiance [W/m\xC2\xB2/sr]"
                                                              : "intensity [W/sr]";
}

bool dragNumber(const char* label, double& value, double low, double high, double speed) {
    return ImGui::DragScalar(label, ImGuiDataType_Double, &value, static_cast<float>(speed), &low, &high,
                             "%.4g", ImGuiSliderFlags_AlwaysClamp);
}

/// Colour and a number, of which the three channels are the product.
bool drawIntensity(Light& light) {
    double largest = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
    const glm::dvec3 tint = largest > 0.0 ? light.intensity / largest : glm::dvec3(1.0);
    float rgb[3] = {static_cast<float>(tint.r), static_cast<float>(tint.g), static_cast<float>(tint.b)};
    bool changed = ImGui::ColorEdit3("colour (linear)", rgb, ImGuiColorEditFlags_Float);
    changed |= dragNumber(intensityUnit(light.type), largest, 0.0, 1e9, std::max(0.002 * largest, 1e-4));
    if (changed) light.intensity = glm::dvec3(double{rgb[0]}, double{rgb[1]}, double{rgb[2]}) * largest;
    return changed;
}

/// As azimuth and elevation of where the light comes from.
bool drawDirection(Light& light) {
    const glm::dvec3 from = -light.direction;
    double elevation = std::asin(std::clamp(from.y, -1.0, 1.0)) * kDegrees;
    double azimuth = std::atan2(from.x, from.z) * kDegrees;
    bool changed = dragNumber("from azimuth [\xC2\xB0]", azimuth, -360.0, 360.0, 0.5);
    changed |= dragNumber("from elevation [\xC2\xB0]", elevation, -90.0, 90.0, 0.5);
    if (!changed) return false;
    const double a = azimuth / kDegrees, e = elevation / kDegrees;
    light.direction = -glm::dvec3(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
    return true;
}

/// At right angles to the direction, as close to what it was as can be.
void straighten(Light& light) {
    light.direction = glm::normalize(light.direction);
    glm::dvec3 axis = light.axis - light.direction * glm::dot(light.axis, light.direction);
    if (!(glm::length(axis) > 1e-6))
        axis = glm::cross(std::abs(light.direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0),
                          light.direction);
    light.axis = glm::normalize(axis);
}

bool drawShape(Light& light, double size) {
    bool changed = false;
    const double most = 100.0 * size, least = 1e-4 * size, speed = 0.005 * size;
    if (light.type == LightType::spot) {
        double inner = light.innerConeAngle * kDegrees, outer = light.outerConeAngle * kDegrees;
        changed |= dragNumber("inner cone [\xC2\xB0]", inner, 0.0, 89.9, 0.2);
        changed |= dragNumber("outer cone [\xC2\xB0]", outer, 0.1, 90.0, 0.2);
        light.outerConeAngle = std::max(outer, 0.1) / kDegrees;
        light.innerConeAngle = std::min(inner / kDegrees, light.outerConeAngle);
    }
    if (light.type == LightType::rect) {
        changed |= dragNumber("width [m]", light.width, least, most, speed);
        changed |= dragNumber("height [m]", light.height, least, most, speed);
    }
    if (light.type == LightType::disk || light.type == LightType::sphere || light.type == LightType::tube)
        changed |= dragNumber("radius [m]", light.radius, least, most, speed);
    if (light.type == LightType::tube) changed |= dragNumber("length [m]", light.length, least, most, speed);
    if (light.type == LightType::rect || light.type == LightType::tube) {
        static double turn = 0.0;
        const double before = turn;
        if (dragNumber("turn the axis [\xC2\xB0]", turn, -360.0, 360.0, 0.5)) {
            const double angle = (turn - before) / kDegrees;
            const glm::dvec3 other = glm::cross(light.direction, light.axis);
            light.axis = light.axis * std::cos(angle) + other * std::sin(angle);
            changed = true;
        }
        if (!ImGui::IsItemActive()) turn = 0.0;
    }
    if (light.type == LightType::point || light.type == LightType::spot || light.type == LightType::sphere ||
        light.type == LightType::tube) {
        bool limited = light.range.has_value();
        if (ImGui::Checkbox("range", &limited)) {
            light.range = limited ? std::optional(4.0 * size) : std::nullopt;
            changed = true;
        }
        if (light.range) {
            ImGui::SameLine();
            changed |= dragNumber("##range", *light.range, least, 1000.0 * size, 0.02 * size);
        }
    }
    return changed;
}

void drawLight(Viewer& viewer, size_t index) {
    std::vector<Light> lights = present(viewer);
    Light& light = lights[index];
    const double size = std::max(viewer.document.scene()->bounds().radius(), 1e-6);
    bool changed = ImGui::InputText("name", &light.name);
    changed |= drawIntensity(light);
    viewer.mark("light intensity");
    if (light.type != LightType::directional) {
        double position[3] = {light.position.x, light.position.y, light.position.z};
        if (ImGui::DragScalarN("position [m]", ImGuiDataType_Double, position, 3,
                               static_cast<float>(0.005 * size), nullptr, nullptr, "%.4g")) {
            light.position = {position[0], position[1], position[2]};
            changed = true;
        }
    }
    if (light.type != LightType::point && light.type != LightType::sphere && light.type != LightType::tube)
        changed |= drawDirection(light);
    changed |= drawShape(light, size);
    changed |= ImGui::Checkbox("casts shadows", &light.castsShadow);
    viewer.mark("light shadows");
    ImGui::TextDisabled("The handles in the picture move it along x, y, z and across, and aim it.");
    const bool remove = ImGui::Button("Remove");
    viewer.mark("light remove");
    ImGui::SameLine();
    const bool copy = ImGui::Button("Copy");
    if (remove) {
        lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(index));
        viewer.ui.light = -1;
    } else if (copy) {
        lights.push_back(light);
        viewer.ui.light = static_cast<int>(lights.size()) - 1;
    } else if (changed) {
        straighten(light);
    } else {
        return;
    }
    put(viewer, std::move(lights), remove || copy ? "" : "light");
}

}  // namespace

void drawLightsPanel(Viewer& viewer) {
    const DrawnScene* drawn = viewer.drawn();
    if (drawn == nullptr) return ImGui::TextDisabled("no picture yet");
    const std::vector<Light>& lights = present(viewer);
    if (drawn->hasKeyLight && !viewer.document.edits().lights)
        ImGui::TextWrapped(
            "The scene has no light: a key light over the camera's shoulder and a little ambient "
            "light are Lobe's own.");
    if (ImGui::BeginListBox("##lights", {-1.0F, 7.0F * ImGui::GetTextLineHeightWithSpacing()})) {
        for (size_t i = 0; i < lights.size(); ++i) {
            const std::string label = std::to_string(i) + "  " + lights[i].name + " (" +
                                      nameOf(lights[i].type) + ")##" + std::to_string(i);
            if (ImGui::Selectable(label.c_str(), viewer.ui.light == static_cast<int>(i)))
                viewer.ui.light = static_cast<int>(i);
        }
        ImGui::EndListBox();
    }
    viewer.mark("lights");
    if (ImGui::BeginCombo("##add", "Add a light...")) {
        for (const LightType type : {LightType::directional, LightType::point, LightType::spot,
                                     LightType::rect, LightType::disk, LightType::sphere, LightType::tube}) {
            if (ImGui::Selectable(nameOf(type))) {
                std::vector<Light> more = lights;
                more.push_back(newLight(viewer, type));
                viewer.ui.light = static_cast<int>(more.size()) - 1;
                put(viewer, std::move(more), "");
            }
            viewer.mark(std::string("add ") + nameOf(type));
        }
        ImGui::EndCombo();
    } else {
        viewer.mark("add light");
    }
    if (viewer.document.edits().lights) {
        ImGui::SameLine();
        if (ImGui::Button("As in the file")) {
            Edits edits = viewer.document.edits();
            edits.lights.reset();
            viewer.document.edit(std::move(edits));
            viewer.ui.light = -1;
        }
    }
    ImGui::BeginChild("light");
    ImGui::PushItemWidth(-0.45F * ImGui::GetContentRegionAvail().x);
    if (viewer.ui.light >= 0 && static_cast<size_t>(viewer.ui.light) < present(viewer).size())
        drawLight(viewer, static_cast<size_t>(viewer.ui.light));
    ImGui::PopItemWidth();
    ImGui::EndChild();
}

}  // namespace lobe::view
