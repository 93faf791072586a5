#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "panels.hpp"
#include "plan/knobs.hpp"
#include "shading/brdf.hpp"
#include "style.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

using app::Setting;
using app::SettingType;
using nlohmann::json;

/// Why a setting changes nothing in what is shown now; empty: it does.
std::string withoutEffect(const Viewer& viewer, const Setting& setting) {
    const std::string& key = setting.key;
    if (key == "backend" || key == "device") return "chosen when the program starts";
    if (key == "frames" || key == "orbit") return "the window shows one picture, not a turntable";
    if (key == "output" || key == "exr_precision" || key == "jpeg_quality")
        return "";  // of pictures that are saved
    const DrawnScene* drawn = viewer.drawn();
    if (drawn == nullptr) return "";
    if (key.starts_with("env_") && setting.group == "Scene" && !drawn->hasEnvironment)
        return "the scene has no environment; env gives it one";
    if (key == "time" && viewer.document.scene()->animationDurations.empty())
        return "the scene has no animation";
    if (key == "camera" && viewer.document.scene()->cameras.empty()) return "the scene has no camera";
    if (key == "camera_focal_point" && viewer.document.settings()->get("camera_position").is_null())
        return "needs camera_position";
    for (const Knob& knob : knobTable())
        if (knob.name == key)
            return knob.withoutEffect(drawn->summary, app::qualityOf(*viewer.document.settings()));
    return "";
}

/// The value in force: of knobs that are not set, the preset's.
json valueOf(const Viewer& viewer, const Setting& setting) {
    const json& value = viewer.document.settings()->get(setting.key);
    if (!value.is_null()) return value;
    const json knobs = app::knobsOf(app::qualityOf(*viewer.document.settings()));
    return knobs.contains(setting.key) ? knobs[setting.key] : json();
}

std::vector<std::string> choicesOf(const Viewer& viewer, const Setting& setting) {
    if (setting.key == "brdf") return brdfNames();
    if (setting.key != "camera") return setting.choices;
    std::vector<std::string> names;
    for (const Camera& camera : viewer.document.scene()->cameras)
        names.push_back(camera.name);
    return names;
}

/// A value that may be absent, among names. Returns the chosen one.
std::optional<json> choose(Viewer& viewer, const json& value, const std::vector<std::string>& names,
                           bool mayBeAbsent) {
    std::optional<json> chosen;
    const std::string shown = value.is_string() ? value.get<std::string>() : "(as it is)";
    if (!ImGui::BeginCombo("##value", shown.c_str())) return chosen;
    if (mayBeAbsent && ImGui::Selectable("(as it is)", value.is_null())) chosen = json();
    for (const std::string& name : names) {
        if (ImGui::Selectable(name.c_str(), value == name)) chosen = name;
        viewer.mark("choice " + name);
    }
    ImGui::EndCombo();
    return chosen;
}

std::optional<json> editText(const json& value) {
    std::string text = value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
    if (ImGui::InputText("##value", &text, ImGuiInputTextFlags_EnterReturnsTrue))
        return text.empty() ? json() : json(text);
    return {};
}

std::optional<json> editNumber(const json& value, const Setting& setting) {
    if (setting.type == SettingType::integer) {
        int number = value.is_number() ? value.get<int>() : static_cast<int>(setting.minimum);
        const auto low = static_cast<int>(setting.minimum), high = static_cast<int>(setting.maximum);
        const bool changed = high - low <= 4096
                                 ? ImGui::SliderInt("##value", &number, low, high, "%d",
                                                    high - low > 128 ? ImGuiSliderFlags_Logarithmic : 0)
                                 : ImGui::DragInt("##value", &number, 1.0F, low, high);
        if (changed) return json(std::clamp(number, low, high));
        return {};
    }
    double number = value.is_number() ? value.get<double>() : 0.0;
    const double speed = setting.unit == "degrees" ? 0.5 : setting.unit == "stops" ? 0.02 : 0.01;
    const std::string format = "%.4g" + (setting.unit.empty() ? std::string() : " " + setting.unit);
    if (ImGui::DragScalar("##value", ImGuiDataType_Double, &number, static_cast<float>(speed),
                          &setting.minimum, &setting.maximum, format.c_str()))
        return json(std::clamp(number, setting.minimum, setting.maximum));
    return {};
}

