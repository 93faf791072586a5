#include "settings.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "image/tone.hpp"

namespace lobe::app {

using nlohmann::json;

Settings::Settings() {
    for (const Setting& setting : settingTable())
        values_[setting.key].value = setting.defaultValue.is_null() ? json() : parseSetting(setting, setting.defaultValue, "built-in");
}

void Settings::set(const std::string& givenKey, const json& givenValue, const std::string& origin) {
    bool forced = givenKey.starts_with("!");
    const Setting& setting = requireSetting(forced ? givenKey.substr(1) : givenKey, origin);
    json value = givenValue;
    if (value.is_string() && value.get<std::string>().starts_with("!")) {
        forced = true;
        value = value.get<std::string>().substr(1);
    }
    json canonical = parseSetting(setting, value, origin);
    Value& slot = values_[setting.key];
    if (slot.forced && !forced) return;
    slot = {std::move(canonical), origin, forced};
}

void Settings::setAll(const json& object, const std::string& origin) {
    if (!object.is_object()) throw UsageError(origin + ": " + std::string(object.type_name()) + "; expected an object of settings");
    for (const auto& [key, value] : object.items())
        set(key, value, origin);
}

void Settings::reset(const std::string& key, const std::string& origin) {
    const Setting& setting = requireSetting(key, origin);
    values_[setting.key] = {setting.defaultValue.is_null() ? json() : parseSetting(setting, setting.defaultValue, origin), origin, false};
}

const json& Settings::get(const std::string& key) const { return values_.at(key).value; }

json Settings::toJson() const {
    json result = json::object();
    for (const auto& [key, value] : values_)
        if (!value.value.is_null()) result[key] = value.value;
    return result;
}

std::string Settings::chain() const {
    std::string text;
    for (const Setting& setting : settingTable()) {
        const Value& value = values_.at(setting.key);
        if (value.value.is_null()) continue;
        text += setting.key + " = " + value.value.dump() + " (" + value.origin + (value.forced ? ", must win" : "") + ")\n";
    }
    return text;
}

Quality qualityOf(const Settings& settings) {
    Quality quality = qualityPreset(settings.get("quality").get<std::string>());
    const auto text = [&](const char* key) {
        const json& value = settings.get(key);
        return value.is_null() ? std::string() : value.get<std::string>();
    };
    if (const std::string value = text("anti_aliasing"); !value.empty())
        quality.samples = value == "ssaa4" ? 4 : value == "ssaa16" ? 16 : 1;
    if (const std::string value = text("gbuffer_bits"); !value.empty()) quality.gbufferBits = std::stoi(value);
    if (const std::string value = text("texture_bits"); !value.empty()) quality.textureBits = std::stoi(value);
    if (const std::string value = text("shading"); !value.empty())
        quality.shading = value == "forward" ? Shading::forward : Shading::deferred;
    if (const json& value = settings.get("cluster_from"); !value.is_null()) quality.clusterFrom = value.get<int>();
    return quality;
}

NormalsMode normalsOf(const Settings& settings) {
    const std::string value = settings.get("normals").get<std::string>();
    return value == "smooth" ? NormalsMode::smooth : value == "flat" ? NormalsMode::flat : NormalsMode::asFile;
}

LoadOptions loadOptionsOf(const Settings& settings) {
    LoadOptions options;
    options.time = settings.get("time").get<double>();
    options.normals = normalsOf(settings);
    return options;
}

AovSet aovsOf(const Settings& settings) {
    AovSet aovs;
    for (const json& name : settings.get("aov")) {
        const auto& names = aovNames();
        aovs.insert(static_cast<Aov>(std::find(names.begin(), names.end(), name.get<std::string>()) - names.begin()));
    }
    return aovs;
}

ToneMapping toneMappingOf(const Settings& settings) {
    const auto& names = toneMappingNames();
    return static_cast<ToneMapping>(std::find(names.begin(), names.end(), settings.get("tone_mapping").get<std::string>()) -
                                    names.begin());
}

Background backgroundOf(const Settings& settings) {
    Background background;
    const json& value = settings.get("background");
    if (value.is_string()) {
        background.transparent = true;
        return background;
    }
    for (size_t c = 0; c < 3; ++c)
        background.color[c] = decodeSrgb(value[c].get<float>());
    return background;
}

}  // namespace lobe::app
