/// Small glTF files, made in memory for one test.
#pragma once

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "import/import.hpp"

namespace lobe::test {

using nlohmann::json;

constexpr int kInt8 = 5120, kUint8 = 5121, kInt16 = 5122, kUint16 = 5123, kUint32 = 5125, kFloat32 = 5126;

/// A folder that is removed with everything in it.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "lobe-import-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("no temporary folder");
        }
        path_ = name;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary)
            .write(content.data(), static_cast<std::streamsize>(content.size()));
        return file;
    }

private:
    std::filesystem::path path_;
};

inline std::string base64(std::string_view bytes) {
    static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t three = 0;
        for (size_t k = 0; k < 3; ++k) {
            three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63U];
        }
    }
    return text;
}

/// A glTF document with one buffer that grows as data is added. `doc` may be changed at will before writing.
class Gltf {
public:
    json doc = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    template<typename T>
    int view(const std::vector<T>& values) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return push("bufferViews", std::move(view));
    }

    template<typename T>
    int accessor(const std::vector<T>& values, const std::string& type, int componentType,
                 bool normalized = false) {
        const size_t width = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type[3] - '0');
        json accessor = {{"bufferView", view(values)},
                         {"componentType", componentType},
                         {"count", values.size() / width},
                         {"type", type}};
        if (normalized) {
            accessor["normalized"] = true;
        }
        return push("accessors", std::move(accessor));
    }

    int floats(const std::vector<float>& values, const std::string& type) {
        return accessor(values, type, kFloat32);
    }

    int push(const std::string& array, json element) {
        doc[array].push_back(std::move(element));
        return static_cast<int>(doc[array].size()) - 1;
    }

    /// A node with a mesh of this one primitive, in the scene.
    void show(const json& primitive) {
        const int mesh = push("meshes", {{"primitives", json::array({primitive})}});
        showNode({{"mesh", mesh}});
    }

    int showNode(json node) {
        const int index = push("nodes", std::move(node));
        if (!doc.contains("scenes")) {
            doc["scenes"] = json::array({json::object()});
        }
        doc["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    /// The document as one text, its buffer in a data URI.
    std::string text() const {
        json whole = doc;
        if (!bytes.empty() && !whole.contains("buffers")) {
            whole["buffers"] =
                json::array({{{"byteLength", bytes.size()},
                              {"uri", "data:application/octet-stream;base64," + base64(bytes)}}});
        }
        return whole.dump();
    }

    std::string glb() const {
        json whole = doc;
        whole["buffers"] = json::array({{{"byteLength", bytes.size()}}});
        std::string jsonChunk = whole.dump();
        jsonChunk.resize((jsonChunk.size() + 3) / 4 * 4, ' ');
        std::string binChunk = bytes;
        binChunk.resize((binChunk.size() + 3) / 4 * 4, '\0');
        std::string file =
            "glTF" + word(2) + word(static_cast<uint32_t>(28 + jsonChunk.size() + binChunk.size()));
        file += word(static_cast<uint32_t>(jsonChunk.size())) + "JSON" + jsonChunk;
        file += word(static_cast<uint32_t>(binChunk.size())) + std::string("BIN\0", 4) + binChunk;
        return file;
    }

    Imported import(const LoadOptions& options = {}) const {
        const TemporaryFolder folder;
        return importGltf(folder.write("scene.gltf", text()), options);
    }

    /// What importing this is refused with, without the path: "accessors[0].count: ..."; empty if it is not.
    std::string refusal(const LoadOptions& options = {}) const { return refusalOf(text(), options); }

    static std::string refusalOf(const std::string& content, const LoadOptions& options = {}) {
        const TemporaryFolder folder;
        const std::filesystem::path file = folder.write("scene.gltf", content);
        try {
            (void)importGltf(file, options);
        } catch (const InputError& error) {
            const std::string message = error.what();
            const std::string prefix = file.string() + ": ";
            return message.starts_with(prefix) ? message.substr(prefix.size())
                                               : "without the file's name: " + message;
        }
        return "";
    }

    static std::string word(uint32_t value) {
        std::string text(4, '\0');
        std::memcpy(text.data(), &value, 4);
        return text;
    }
};

inline const std::vector<float> kTrianglePositions{0, 0, 0, 1, 0, 0, 0, 1, 0};
inline const std::vector<float> kTriangleNormals{0, 0, 1, 0, 0, 1, 0, 0, 1};
inline const std::vector<float> kTriangleUvs{0, 1, 1, 1, 0, 0};

/// One triangle with normals, texture coordinates and indices; material 0 if `material` is an object.
inline Gltf triangle(const json& material = nullptr) {
    Gltf gltf;
    json primitive = {{"attributes",
                       {{"POSITION", gltf.floats(kTrianglePositions, "VEC3")},
                        {"NORMAL", gltf.floats(kTriangleNormals, "VEC3")},
                        {"TEXCOORD_0", gltf.floats(kTriangleUvs, "VEC2")}}},
                      {"indices", gltf.accessor(std::vector<uint16_t>{0, 1, 2}, "SCALAR", kUint16)}};
    if (material.is_object()) {
        primitive["material"] = gltf.push("materials", material);
    }
    gltf.show(primitive);
    return gltf;
}

/// Adds a texture (of a picture that only a decoder would look into) and returns its index.
inline int addTexture(Gltf& gltf, const json& sampler = nullptr) {
    const int image = gltf.push("images", {{"uri", "data:image/png;base64," + base64("not decoded here")}});
    json texture = {{"source", image}};
    if (sampler.is_object()) {
        texture["sampler"] = gltf.push("samplers", sampler);
    }
    return gltf.push("textures", texture);
}

}  // namespace lobe::test
