#include "image/image_wire.hpp"

#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace lobe::image_wire {
namespace {

using nlohmann::json;

std::string dump(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

json shapeOf(const Bitmap& bitmap) {
    return {{"width", bitmap.width},
            {"height", bitmap.height},
            {"channels", bitmap.channels},
            {"type", static_cast<int>(bitmap.type)}};
}

json shapeOf(const Image& image) {
    return {{"width", image.width}, {"height", image.height}, {"names", image.channels}};
}

json toJson(const WriteOptions& options) {
    return {{"metadata", options.metadata},
            {"half", options.exrPrecision == ExrPrecision::half},
            {"quality", options.jpegQuality}};
}

SharedMemory pixelsOf(const Bitmap& bitmap) {
    return SharedMemory::copyOf(bitmap.data);
}

SharedMemory pixelsOf(const Image& image) {
    return SharedMemory::copyOf(std::as_bytes(std::span(image.values)));
}

template<class Picture>
Message replyWith(const Picture& picture) {
    Message message;
    message.header = dump({{"shape", shapeOf(picture)}});
    message.blobs.push_back(pixelsOf(picture));
    return message;
}

template<class Picture>
Message encodeRequest(Task task, const std::string& extension, const Picture& picture,
                      const WriteOptions& options) {
    Message message;
    message.header = dump({{"task", static_cast<int>(task)},
                           {"extension", extension},
                           {"options", toJson(options)},
                           {"shape", shapeOf(picture)}});
    message.blobs.push_back(pixelsOf(picture));
    return message;
}

/// Runs `read` on the parsed header; all that a wrong form throws becomes one InputError.
template<class Read>
auto parsed(const Message& message, const Read& read) {
    try {
        return read(json::parse(message.header));
    } catch (const json::exception& error) {
        throw InputError(std::string("image worker: unexpected message: ") + error.what());
    }
}

std::span<const std::byte> onlyBlob(const Message& message) {
    if (message.blobs.size() != 1) throw InputError("image worker: unexpected message: expected one blob");
    return message.blobs[0].bytes();
}

/// A shape that the blob really has; no side or count can overflow the products.
void checkShape(int64_t width, int64_t height, int64_t components, size_t bytesPerComponent, size_t bytes) {
    constexpr int64_t kMost = 1 << 20;
    const bool inRange = width >= 0 && width < kMost && height >= 0 && height < kMost && components >= 0 &&
                         components < kMost && bytesPerComponent <= 4;
    if (!inRange ||
        static_cast<size_t>(width * height) * static_cast<size_t>(components) * bytesPerComponent != bytes)
        throw InputError("image worker: unexpected message: picture and pixels differ in size");
}

}  // namespace

Message request(Task task, SharedMemory file) {
    Message message;
    message.header = dump({{"task", static_cast<int>(task)}});
    message.blobs.push_back(std::move(file));
    return message;
}

Message request(const std::string& extension, const Bitmap& bitmap, const WriteOptions& options) {
    return encodeRequest(Task::encodeBitmap, extension, bitmap, options);
}

Message request(const std::string& extension, const Image& image, const WriteOptions& options) {
    return encodeRequest(Task::encodeImage, extension, image, options);
}

Request requestOf(const Message& message) {
    return parsed(message, [](const json& header) {
        Request request;
        request.task = static_cast<Task>(header.at("task").get<int>());
        if (request.task != Task::encodeBitmap && request.task != Task::encodeImage) return request;
        header.at("extension").get_to(request.extension);
        const json& options = header.at("options");
        options.at("metadata").get_to(request.options.metadata);
        request.options.exrPrecision =
            options.at("half").get<bool>() ? ExrPrecision::half : ExrPrecision::single;
        options.at("quality").get_to(request.options.jpegQuality);
        return request;
    });
}

Message reply(const Bitmap& bitmap) {
    return replyWith(bitmap);
}

Message reply(const Image& image) {
    return replyWith(image);
}

Message reply(const std::map<std::string, std::string>& metadata) {
    Message message;
    message.header = dump(metadata);
    return message;
}

Message reply(const std::string& encodedFile) {
    Message message;
    message.header = "{}";
    message.blobs.push_back(SharedMemory::copyOf(std::as_bytes(std::span(encodedFile))));
    return message;
}

Bitmap bitmapOf(const Message& message) {
    const auto pixels = onlyBlob(message);
    return parsed(message, [&](const json& header) {
        const json& shape = header.at("shape");
        const int type = shape.at("type").get<int>();
        if (type < 0 || type > static_cast<int>(ComponentType::f32))
            throw InputError("image worker: unexpected message: component type " + std::to_string(type));
        Bitmap bitmap{shape.at("width").get<int>(),
                      shape.at("height").get<int>(),
                      shape.at("channels").get<int>(),
                      static_cast<ComponentType>(type),
                      {}};
        checkShape(bitmap.width, bitmap.height, bitmap.channels, bitmap.bytesPerComponent(), pixels.size());
        bitmap.data.assign(pixels.begin(), pixels.end());
        return bitmap;
    });
}

Image imageOf(const Message& message) {
    const auto pixels = onlyBlob(message);
    return parsed(message, [&](const json& header) {
        const json& shape = header.at("shape");
        const int width = shape.at("width").get<int>();
        const int height = shape.at("height").get<int>();
        auto names = shape.at("names").get<std::vector<std::string>>();
        checkShape(width, height, static_cast<int64_t>(names.size()), sizeof(float), pixels.size());
        Image image(width, height, std::move(names));
        if (!pixels.empty()) std::memcpy(image.values.data(), pixels.data(), pixels.size());
        return image;
    });
}

std::map<std::string, std::string> metadataOf(const Message& message) {
    return parsed(message,
                  [](const json& header) { return header.get<std::map<std::string, std::string>>(); });
}

std::span<const std::byte> fileOf(const Message& message) {
    return onlyBlob(message);
}

}  // namespace lobe::image_wire
