#include "truth_store.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

#include "base/content_hash.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"
#include "lobe_paths.hpp"
#include "record.hpp"
#include "scene/serialize.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKey = "lobe:truth";

}  // namespace

std::string truthKey(const Scene& scene, const Camera& camera, const reference::TruthRequest& request) {
    ContentHash hash;
    Scene content = scene;  // where it lies and how it is called changes no pixel
    content.name.clear();
    content.file.clear();
    content.warnings.clear();
    hash.add(toBytes(content));
    const nlohmann::json rest = {paths::kVersion,
                                 cameraRecord(camera),
                                 request.width,
                                 request.height,
                                 static_cast<int>(request.options.filter),
                                 request.options.shadows};
    const std::string text = rest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    hash.add(std::as_bytes(std::span(text)));
    return hash.hex();
}

TruthStore::TruthStore() : TruthStore(cacheFolder("truth")) {}

Image TruthStore::find(const std::string& key, ImageFiles& files) const {
    std::error_code ignored;
    if (folder_.empty() || !fs::exists(fileOf(key), ignored)) return {};
    try {
        const auto metadata = files.readMetadata(fileOf(key));
        const auto found = metadata.find(kKey);
        if (found == metadata.end() || found->second != key) return {};
        return files.read(fileOf(key));
    } catch (const InputError&) {
        return {};  // damaged: made again
    }
}

void TruthStore::keep(const std::string& key, const Image& image, ImageFiles& files) {
    if (folder_.empty()) return;
    try {
        fs::create_directories(folder_);
        files.write(fileOf(key), image, {.metadata = {{kKey, key}}, .exrPrecision = ExrPrecision::single});
    } catch (const std::exception& error) {
        if (!warned_) std::cerr << "lobe: warning: the truth is not kept for later: " << error.what() << '\n';
        warned_ = true;
    }
}

}  // namespace lobe::app
