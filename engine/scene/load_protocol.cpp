#include "scene/load_protocol.hpp"

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scene/serialize.hpp"

namespace lobe {

using nlohmann::json;

namespace {

/// File names are bytes, JSON texts are UTF-8: the path travels beside the JSON, as a blob.
std::span<const std::byte> asBytes(const std::string& text) {
    return std::as_bytes(std::span(text));
}

std::string textIn(const SharedMemory& blob) {
    const auto bytes = blob.bytes();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Message writeLoadRequest(const LoadRequest& request) {
    Message message;
    message.header =
        json{{"time", request.options.time}, {"normals", static_cast<int>(request.options.normals)}}.dump();
    message.blobs.push_back(SharedMemory::copyOf(asBytes(request.file.native())));
    for (const BrdfSource& source : request.options.brdfs) {
        message.blobs.push_back(SharedMemory::copyOf(asBytes(source.file)));
        message.blobs.push_back(SharedMemory::copyOf(asBytes(source.text)));
    }
    return message;
}

LoadRequest readLoadRequest(const Message& message) {
    const json header = json::parse(message.header, nullptr, false);
    if (!header.is_object() || message.blobs.size() % 2 != 1) {
        throw InputError("a request to the scene worker: not readable");
    }
    LoadRequest request;
    request.file = textIn(message.blobs[0]);
    for (size_t i = 1; i < message.blobs.size(); i += 2)
        request.options.brdfs.push_back({textIn(message.blobs[i]), textIn(message.blobs[i + 1])});
    request.options.time = header.value("time", 0.0);
    request.options.normals = static_cast<NormalsMode>(header.value("normals", 0));
    return request;
}

Message writeLoadReply(const Scene& scene, const std::vector<PackedImage>& images, SharedMemory pictures) {
    json list = json::array();
    for (const PackedImage& image : images) {
        list.push_back({{"name", image.name},
                        {"offset", image.offset},
                        {"size", image.size},
                        {"fallback", image.fallback}});
    }
    Message message;
    message.header = json{{"images", list}}.dump(-1, ' ', true, json::error_handler_t::replace);
    message.blobs.push_back(SharedMemory::copyOf(toBytes(scene)));
    message.blobs.push_back(std::move(pictures));
    return message;
}

LoadReply readLoadReply(Message message) {
    if (message.blobs.size() != 2) {
        throw InputError("the scene worker answered nothing readable");
    }
    LoadReply reply;
    reply.scene = sceneFromBytes(message.blobs[0].bytes());
    reply.pictures = std::move(message.blobs[1]);
    try {
        const json header = json::parse(message.header);  // named: it must outlive the loop over its part
        for (const json& image : header.at("images")) {
            reply.images.push_back({image.at("name").get<std::string>(), image.at("offset").get<size_t>(),
                                    image.at("size").get<size_t>(), image.at("fallback").get<int>()});
        }
    } catch (const json::exception& error) {
        throw InputError(std::string("the scene worker answered nothing readable (") + error.what() + ")");
    }
    for (const PackedImage& image : reply.images) {
        if (image.offset > reply.pictures.size() || image.size > reply.pictures.size() - image.offset ||
            image.fallback >= static_cast<int>(reply.images.size())) {
            throw InputError("the scene worker answered with images that it did not send");
        }
    }
    return reply;
}

}  // namespace lobe
