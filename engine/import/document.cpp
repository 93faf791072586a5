#include "import/document.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "import/accessors.hpp"
#include "import/container.hpp"
#include "import/gltf_schema.hpp"
#include "import/refuse.hpp"
#include "import/uri.hpp"

namespace lobe {

using nlohmann::json;

namespace {

void checkVersion(const Document& document) {
    const json& asset = document.json["asset"];
    const std::string version = asset["version"];
    if (!version.starts_with("2.")) {
        refuse(document.file, "asset.version", version, "2.0");
    }
    const std::string least = asset.value("minVersion", "2.0");
    if (least != "2.0") {
        refuse(document.file, "asset.minVersion", least, "2.0");
    }
}

void checkExtensions(Document& document) {
    const auto supported = [](const std::string& name) {
        const std::vector<std::string>& all = supportedExtensions();
        return std::find(all.begin(), all.end(), name) != all.end();
    };
    const json required = document.json.value("extensionsRequired", json::array());
    for (size_t i = 0; i < required.size(); ++i) {
        if (!supported(required[i])) {
            std::string all;
            for (const std::string& name : supportedExtensions()) {
                all += (all.empty() ? "" : ", ") + name;
            }
            refuse(document.file, at("extensionsRequired", i), required[i].get<std::string>(),
                   "none but those that are supported: " + all);
        }
    }
    const json used = document.json.value("extensionsUsed", json::array());
    for (const json& name : used) {
        // What materials use is counted and named with them.
        if (!supported(name) && !name.get_ref<const std::string&>().starts_with("KHR_materials_")) {
            document.warn("extensionsUsed", name.get<std::string>() + " is not supported and left out");
        }
    }
}

void readBuffers(Document& document, const Container& container) {
    const json& buffers = document.json.value("buffers", json::array());
    for (size_t i = 0; i < buffers.size(); ++i) {
        const json& buffer = buffers[i];
        const auto byteLength = buffer["byteLength"].get<uint64_t>();
        std::span<const std::byte> bytes;
        if (buffer.contains("uri")) {
            const std::string property = at("buffers", i, "uri");
            const auto& uri = buffer["uri"].get_ref<const std::string&>();
            if (isDataUri(uri)) {
                document.storage.push_back(decodeDataUri(uri, document.file, property));
            } else {
                const auto path = resolveUri(uri, document.folder, document.file, property);
                document.storage.push_back(readReferencedFile(path, uri, document.file, property));
                document.hash.add(document.storage.back());
            }
            bytes = document.storage.back();
        } else if (i == 0 && container.bin) {
            bytes = *container.bin;
        } else {
            document.buffers.emplace_back();
            continue;
        }
        if (bytes.size() < byteLength) {
            refuse(document.file, at("buffers", i, "byteLength"), std::to_string(byteLength),
                   "at most the " + std::to_string(bytes.size()) + " bytes that there are");
        }
        document.buffers.push_back(bytes.first(byteLength));
    }
}

void checkBufferViews(const Document& document) {
    const json views = document.json.value("bufferViews", json::array());
    for (size_t i = 0; i < views.size(); ++i) {
        const json& view = views[i];
        const auto bufferLength =
            document.json["buffers"][view["buffer"].get<size_t>()]["byteLength"].get<uint64_t>();
        const auto offset = view.value("byteOffset", uint64_t{0});
        const auto length = view["byteLength"].get<uint64_t>();
        if (offset > bufferLength || length > bufferLength - offset) {
            refuse(document.file, at("bufferViews", i),
                   "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length),
                   "bytes inside its buffer, which has " + std::to_string(bufferLength));
        }
        if (view.value("byteStride", uint64_t{4}) % 4 != 0) {
            refuse(document.file, at("bufferViews", i, "byteStride"), shown(view["byteStride"]),
                   "a multiple of 4");
        }
    }
}

/// What tinygltf gets: nothing that is read here anyway (buffers, images, cameras, lights). It refuses
/// indices without a buffer view, which glTF allows (they are all zero): those get a view of their own, taken
/// off again afterwards.
tinygltf::Model typedModel(const Document& document) {
    json text = document.json;
    for (const char* property : {"buffers", "images", "cameras", "extensions"}) {
        text.erase(property);
    }
    const size_t viewCount = document.json.value("bufferViews", json::array()).size();
    text["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
    if (text.contains("accessors")) {
        for (json& accessor : text["accessors"]) {
            if (!accessor.contains("bufferView")) {
                accessor["bufferView"] = viewCount;
            }
        }
    }
    const std::string written = text.dump();
    tinygltf::Model model;
    tinygltf::TinyGLTF reader;
    std::string errors;
    std::string warnings;
    bool loaded = false;
    try {
        loaded = reader.LoadASCIIFromString(&model, &errors, &warnings, written.data(),
                                            static_cast<unsigned>(written.size()), "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        errors = error.what();
    }
    if (!loaded) {
        refuse(document.file, "JSON text", errors, "what tinygltf reads");
    }
    model.bufferViews.pop_back();
    for (tinygltf::Accessor& accessor : model.accessors) {
        accessor.bufferView = accessor.bufferView == static_cast<int>(viewCount) ? -1 : accessor.bufferView;
    }
    return model;
}

}  // namespace

const std::vector<std::string>& supportedExtensions() {
    static const std::vector<std::string> kNames{"EXT_lights_area",
                                                 "EXT_lights_image_based",
                                                 "EXT_texture_webp",
                                                 "KHR_draco_mesh_compression",
                                                 "KHR_lights_punctual",
                                                 "KHR_materials_emissive_strength",
                                                 "KHR_materials_transmission",
                                                 "KHR_materials_unlit",
                                                 "KHR_mesh_quantization",
                                                 "KHR_texture_transform",
                                                 "LOBE_ambient",
                                                 "LOBE_environment",
                                                 "LOBE_fog",
                                                 "LOBE_light_image",
                                                 "LOBE_light_shape",
                                                 "LOBE_materials_brdf",
                                                 "LOBE_shadow",
                                                 "LOBE_visible_light"};
    return kNames;
}

void Document::warn(const std::string& property, const std::string& message) {
    constexpr size_t kMostWarnings = 100;
    if (warnings.size() < kMostWarnings) {
        warnings.push_back(property + ": " + message);
    } else {
        ++furtherWarnings;
    }
}

std::vector<std::string> Document::allWarnings() const {
    std::vector<std::string> all = warnings;
    if (furtherWarnings > 0) {
        all.push_back("and " + std::to_string(furtherWarnings) + " more warnings");
    }
    return all;
}

std::span<const std::byte> Document::viewBytes(size_t bufferView) const {
    const tinygltf::BufferView& view = model.bufferViews[bufferView];
    const auto buffer = static_cast<size_t>(view.buffer);
    if (buffers[buffer].empty()) {
        refuse(file, at("buffers", buffer, "uri"), "missing", "the source of bytes that the scene uses");
    }
    return buffers[buffer].subspan(view.byteOffset, view.byteLength);
}

const json* Document::extension(const char* rootArray, size_t index, const char* name) const {
    return findExtension(json[rootArray][index], name);
}

const json* findExtension(const json& object, const char* name) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end()) {
        return nullptr;
    }
    const auto found = extensions->find(name);
    return found == extensions->end() ? nullptr : &*found;
}

Document openDocument(const std::filesystem::path& path) {
    Document document;
    document.file = path.string();
    document.folder = path.parent_path();
    std::vector<std::byte> bytes;
    const std::string reason = readWholeFile(path, bytes);
    if (!reason.empty()) {
        throw InputError(document.file + ": can't be read (" + reason + "); expected a .gltf or .glb file");
    }
    document.hash.add(bytes);
    document.storage.push_back(std::move(bytes));
    const Container container = openContainer(document.storage.front(), document.file);
    document.json = parseJson(container.json, document.file);
    checkJson(document.json, gltfSchema(), document.file);
    checkVersion(document);
    checkExtensions(document);
    readBuffers(document, container);
    checkBufferViews(document);
    document.model = typedModel(document);
    checkAccessors(document);
    return document;
}

}  // namespace lobe
