#include "record.hpp"

#include "base/error.hpp"
#include "lobe_paths.hpp"

namespace lobe::app {

using nlohmann::json;

json recordOf(const Shot& shot, const Scene& scene, const gl::ContextInfo& context) {
    json settings = shot.settings.toJson();
    settings.erase("output");  // where a picture lies does not change it
    return {{"schema", 1},
            {"lobe", paths::kVersion},
            {"scene", std::filesystem::absolute(shot.scene).lexically_normal().string()},
            {"scene_hash", scene.contentHash},
            {"frame", shot.frame},
            {"settings", settings},
            {"backend", context.backend},
            {"renderer", context.renderer},
            {"driver", context.version}};
}

std::map<std::string, std::string> metadataOf(const json& record) {
    return {{kRecordKey, record.dump()}, {"Software", std::string("lobe ") + paths::kVersion}};
}

json recordIn(const std::map<std::string, std::string>& metadata, const std::string& file) {
    const auto found = metadata.find(kRecordKey);
    if (found == metadata.end()) throw InputError(file + ": has no record of how it was made; expected a picture that lobe rendered");
    const json record = json::parse(found->second, nullptr, false);
    const bool good = record.is_object() && record.value("schema", 0) == 1 && record.contains("scene") &&
                      record["scene"].is_string() && record.contains("settings") && record.contains("frame") &&
                      record["frame"].is_number_integer();
    if (!good) throw InputError(file + ": its record is damaged or of another version; expected schema 1");
    return record;
}

Shot shotOf(const json& record, const std::string& file, const SettingSources& sources) {
    Shot shot;
    shot.scene = record["scene"].get<std::string>();
    shot.frame = record["frame"].get<int>();
    // The picture's settings stand where a batch's would: configuration files do not change them.
    SettingSources own{{}, sources.assignments};
    shot.settings = own.resolve(shot.scene.string(), {{record["settings"], file}});
    return shot;
}

}  // namespace lobe::app
