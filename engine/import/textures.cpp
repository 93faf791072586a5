#include "import/textures.hpp"

#include "base/error.hpp"
#include "import/refuse.hpp"
#include "import/uri.hpp"

namespace lobe {

namespace {

Wrap wrapOf(int gltfWrap) {
    switch (gltfWrap) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clampToEdge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirroredRepeat;
        default:
            return Wrap::repeat;
    }
}

/// The bytes that a URI stands for; those of a file count for the scene's hash.
std::vector<std::byte> readUri(Document& document, const std::string& uri, const std::string& property) {
    if (isDataUri(uri)) {
        return decodeDataUri(uri, document.file, property);
    }
    std::vector<std::byte> bytes = readReferencedFile(
        resolveUri(uri, document.folder, document.file, property), uri, document.file, property);
    document.hash.add(bytes);
    return bytes;
}

std::vector<std::byte> readImage(Document& document, size_t index) {
    const nlohmann::json& image = document.json["images"][index];
    if (image.contains("uri") == image.contains("bufferView")) {
        refuse(document.file, at("images", index),
               image.contains("uri") ? "both uri and bufferView" : "no source", "either uri or bufferView");
    }
    if (image.contains("bufferView")) {
        const auto view = document.viewBytes(image["bufferView"].get<size_t>());
        return {view.begin(), view.end()};
    }
    return readUri(document, image["uri"], at("images", index, "uri"));
}

}  // namespace

std::string imageName(const Document& document, size_t index) {
    const nlohmann::json& image = document.json["images"][index];
    std::string source;
    if (image.contains("uri") && !isDataUri(image["uri"].get_ref<const std::string&>())) {
        source = image["uri"];
    } else {
        source = image.value("name", "");
    }
    return at("images", index) + (source.empty() ? "" : " (" + shown(source) + ")");
}

int TextureTable::use(int gltfTexture) {
    const auto known = textureIndex_.find(gltfTexture);
    if (known != textureIndex_.end()) {
        return known->second;
    }
    const auto index = static_cast<size_t>(gltfTexture);
    const tinygltf::Texture& source = document_.model.textures[index];
    int image = -1;
    if (const nlohmann::json* webp = document_.extension("textures", index, "EXT_texture_webp")) {
        const int webpImage = (*webp)["source"].get<int>();
        if (source.source >= 0) {
            const int fallback = addImage(source.source, -1);
            try {
                image = addImage(webpImage, fallback);
            } catch (const InputError& error) {
                document_.warn(at("textures", index), std::string("taken from images[") +
                                                          std::to_string(source.source) + "] (" +
                                                          error.what() + ")");
                image = fallback;
            }
        } else {
            image = addImage(webpImage, -1);
        }
    } else if (source.source >= 0) {
        image = addImage(source.source, -1);
    } else {
        document_.warn(at("textures", index), "has no image that is supported; left out");
    }
    int result = -1;
    if (image >= 0) {
        result = static_cast<int>(textures.size());
        textures.push_back({image, sampler(source.sampler)});
    }
    textureIndex_.emplace(gltfTexture, result);
    return result;
}

int TextureTable::addImage(int gltfImage, int fallback) {
    const auto known = imageIndex_.find(gltfImage);
    if (known != imageIndex_.end()) {
        return known->second;
    }
    const auto index = static_cast<size_t>(gltfImage);
    images.push_back({imageName(document_, index), readImage(document_, index), fallback});
    const int result = static_cast<int>(images.size()) - 1;
    imageIndex_.emplace(gltfImage, result);
    return result;
}

int TextureTable::addFile(const std::string& uri, const std::string& property) {
    const std::string name = property + (isDataUri(uri) ? "" : " (" + shown(uri) + ")");
    images.push_back({name, readUri(document_, uri, property), -1});
    return static_cast<int>(images.size()) - 1;
}

int TextureTable::addTexture(int image) {
    Sampler sampler;
    sampler.wrapS = sampler.wrapT = Wrap::clampToEdge;
    textures.push_back({image, sampler});
    return static_cast<int>(textures.size()) - 1;
}

int TextureTable::addOwn(size_t gltfImage) {
    images.push_back({imageName(document_, gltfImage), readImage(document_, gltfImage), -1});
    return static_cast<int>(images.size()) - 1;
}

Sampler TextureTable::sampler(int gltfSampler) const {
    Sampler sampler;
    if (gltfSampler < 0) {
        return sampler;
    }
    const tinygltf::Sampler& source = document_.model.samplers[static_cast<size_t>(gltfSampler)];
    sampler.wrapS = wrapOf(source.wrapS);
    sampler.wrapT = wrapOf(source.wrapT);
    if (source.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) {
        sampler.magnify = Filter::nearest;
    }
    switch (source.minFilter) {
        case TINYGLTF_TEXTURE_FILTER_NEAREST:
            sampler.minify = Filter::nearest;
            sampler.mip = MipFilter::none;
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR:
            sampler.mip = MipFilter::none;
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
            sampler.minify = Filter::nearest;
            sampler.mip = MipFilter::nearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
            sampler.mip = MipFilter::nearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
            sampler.minify = Filter::nearest;
            break;
        default:
            break;
    }
    return sampler;
}

}  // namespace lobe
