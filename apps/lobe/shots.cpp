#include "shots.hpp"

#include <algorithm>
#include <charconv>
#include <map>

#include "base/error.hpp"
#include "image/image_files.hpp"
#include "name_template.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool contains(const std::vector<std::string>& list, const std::string& text) {
    return std::find(list.begin(), list.end(), text) != list.end();
}

void addFrames(std::vector<Shot>& shots, const fs::path& scene, const Settings& settings) {
    const int frames = settings.get("frames").get<int>();
    for (int frame = 0; frame < frames; ++frame)
        shots.push_back({scene, settings, static_cast<int>(shots.size()) + 1, frame, {}});
}

std::string settingText(const Settings& settings, const char* key, const char* absent) {
    const json& value = settings.get(key);
    return value.is_string() ? value.get<std::string>() : absent;
}

void requireKnownFormat(const Shot& shot) {
    const std::string extension = lowerExtension(shot.output);
    const bool linear = contains(ImageFiles::linearExtensions(), extension);
    if (!linear && !contains(ImageFiles::displayExtensions(), extension))
        throw UsageError("output '" + shot.output + "': extension '" + extension + "'; expected .png, .jpg, .exr or .hdr");
    const json& aovs = shot.settings.get("aov");
    if (extension != ".exr" && aovs != json{"radiance"})
        throw UsageError("output '" + shot.output + "': aov " + aovs.dump() + "; expected an .exr file, the only format with layers");
}

}  // namespace

Settings SettingSources::resolve(const std::string& scene, const std::vector<std::pair<json, std::string>>& batchLayers) const {
    Settings settings;
    for (const Config& config : configs)
        config.apply(scene, settings);
    for (const auto& [layer, origin] : batchLayers)
        settings.setAll(layer, origin);
    for (const Assignment& assignment : assignments) {
        if (assignment.kind == Assignment::Kind::reset)
            settings.reset(assignment.key, "command line");
        else
            settings.set(assignment.key, assignment.value, "command line");
    }
    return settings;
}

