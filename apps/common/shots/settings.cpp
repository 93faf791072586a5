#include "settings.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "image/tone.hpp"
#include "model_files.hpp"
#include "plan/knobs.hpp"

namespace lobe::app {

using nlohmann::json;

namespace {

json builtIn(const Setting& setting) {
    return setting.defaultValue.is_null() ? json() : parseSetting(setting, setting.defaultValue, "built-in");
}

/// Names of files may have bytes that are no UTF-8.
std::string printed(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

Settings::Settings() {
    for (const Setting& setting : settingTable())
        values_[setting.key].winner = {builtIn(setting), "built-in", false};
}

void Settings::put(const std::string& key, Layer layer) {
    Value& slot = values_.at(key);
    if (slot.winner.forced && !layer.forced) {
        slot.others.push_back(std::move(layer));
        return;
    }
    slot.others.push_back(std::exchange(slot.winner, std::move(layer)));
}

void Settings::set(const std::string& givenKey, const json& givenValue, const std::string& origin) {
    bool forced = givenKey.starts_with("!");
    const Setting& setting = requireSetting(forced ? givenKey.substr(1) : givenKey, origin);
    json value = givenValue;
    if (value.is_string() && value.get_ref<const std::string&>().starts_with("!")) {
        forced = true;
        value = value.get_ref<const std::string&>().substr(1);
    }
    put(setting.key, {parseSetting(setting, value, origin), origin, forced});
}

void Settings::setAll(const json& object, const std::string& origin) {
    if (!object.is_object())
        throw UsageError(origin + ": " + std::string(object.type_name()) +
                         "; expected an object of settings");
    const auto isFile = [](const std::string& key) {
        return requireSetting(key.substr(key.starts_with("!") ? 1 : 0), "").key == "brdf_file";
    };
    for (const auto& [key, value] : object.items()) {
        requireSetting(key.substr(key.starts_with("!") ? 1 : 0), origin);
        if (isFile(key)) set(key, value, origin);  // first: others name its model
    }
    for (const auto& [key, value] : object.items())
        if (!isFile(key)) set(key, value, origin);
}

void Settings::reset(const std::string& key, const std::string& origin) {
    const Setting& setting = requireSetting(key, origin);
    values_.at(setting.key).winner.forced = false;
    put(setting.key, {builtIn(setting), "reset by " + origin, false});
}

const json& Settings::get(const std::string& key) const {
    return values_.at(key).winner.value;
}

json Settings::toJson() const {
    json result = json::object();
    for (const auto& [key, value] : values_)
        if (!value.winner.value.is_null()) result[key] = value.winner.value;
    return result;
}

std::string Settings::chain() const {
    const json knobs = knobsOf(qualityOf(*this));
    std::string text;
    for (const Setting& setting : settingTable()) {
        const Value& slot = values_.at(setting.key);
        const bool byPreset = slot.winner.value.is_null() && knobs.contains(setting.key);
        if (slot.winner.value.is_null() && slot.others.empty() && !byPreset) continue;
        text += setting.key + " = ";
        text += byPreset ? printed(knobs[setting.key]) + " (quality)"
                         : printed(slot.winner.value) + " (" + slot.winner.origin + ")";
        if (slot.winner.forced) text += " must win";
        const char* link = " over ";
        for (auto other = slot.others.rbegin(); other != slot.others.rend(); ++other) {
            if (other->value.is_null()) continue;
            text += link + printed(other->value) + " (" + other->origin + ")";
            link = ", ";
        }
        text += '\n';
    }
    return text;
}

Quality qualityOf(const Settings& settings) {
    Quality quality = qualityPreset(settings.get("quality").get<std::string>());
    for (const Knob& knob : knobTable())
        if (const json& value = settings.get(knob.name); !value.is_null())
            knob.set(quality, value.is_string() ? value.get<std::string>() : value.dump());
    return quality;
}

json knobsOf(const Quality& quality) {
    json knobs = json::object();
    for (const Knob& knob : knobTable()) {
        const std::string value = knob.get(quality);
        knobs[knob.name] = knob.range ? json(std::stoi(value)) : json(value);
    }
    return knobs;
}

NormalsMode normalsOf(const Settings& settings) {
    const std::string value = settings.get("normals").get<std::string>();
    return value == "smooth" ? NormalsMode::smooth
           : value == "flat" ? NormalsMode::flat
                             : NormalsMode::asFile;
}

LoadOptions loadOptionsOf(const Settings& settings) {
    LoadOptions options;
    options.time = settings.get("time").get<double>();
    options.normals = normalsOf(settings);
    options.brdfs = modelSourcesOf(settings);
    return options;
}

AovSet aovsOf(const Settings& settings) {
    AovSet aovs;
    for (const json& name : settings.get("aov")) {
        const auto& names = aovNames();
        aovs.insert(
            static_cast<Aov>(std::find(names.begin(), names.end(), name.get<std::string>()) - names.begin()));
    }
    return aovs;
}

ToneMapping toneMappingOf(const Settings& settings) {
    const auto& names = toneMappingNames();
    return static_cast<ToneMapping>(
        std::find(names.begin(), names.end(), settings.get("tone_mapping").get<std::string>()) -
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
