#include "shots.hpp"

#include <algorithm>
#include <charconv>

#include "base/error.hpp"
#include "output_name.hpp"
#include "standard_input.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scenesBelow(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code failed;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
        const std::string extension = lowerExtension(entry->path());
        std::error_code unknown;
        if ((extension == ".gltf" || extension == ".glb") && entry->is_regular_file(unknown))
            found.push_back(entry->path());
    }
    if (failed) throw InputError(folder.string() + ": " + failed.message());
    if (found.empty()) throw InputError(folder.string() + ": folder without .gltf or .glb files");
    std::sort(found.begin(), found.end());
    return found;
}

/// The number that `text` is as a whole, or 0.
size_t positive(std::string_view text) {
    size_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && stop == text.data() + text.size() ? value : 0;
}

}  // namespace

Settings SettingSources::resolve(const fs::path& scene, const std::vector<SettingLayer>& batchLayers) const {
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
        if (input == "-") {
            files.push_back(standardInputScene());
            continue;
        }
        if (input.empty()) throw UsageError("scene ''; expected a file or folder");
        // A missing file is a shot that will fail by itself: the others are rendered all the same.
        std::error_code failed;
        if (!fs::is_directory(input, failed)) {
            files.emplace_back(input);
            continue;
        }
        const std::vector<fs::path> below = scenesBelow(input);
        files.insert(files.end(), below.begin(), below.end());
    }
    return files;
}

void addFrames(std::vector<Shot>& shots, const fs::path& scene, Settings settings) {
    const auto shared = std::make_shared<const Settings>(std::move(settings));
    const int frames = shared->get("frames").get<int>();
    for (int frame = 0; frame < frames; ++frame)
        shots.push_back({scene, shared, static_cast<int>(shots.size()) + 1, frame, {}});
}

std::vector<Shot> shotsOf(const std::vector<fs::path>& scenes, const SettingSources& sources) {
    std::vector<Shot> shots;
    for (const fs::path& scene : scenes)
        addFrames(shots, scene, sources.resolve(scene));
    return shots;
}

std::vector<Shot> shard(const std::vector<Shot>& shots, const std::string& text) {
    const size_t slash = std::min(text.find('/'), text.size());
    const size_t index = positive(std::string_view(text).substr(0, slash));
    const size_t count = slash < text.size() ? positive(std::string_view(text).substr(slash + 1)) : 0;
    if (index < 1 || count < 1 || index > count)
        throw UsageError("shard '" + text + "'; expected I/N with I from 1 to N");
    std::vector<Shot> mine;
    for (size_t i = index - 1; i < shots.size(); i += count)
        mine.push_back(shots[i]);
    return mine;
}

}  // namespace lobe::app
