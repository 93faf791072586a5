/// What is written into a picture about how it was made, and read back to make it again.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "scene/scene.hpp"
#include "shots.hpp"

namespace lobe::app {

inline constexpr const char* kRecordKey = "lobe:record";

/// Pose and lens.
nlohmann::json cameraRecord(const Camera& camera);

/// All that decides the pixels: settings, quality knobs that follow from them, camera, frame, scene with
/// content hash, version, driver.
nlohmann::json recordOf(const Shot& shot, const Scene& scene, const Camera& camera,
                        const gl::ContextInfo& context);

/// The record as picture metadata, with the standard "Software" beside it.
std::map<std::string, std::string> metadataOf(const nlohmann::json& record);

/// The record in a picture's metadata. Throws InputError if there is none.
nlohmann::json recordIn(const std::map<std::string, std::string>& metadata, const std::string& file);

/// The shot that a record describes. Throws InputError for settings that this version does not know.
Shot shotOf(const nlohmann::json& record, const std::string& file, const SettingSources& sources);

/// What is not as it was when `then` was made, one line each: scene, version, driver. The pixels may differ.
std::vector<std::string> differences(const nlohmann::json& then, const nlohmann::json& now);

}  // namespace lobe::app
