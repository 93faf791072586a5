#include "record.hpp"

#include "base/error.hpp"
#include "lobe_paths.hpp"
#include "model_files.hpp"
#include "shot_scene.hpp"

namespace lobe::app {
using nlohmann::json;

json cameraRecord(const Camera& camera) {
    json matrix = json::array();
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            matrix.push_back(camera.worldFromCamera[column][row]);
    json result = {{"name", camera.name}, {"world_from_camera", matrix}, {"near", camera.zNear}};
    if (camera.zFar) result["far"] = *camera.zFar;
    if (camera.aspect) result["aspect"] = *camera.aspect;
    if (camera.orthographic)
        result["half_extent"] = {camera.xMag, camera.yMag};
    else
        result["vertical_fov"] = camera.verticalFov;
    return result;
}

json recordOf(const Shot& shot, const Scene& scene, const Camera& camera, const gl::ContextInfo& context) {
    json settings = shot.settings->toJson();
    // Where a picture lies does not change it, nor does how its context was asked for: which one it became
    // does.
    for (const char* key : {"output", "backend", "device"})
        settings.erase(key);
    if (settings.contains("brdf_file"))
        for (json& file : settings["brdf_file"])
            file = std::filesystem::absolute(file.get<std::string>()).lexically_normal().string();
    if (settings.contains("env"))
        settings["env"] =
            std::filesystem::absolute(settings["env"].get<std::string>()).lexically_normal().string();
    json record = {{"schema", 1},
                   {"lobe", paths::kVersion},
                   {"scene", std::filesystem::absolute(shot.scene).lexically_normal().string()},
                   {"scene_hash", scene.contentHash},
                   {"camera", cameraRecord(camera)},
                   {"frame", shot.frame},
                   {"settings", settings},
                   {"knobs", knobsOf(qualityOf(*shot.settings))},
                   {"backend", context.backend},
                   {"renderer", context.renderer},
                   {"driver", context.version}};
    if (json models = modelHashesOf(*shot.settings); !models.empty())
        record["brdf_hashes"] = std::move(models);
    return record;
}

std::map<std::string, std::string> metadataOf(const json& record) {
    return {{kRecordKey, record.dump(-1, ' ', false, json::error_handler_t::replace)},
            {"Software", std::string("lobe ") + paths::kVersion}};
}

json recordIn(const std::map<std::string, std::string>& metadata, const std::string& file) {
    const auto found = metadata.find(kRecordKey);
    if (found == metadata.end())
        throw InputError(file + ": has no record of how it was made; expected a picture that lobe rendered");
    json record = json::parse(found->second, nullptr, false);
    const auto has = [&](const char* key, bool (json::*isType)() const noexcept) {
        return record.contains(key) && (record[key].*isType)();
    };
    const bool good = record.is_object() && record.contains("schema") && record["schema"] == 1 &&
                      has("scene", &json::is_string) && has("settings", &json::is_object) &&
                      has("frame", &json::is_number_unsigned);
    if (!good) throw InputError(file + ": its record is damaged or of another version; expected schema 1");
    return record;
}

Shot shotOf(const json& record, const std::string& file, const SettingSources& sources) {
    // The picture's settings stand where a batch's would: configuration files do not change them.
    json recorded = record["settings"];
    for (const Assignment& assignment : sources.assignments)
        if (assignment.key == "brdf_file") recorded.erase("brdf_file");  // the files may have moved
    const std::vector<SettingLayer> own = {{recorded, file}};
    const std::string scene = record["scene"].get<std::string>();
    Settings settings;
    try {
        settings = SettingSources{{}, {}}.resolve(scene, own);
    } catch (const UsageError& error) {
        throw InputError(std::string(error.what()) + " (in the picture's record)");
    }
    settings = SettingSources{{}, sources.assignments}.resolve(scene, own);
    const auto frame = record["frame"].get<uint64_t>();
    const auto frames = settings.get("frames").get<uint64_t>();
    if (frame >= frames)
        throw InputError(file + ": record: frame " + std::to_string(frame) + "; expected less than " +
                         std::to_string(frames) + " (setting frames)");
    return {scene, std::make_shared<const Settings>(std::move(settings)), 1, static_cast<int>(frame), {}};
}

std::vector<std::string> differences(const json& then, const json& now) {
    constexpr std::pair<const char*, const char*> kFields[] = {
        {"scene_hash", "content of the scene"},
        {"brdf_hashes", "content of the files of models"},
        {"lobe", "version of lobe"},
        {"backend", "backend"},
        {"renderer", "renderer"},
        {"driver", "driver"}};
    std::vector<std::string> lines;
    for (const auto& [key, name] : kFields) {
        const json before = then.value(key, json("unknown"));
        const json after = now.value(key, json("unknown"));
        if (before != after)
            lines.push_back(std::string(name) + " is not that of the picture to reproduce: " + after.dump() +
                            ", was " + before.dump());
    }
    return lines;
}

}  // namespace lobe::app
