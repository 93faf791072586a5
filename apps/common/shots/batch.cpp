#include "batch.hpp"

#include <algorithm>
#include <map>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "model_files.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class BatchFile {
public:
    explicit BatchFile(const fs::path& file) : file_(file), content_(readJsonFile(file)) {
        require(content_.is_object(), "expected an object with \"shots\"");
        const std::vector<std::string> keys = {"presets", "shots", "schema"};
        for (const auto& [key, value] : content_.items())
            require(std::find(keys.begin(), keys.end(), key) != keys.end(),
                    "unknown key '" + key + "'; expected presets, shots or schema" + didYouMean(key, keys));
        require(content_.value("schema", json(1)) == 1,
                "schema: " + content_.value("schema", json(1)).dump() + "; expected 1");
        require(content_.contains("shots") && content_["shots"].is_array() && !content_["shots"].empty(),
                "shots: expected a list of at least one");
        presets_ = content_.value("presets", json::object());
        require(presets_.is_object(), "presets: expected an object");
        for (auto& [name, preset] : presets_.items())
            loadFiles(preset);
        for (json& shot : content_["shots"])
            loadFiles(shot);
        for (const auto& [name, preset] : presets_.items())
            layers_[name] = layersOf(name);
    }

    std::vector<Shot> shots(const SettingSources& sources) const {
        std::vector<Shot> shots;
        for (size_t i = 0; i < content_["shots"].size(); ++i)
            addShots(shots, content_["shots"][i], "shots[" + std::to_string(i) + "]", sources);
        return shots;
    }

private:
    void require(bool good, const std::string& what) const {
        if (!good) throw UsageError(file_.string() + ": " + what);
    }

    /// Before any setting is read, so that each may name the models; files are relative to the batch file.
    void loadFiles(json& settings) const {
        settings = withFilesIn(file_.parent_path(), std::move(settings));
        if (settings.is_object() && settings.contains("brdf_file"))
            Settings().set("brdf_file", settings["brdf_file"], file_.string());
    }

    std::string presetNames() const {
        std::string names;
        for (const auto& [name, preset] : presets_.items())
            names += (names.empty() ? "" : ", ") + name;
        return names.empty() ? "none is defined" : "expected one of " + names;
    }

    /// A preset's settings, its ancestors' first.
    std::vector<SettingLayer> layersOf(const std::string& name) const {
        std::vector<SettingLayer> layers;
        std::vector<std::string> chain;
        for (std::string current = name; !current.empty();) {
            require(std::find(chain.begin(), chain.end(), current) == chain.end(),
                    "preset '" + current + "' inherits from itself");
            chain.push_back(current);
            json preset = presets_[current];
            require(preset.is_object(), "preset '" + current + "': expected an object of settings");
            const json parent = preset.value("inherits", json(""));
            require(parent.is_string(),
                    "preset '" + current + "': inherits " + parent.dump() + "; expected a name");
            require(
                parent.get<std::string>().empty() || presets_.contains(parent.get<std::string>()),
                "preset '" + current + "': inherits '" + parent.get<std::string>() + "'; " + presetNames());
            preset.erase("inherits");
            const std::string origin = file_.string() + ": preset " + current;
            Settings().setAll(preset, origin);  // a mistake is named even if no shot uses the preset
            layers.insert(layers.begin(), {std::move(preset), origin});
            current = parent.get<std::string>();
        }
        return layers;
    }

    /// A string, or a list of strings.
    std::vector<std::string> namesIn(const json& value, const std::string& where,
                                     const std::string& what) const {
        std::vector<std::string> names;
        for (const json& name : value.is_array() ? value : json::array({value})) {
            require(name.is_string() && !name.get_ref<const std::string&>().empty(),
                    where + ": " + name.dump() + "; expected " + what + " or a list of them");
            names.push_back(name.get<std::string>());
        }
        return names;
    }

    void addShots(std::vector<Shot>& shots, json entry, const std::string& where,
                  const SettingSources& sources) const {
        require(entry.is_object() && entry.contains("scene"),
                where + ": expected an object with a \"scene\"");
        const std::vector<std::string> scenes = namesIn(entry["scene"], where + ".scene", "a path");
        require(!scenes.empty(), where + ".scene: expected at least one");
        std::vector<SettingLayer> layers;
        for (const std::string& preset :
             namesIn(entry.value("preset", json::array()), where + ".preset", "a name")) {
            require(layers_.contains(preset),
                    where + ": preset '" + preset + "' is not defined; " + presetNames());
            const std::vector<SettingLayer>& more = layers_.at(preset);
            layers.insert(layers.end(), more.begin(), more.end());
        }
        entry.erase("scene");
        entry.erase("preset");
        layers.emplace_back(std::move(entry), file_.string() + ": " + where);
        for (const std::string& name : scenes) {
            const fs::path path = file_.parent_path() / name;  // an absolute one stays as it is
            for (const fs::path& scene : filesOf(path))
                addFrames(shots, scene, sources.resolve(scene, layers));
        }
    }

    static std::vector<fs::path> filesOf(const fs::path& path) {
        std::error_code ignored;
        if (!fs::is_directory(path, ignored)) return {path};
        try {
            return sceneFiles({path.string()});
        } catch (const InputError&) {
            return {path};  // without scenes: refused when it is its turn
        }
    }

    fs::path file_;
    json content_;
    json presets_;
    std::map<std::string, std::vector<SettingLayer>> layers_;
};

}  // namespace

std::vector<Shot> shotsOfBatch(const fs::path& file, const SettingSources& sources) {
    return BatchFile(file).shots(sources);
}

}  // namespace lobe::app
