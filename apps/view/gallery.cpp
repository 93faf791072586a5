#include "gallery.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/error.hpp"
#include "lobe_paths.hpp"
#include "shots.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;

fs::path galleryFolder() {
    std::error_code failed;
    const char* asked = std::getenv("LOBE_SCENE_DIR");
    if (asked != nullptr && *asked != '\0') return asked;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    const fs::path installed = program.parent_path() / ".." / "share" / "lobe" / "scenes";
    if (!failed && fs::is_directory(installed, failed)) return installed;
    return paths::kSourceScenes;
}

}  // namespace

std::vector<std::string> galleryScenes() {
    std::vector<std::string> scenes;
    try {
        for (const fs::path& file : app::sceneFiles({galleryFolder().string()}))
            scenes.push_back(file.lexically_normal().string());
    } catch (const Error&) {
        return {};
    }
    const auto depth = [](const std::string& file) { return std::count(file.begin(), file.end(), '/'); };
    std::stable_sort(scenes.begin(), scenes.end(),
                     [&](const std::string& a, const std::string& b) { return depth(a) < depth(b); });
    return scenes;
}

std::string galleryName(const std::string& file) {
    std::error_code failed;
    const fs::path below = fs::path(file).lexically_relative(galleryFolder().lexically_normal());
    return below.empty() ? file : (below.parent_path() / below.stem()).string();
}

}  // namespace lobe::view