std::vector<fs::path> sceneFiles(const std::vector<std::string>& inputs) {
    std::vector<fs::path> files;
    for (const std::string& input : inputs) {
        if (input == "-") throw UsageError("scene '-': a scene is read with the files beside it; expected a file or folder");
        std::error_code failed;
        if (!fs::is_directory(input, failed)) {
            if (!fs::exists(input, failed)) throw InputError(input + ": no such file");
            files.emplace_back(input);
            continue;
        }
        std::vector<fs::path> found;
        for (const auto& entry : fs::recursive_directory_iterator(input, fs::directory_options::skip_permission_denied, failed)) {
            const std::string extension = lowerExtension(entry.path());
            if ((extension == ".gltf" || extension == ".glb") && entry.is_regular_file(failed)) found.push_back(entry.path());
        }
        if (found.empty()) throw InputError(input + ": folder without .gltf or .glb files");
        std::sort(found.begin(), found.end());
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

std::vector<Shot> shotsOf(const std::vector<fs::path>& scenes, const SettingSources& sources) {
    std::vector<Shot> shots;
    for (const fs::path& scene : scenes)
        addFrames(shots, scene, sources.resolve(scene.string()));
    return shots;
}

std::vector<Shot> shotsOfBatch(const fs::path& file, const SettingSources& sources) {
    const json batch = readJsonFile(file);
    const std::string origin = file.string();
    const auto require = [&](bool good, const std::string& what) {
        if (!good) throw UsageError(origin + ": " + what);
    };
    require(batch.is_object(), "expected an object with \"shots\"");
    for (const auto& [key, value] : batch.items())
        require(key == "presets" || key == "shots" || key == "schema",
                "unknown key '" + key + "'; expected presets, shots or schema");
    require(batch.contains("shots") && batch["shots"].is_array() && !batch["shots"].empty(), "shots: expected a list of at least one");
    const json presets = batch.value("presets", json::object());
    require(presets.is_object(), "presets: expected an object");

    // A preset's layers, its ancestors' first.
    const auto layersOf = [&](const std::string& name) {
        std::vector<std::pair<json, std::string>> layers;
        std::vector<std::string> chain;
        for (std::string current = name; !current.empty();) {
            require(presets.contains(current), "preset '" + current + "' is not defined");
            require(!contains(chain, current), "preset '" + current + "' inherits from itself");
            chain.push_back(current);
            json preset = presets[current];
            require(preset.is_object(), "preset '" + current + "': expected an object of settings");
            const std::string parent = preset.value("inherits", std::string());
            preset.erase("inherits");
            layers.insert(layers.begin(), {preset, origin + ": preset " + current});
            current = parent;
        }
        return layers;
    };

    std::vector<Shot> shots;
    for (size_t i = 0; i < batch["shots"].size(); ++i) {
        json entry = batch["shots"][i];
        const std::string where = "shots[" + std::to_string(i) + "]";
        require(entry.is_object() && entry.contains("scene"), where + ": expected an object with a \"scene\"");
        std::vector<std::string> names;
        for (const json& scene : entry["scene"].is_array() ? entry["scene"] : json::array({entry["scene"]})) {
            require(scene.is_string(), where + ".scene: " + scene.dump() + "; expected a path or a list of paths");
            const fs::path path(scene.get<std::string>());
            names.push_back((path.is_absolute() ? path : file.parent_path() / path).string());
        }
        std::vector<std::pair<json, std::string>> layers;
        const json chosen = entry.value("preset", json::array());
        for (const json& preset : chosen.is_array() ? chosen : json::array({chosen})) {
            require(preset.is_string(), where + ".preset: " + preset.dump() + "; expected a name or a list of names");
            const auto more = layersOf(preset.get<std::string>());
            layers.insert(layers.end(), more.begin(), more.end());
        }
        entry.erase("scene");
        entry.erase("preset");
        layers.emplace_back(entry, origin + ": " + where);
        // A scene that is missing fails when it is its turn, and not the batch.
        for (const std::string& name : names) {
            std::error_code ignored;
            for (const fs::path& scene : fs::is_directory(name, ignored) ? sceneFiles({name}) : std::vector<fs::path>{name})
                addFrames(shots, scene, sources.resolve(scene.string(), layers));
        }
    }
    return shots;
}

void nameOutputs(std::vector<Shot>& shots) {
    std::map<std::string, const Shot*> taken;
    const std::string date = today();
    for (Shot& shot : shots) {
        const bool turntable = shot.settings.get("frames").get<int>() > 1;
        const std::string given = settingText(shot.settings, "output", turntable ? "out/{model}_{frame:4}.png" : "out/{model}.png");
        if (given == "-" && shots.size() > 1) throw UsageError("output '-': " + std::to_string(shots.size()) + " pictures; expected one");
        shot.output = given == "-" ? given
                                   : expandTemplate(given, {{"model", shot.scene.stem().string()},
                                                            {"camera", settingText(shot.settings, "camera", "default")},
                                                            {"n", std::to_string(shot.number)},
                                                            {"frame", std::to_string(shot.frame)},
                                                            {"date", date},
                                                            {"brdf", settingText(shot.settings, "brdf", "own")},
                                                            {"quality", settingText(shot.settings, "quality", "")}});
        if (given != "-") requireKnownFormat(shot);
        const auto [other, isNew] = taken.emplace(shot.output, &shot);
        if (!isNew)
            throw UsageError("output '" + shot.output + "' is the name of two pictures (" + other->second->scene.string() + " and " +
                             shot.scene.string() + "); add {n:3}" + (turntable ? " or {frame:4}" : "") + " to the name");
    }
}

std::vector<Shot> shard(const std::vector<Shot>& shots, const std::string& text) {
    const size_t slash = text.find('/');
    unsigned long index = 0, count = 0;
    if (slash != std::string::npos) {
        std::from_chars(text.data(), text.data() + slash, index);
        std::from_chars(text.data() + slash + 1, text.data() + text.size(), count);
    }
    if (index < 1 || count < 1 || index > count) throw UsageError("shard '" + text + "'; expected I/N with I from 1 to N");
    std::vector<Shot> mine;
    for (size_t i = index - 1; i < shots.size(); i += count)
        mine.push_back(shots[i]);
    return mine;
}

}  // namespace lobe::app
