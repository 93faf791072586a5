/// The scenes used last, as loaded and as the settings change them.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "scene/load.hpp"
#include "shots.hpp"

namespace lobe::app {

/// Bytes that a scene takes in memory: pictures and vertices, which are nearly all of it.
size_t bytesOf(const Scene& scene);

/// Shots of one scene load it once, as far as memory goes. A scene that cannot be loaded is not tried again
/// and again.
class SceneCache {
public:
    /// Scenes above `budget` bytes together are dropped, those first that were not used for longest; the last
    /// one used stays in any case.
    explicit SceneCache(size_t budget = size_t{2} << 30) : budget_(budget) {}

    /// The scene of a shot, ready to be drawn. The same object for as long as it is kept. Throws InputError
    /// and, for a camera that the scene does not have, UsageError.
    std::shared_ptr<const Scene> get(const Shot& shot);

    size_t size() const { return entries_.size(); }

private:
    struct Entry {
        nlohmann::json key;
        std::shared_ptr<const Scene> scene;
        std::optional<InputError> failure;
        size_t bytes = 0;
    };
    std::shared_ptr<const Scene> loaded(const Shot& shot, const nlohmann::json& key);
    Entry* find(const nlohmann::json& key);
    void keep(Entry entry);

    size_t budget_;
    SceneLoader loader_;
    std::list<Entry> entries_;  ///< used last first
};

}  // namespace lobe::app
