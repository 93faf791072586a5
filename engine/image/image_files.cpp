#include "image/image_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "image/image_wire.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;
using image_wire::Task;

constexpr const char* kProgram = "lobe-image-worker";

/// A worker's error with the name of what it is about in front.
template<class Action>
auto named(const std::string& what, const Action& action) {
    try {
        return action();
    } catch (const OutputError& error) {
        throw OutputError(what + ": " + error.what());
    } catch (const InputError& error) {
        throw InputError(what + ": " + error.what());
    } catch (const std::bad_alloc&) {
        throw InputError(what + ": not enough memory");
    }
}

SharedMemory contentOf(const fs::path& file) {
    constexpr off_t kLargest = off_t{1} << 31;
    const int descriptor =
        open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe does not block then
    if (descriptor < 0) throw InputError(std::strerror(errno));
    const auto closer =
        std::unique_ptr<const int, void (*)(const int*)>(&descriptor, [](const int* d) { close(*d); });
    struct stat status {};
    if (fstat(descriptor, &status) != 0) throw InputError(std::strerror(errno));
    if (S_ISDIR(status.st_mode)) throw InputError(std::strerror(EISDIR));
    if (!S_ISREG(status.st_mode)) throw InputError("not a regular file");
    if (status.st_size > kLargest)
        throw InputError("file size: " + std::to_string(status.st_size) + " bytes; expected at most " +
                         std::to_string(kLargest));
    SharedMemory memory(static_cast<size_t>(status.st_size));
    for (std::span<std::byte> rest = memory.bytes(); !rest.empty();) {
        const ssize_t got = ::read(descriptor, rest.data(), rest.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(std::strerror(errno));
        if (got == 0) throw InputError("file became shorter while it was read");
        rest = rest.subspan(static_cast<size_t>(got));
    }
    return memory;
}

template<class Picture>
void encodeAndWrite(Worker& worker, const fs::path& file, const Picture& picture,
                    const WriteOptions& options) {
    Message encoded;
    try {
        encoded = worker.call(image_wire::request(file.extension().string(), picture, options));
    } catch (const std::bad_alloc&) {
        throw OutputError(file.string() + ": can't be written: not enough memory");
    } catch (const Error& error) {  // a crash in the encoder, too, is a picture that was not written
        throw OutputError(file.string() + ": can't be written: " + error.what());
    }
    const auto bytes = image_wire::fileOf(encoded);
    writeAtomically(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace

ImageFiles::ImageFiles(WorkerLimits limits) : worker_(kProgram, limits) {}

Bitmap ImageFiles::decode(std::span<const std::byte> fileBytes, const std::string& what) {
    return named(what, [&] {
        return image_wire::bitmapOf(
            worker_.call(image_wire::request(Task::decode, SharedMemory::copyOf(fileBytes))));
    });
}

Image ImageFiles::read(const fs::path& file) {
    return named(file.string(), [&] {
        return image_wire::imageOf(worker_.call(image_wire::request(Task::read, contentOf(file))));
    });
}

std::map<std::string, std::string> ImageFiles::readMetadata(const fs::path& file) {
    return named(file.string(), [&] {
        return image_wire::metadataOf(worker_.call(image_wire::request(Task::readMetadata, contentOf(file))));
    });
}

void ImageFiles::write(const fs::path& file, const Bitmap& bitmap, const WriteOptions& options) {
    encodeAndWrite(worker_, file, bitmap, options);
}

void ImageFiles::write(const fs::path& file, const Image& image, const WriteOptions& options) {
    encodeAndWrite(worker_, file, image, options);
}

const std::vector<std::string>& ImageFiles::displayExtensions() {
    static const std::vector<std::string> extensions = {".png", ".jpg", ".jpeg"};
    return extensions;
}

const std::vector<std::string>& ImageFiles::linearExtensions() {
    static const std::vector<std::string> extensions = {".exr", ".hdr"};
    return extensions;
}

}  // namespace lobe
