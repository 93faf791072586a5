#include "scene_cache.hpp"

#include <algorithm>

#include "shot_scene.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;

constexpr size_t kMostEntries = 64;  // also of failures, which take no memory

template<class Value>
size_t bytesIn(const std::vector<Value>& values) {
    return values.size() * sizeof(Value);
}

}  // namespace

size_t bytesOf(const Scene& scene) {
    size_t bytes = sizeof(Scene) + bytesIn(scene.instances) + bytesIn(scene.materials);
    for (const Bitmap& image : scene.images)
        bytes += image.data.size();
    for (const Primitive& primitive : scene.primitives)
        bytes += bytesIn(primitive.positions) + bytesIn(primitive.normals) + bytesIn(primitive.tangents) +
                 bytesIn(primitive.uvs[0]) + bytesIn(primitive.uvs[1]) + bytesIn(primitive.colors) +
                 bytesIn(primitive.indices);
    return bytes;
}

SceneCache::Entry* SceneCache::find(const json& key) {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
    if (found == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found);
    return &entries_.front();
}

void SceneCache::keep(Entry entry) {
    entries_.push_front(std::move(entry));
    size_t bytes = 0;
    for (const Entry& kept : entries_)
        bytes += kept.bytes;
    while (entries_.size() > 1 && (bytes > budget_ || entries_.size() > kMostEntries)) {
        bytes -= entries_.back().bytes;
        entries_.pop_back();
    }
}

std::shared_ptr<const Scene> SceneCache::loaded(const Shot& shot, const json& key) {
    if (const Entry* entry = find(key)) {
        if (entry->failure) throw InputError(*entry->failure);
        return entry->scene;
    }
    try {
        auto scene = std::make_shared<const Scene>(loader_.load(shot.scene, loadOptionsOf(*shot.settings)));
        keep({key, scene, {}, bytesOf(*scene)});
        return scene;
    } catch (const InputError& failure) {
        keep({key, nullptr, failure, 0});
        throw;
    }
}

std::shared_ptr<const Scene> SceneCache::get(const Shot& shot) {
    const LoadOptions options = loadOptionsOf(*shot.settings);
    const json fileKey = {std::filesystem::absolute(shot.scene).string(), options.time,
                          static_cast<int>(options.normals), shot.settings->get("brdf_file")};
    std::shared_ptr<const Scene> base = loaded(shot, fileKey);
    const json changes = changesOf(*base, *shot.settings);
    if (changes.empty()) return base;
    const json key = {fileKey, base->contentHash, changes};
    if (const Entry* entry = find(key)) return entry->scene;
    std::shared_ptr<const Scene> prepared = preparedScene(base, *shot.settings);
    keep({key, prepared, {}, bytesOf(*prepared)});
    return prepared;
}

}  // namespace lobe::app
