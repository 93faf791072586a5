/// Pictures as worker messages: what ImageFiles and lobe-image-worker say to each other. Every function that
/// takes a Message throws InputError when the message is not of the form that its counterpart makes.
#pragma once

#include <map>
#include <span>
#include <string>

#include "base/worker.hpp"
#include "image/image_files.hpp"

namespace lobe::image_wire {

enum class Task : uint8_t { decode, read, readMetadata, encodeBitmap, encodeImage };

struct Request {
    Task task = Task::decode;
    std::string extension;  ///< of the file to encode
    WriteOptions options;
};

Message request(Task task, SharedMemory file);
Message request(const std::string& extension, const Bitmap& bitmap, const WriteOptions& options);
Message request(const std::string& extension, const Image& image, const WriteOptions& options);
Request requestOf(const Message& message);

Message reply(const Bitmap& bitmap);
Message reply(const Image& image);
Message reply(const std::map<std::string, std::string>& metadata);
Message reply(const std::string& encodedFile);

/// Of a reply as well as of a request to encode.
Bitmap bitmapOf(const Message& message);
Image imageOf(const Message& message);
std::map<std::string, std::string> metadataOf(const Message& message);
std::span<const std::byte> fileOf(const Message& message);

}  // namespace lobe::image_wire