std::optional<json> editColour(const json& value) {
    bool transparent = value.is_string();
    float rgb[3] = {0.0F, 0.0F, 0.0F};
    if (value.is_array())
        for (size_t c = 0; c < 3; ++c)
            rgb[c] = value[c].get<float>();
    std::optional<json> changed;
    if (!transparent && ImGui::ColorEdit3("##value", rgb))
        changed = json{double{rgb[0]}, double{rgb[1]}, double{rgb[2]}};
    if (ImGui::Checkbox("transparent", &transparent))
        changed = transparent ? json("transparent") : json{0.0, 0.0, 0.0};
    return changed;
}

std::optional<json> editResolution(Viewer& viewer, const json& value) {
    int size[2] = {value[0].get<int>(), value[1].get<int>()};
    bool follows = !viewer.document.sizeIsFixed();
    if (ImGui::Checkbox("as the window", &follows)) {
        if (!follows) return json{size[0], size[1]};
        viewer.document.revert("resolution");
        return {};
    }
    if (follows) ImGui::BeginDisabled();
    const bool changed = ImGui::InputInt2("##value", size, ImGuiInputTextFlags_EnterReturnsTrue);
    if (follows) ImGui::EndDisabled();
    if (changed) return json{size[0], size[1]};
    return {};
}

std::optional<json> editList(const json& value, const Setting& setting) {
    std::set<std::string> names;
    for (const json& name : value)
        names.insert(name.get<std::string>());
    std::optional<json> changed;
    for (const std::string& choice : setting.choices) {
        bool on = names.contains(choice);
        if (!ImGui::Checkbox(choice.c_str(), &on)) continue;
        if (on)
            names.insert(choice);
        else
            names.erase(choice);
        if (!names.empty()) changed = json(std::vector<std::string>(names.begin(), names.end()));
    }
    return changed;
}

