/// A glTF file as it stands: parsed, checked, with the bytes of its buffers at hand, not yet interpreted.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/content_hash.hpp"
#include "import/tinygltf.hpp"

namespace lobe {

struct Document {
    std::string file;  ///< as messages name it
    std::filesystem::path folder;
    nlohmann::json json;    ///< agrees with gltfSchema(); extensions are read from here
    tinygltf::Model model;  ///< the same, typed; without buffers, images, cameras and lights
    std::deque<std::vector<std::byte>> storage;
    std::vector<std::span<const std::byte>> buffers;  ///< empty where a buffer names no source of its bytes
    ContentHash hash;
    std::vector<std::string> warnings;
    size_t furtherWarnings = 0;

    /// Keeps the first hundred; allWarnings() says how many there were beyond.
    void warn(const std::string& property, const std::string& message);
    std::vector<std::string> allWarnings() const;

    /// The bytes of a buffer view; throws InputError if its buffer has no source.
    std::span<const std::byte> viewBytes(size_t bufferView) const;

    /// The object of extension NAME on an element of a root array, or null.
    const nlohmann::json* extension(const char* rootArray, size_t index, const char* name) const;
};

/// Extensions that are rendered as published.
const std::vector<std::string>& supportedExtensions();

/// Reads and checks everything that doesn't depend on what the scene shows. Throws InputError.
Document openDocument(const std::filesystem::path& path);

/// `object`'s extension NAME, or null.
const nlohmann::json* findExtension(const nlohmann::json& object, const char* name);

}  // namespace lobe
