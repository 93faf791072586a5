#include "thumbnail_store.hpp"

#include <fstream>
#include <iterator>
#include <span>

#include "base/content_hash.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"
#include "lobe_paths.hpp"

namespace lobe::view {

namespace fs = std::filesystem;

ThumbnailStore::ThumbnailStore() : folder_(cacheFolder("thumbnails")) {}

fs::path ThumbnailStore::fileOf(const fs::path& scene) const {
    std::error_code ignored;
    const auto written = fs::last_write_time(scene, ignored).time_since_epoch().count();
    const std::string identity = fs::absolute(scene, ignored).lexically_normal().string() + "\n" +
                                 std::to_string(written) + "\n" +
                                 std::to_string(fs::file_size(scene, ignored)) + "\n" + paths::kVersion;
    ContentHash hash;
    hash.add(std::as_bytes(std::span(identity)));
    return folder_ / (hash.hex() + ".png");
}

Bitmap ThumbnailStore::find(const fs::path& scene, ImageFiles& files) const {
    if (folder_.empty()) return {};
    std::ifstream stream(fileOf(scene), std::ios::binary);
    if (!stream) return {};
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    try {
        Bitmap bitmap = files.decode(std::as_bytes(std::span(bytes)), "thumbnail");
        return bitmap.type == ComponentType::u8 && bitmap.channels >= 3 ? bitmap : Bitmap{};
    } catch (const InputError&) {
        return {};  // damaged: made again
    }
}

void ThumbnailStore::keep(const fs::path& scene, const Bitmap& bitmap, ImageFiles& files) const {
    if (folder_.empty()) return;
    try {
        fs::create_directories(folder_);
        files.write(fileOf(scene), bitmap, {});
    } catch (const std::exception&) {
        return;  // made again next time
    }
}

}  // namespace lobe::view