std::optional<json> editPairs(const json& value) {
    std::string text;
    for (const auto& [name, part] : value.items())
        text += (text.empty() ? "" : " ") + name + "=" + part.get<std::string>();
    if (!ImGui::InputTextWithHint("##value", "m=0.2 diffuse=0.8,0.2,0.1", &text,
                                  ImGuiInputTextFlags_EnterReturnsTrue))
        return {};
    json pairs = json::array();
    for (size_t start = 0; start < text.size();) {
        const size_t end = std::min(text.find(' ', start), text.size());
        if (end > start) pairs.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return pairs.empty() ? json() : pairs;
}

std::optional<json> editVector(const json& value) {
    double numbers[3] = {0.0, 0.0, 0.0};
    if (value.is_array())
        for (size_t c = 0; c < 3; ++c)
            numbers[c] = value[c].get<double>();
    if (ImGui::InputScalarN("##value", ImGuiDataType_Double, numbers, 3, nullptr, nullptr, "%.4g",
                            ImGuiInputTextFlags_EnterReturnsTrue))
        return json{numbers[0], numbers[1], numbers[2]};
    return {};
}

std::optional<json> edit(Viewer& viewer, const Setting& setting) {
    const json value = valueOf(viewer, setting);
    switch (setting.type) {
        case SettingType::text:
            if (setting.key == "camera" && viewer.document.scene())
                return choose(viewer, value, choicesOf(viewer, setting), true);
            return editText(value);
        case SettingType::integer:
        case SettingType::real:
            return editNumber(value, setting);
        case SettingType::choice:
            return choose(viewer, value, choicesOf(viewer, setting), setting.defaultValue.is_null());
        case SettingType::vector:
            return editVector(value);
        case SettingType::colour:
            return editColour(value);
        case SettingType::resolution:
            return editResolution(viewer, value);
        case SettingType::list:
            return editList(value, setting);
        case SettingType::files:
            return editText(value.is_array() && !value.empty() ? value[0] : json());
        case SettingType::pairs:
            return editPairs(value.is_null() ? json::object() : value);
    }
    return {};
}

void drawTooltip(const Setting& setting, const std::string& reason) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0F);
    ImGui::TextUnformatted((setting.help + ".").c_str());
    ImGui::TextDisabled("%s  %s", setting.flag().c_str(), setting.allowed().c_str());
    if (!setting.defaultText().empty()) ImGui::TextDisabled("default %s", setting.defaultText().c_str());
    if (!reason.empty()) ImGui::TextColored(kChangedColor, "Without effect: %s.", reason.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void drawSetting(Viewer& viewer, const Setting& setting) {
    const std::string reason = withoutEffect(viewer, setting);
    const bool changed = viewer.document.isChanged(setting.key);
    ImGui::PushID(setting.key.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    std::string label = setting.key;
    std::replace(label.begin(), label.end(), '_', ' ');
    ImGui::BeginDisabled(!reason.empty());
    if (changed)
        ImGui::TextColored(kChangedColor, "%s", label.c_str());
    else
        ImGui::TextUnformatted(label.c_str());
    ImGui::EndDisabled();
    drawTooltip(setting, reason);
    if (changed && ImGui::IsItemClicked(ImGuiMouseButton_Right))
        viewer.attempt([&] { viewer.document.revert(setting.key); });
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::BeginDisabled(!reason.empty());
    const std::optional<json> value = edit(viewer, setting);
    viewer.mark("setting " + setting.key);
    ImGui::EndDisabled();
    drawTooltip(setting, reason);
    if (changed && ImGui::IsItemClicked(ImGuiMouseButton_Right))
        viewer.attempt([&] { viewer.document.revert(setting.key); });
    if (value) {
        viewer.attempt([&] {
            if (setting.type == SettingType::files) {
                if (value->is_null())
                    viewer.document.revert(setting.key);
                else
                    viewer.open(value->get<std::string>());
                return;
            }
            if (setting.group == "Camera") {  // the person's own camera gives way
                viewer.camera.forget();
                viewer.document.setPose({});
            }
            viewer.document.change(setting.key, *value, setting.key);
        });
    }
    ImGui::PopID();
}

}  // namespace

void drawSettingsPanel(Viewer& viewer) {
    ImGui::SetNextItemWidth(-90.0F * viewer.window.scale());
    ImGui::InputTextWithHint("##filter", "find a setting", &viewer.ui.settingFilter);
    viewer.mark("setting filter");
    ImGui::SameLine();
    if (ImGui::Button("Reset all")) viewer.document.revertAll();
    viewer.mark("reset all");
    std::vector<std::string> groups;
    for (const Setting& setting : app::settingTable())
        if (std::find(groups.begin(), groups.end(), setting.group) == groups.end())
            groups.push_back(setting.group);
    // What is turned most comes first.
    std::stable_sort(groups.begin(), groups.end(), [](const std::string& a, const std::string& b) {
        const auto rank = [](const std::string& name) {
            return name == "Quality" ? 0 : name == "Display" ? 1 : name == "Scene" ? 2 : 3;
        };
        return rank(a) < rank(b);
    });
    ImGui::BeginChild("settings");
    for (const std::string& group : groups) {
        const bool filtered = !viewer.ui.settingFilter.empty();
        const bool open = ImGui::CollapsingHeader(
            group.c_str(), group == "Device" || group == "Output" ? 0 : ImGuiTreeNodeFlags_DefaultOpen);
        if (!open && !filtered) continue;
        if (!ImGui::BeginTable(group.c_str(), 2, ImGuiTableFlags_SizingStretchProp)) continue;
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.42F);
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.58F);
        for (const Setting& setting : app::settingTable())
            if (setting.group == group &&
                (!filtered || setting.key.find(viewer.ui.settingFilter) != std::string::npos))
                drawSetting(viewer, setting);
        ImGui::EndTable();
    }
    ImGui::EndChild();
}

}  // namespace lobe::view
