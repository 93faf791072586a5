#include "scene/load.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <numeric>
#include <set>
#include <thread>

#include "base/error.hpp"
#include "base/worker.hpp"
#include "scene/environment_picture.hpp"
#include "scene/light_image.hpp"
#include "scene/load_protocol.hpp"
#include "scene/made_environment.hpp"

namespace lobe {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSceneWorker = "lobe-scene-worker";
constexpr uint64_t kLargeFile = uint64_t{64} << 20;

/// Bytes of the scene file and of the buffers beside it: an estimate of the work, before anything is opened.
uint64_t estimatedBytes(const fs::path& file) {
    std::error_code failed;
    uint64_t total = fs::file_size(file, failed);
    if (failed) {
        return 0;
    }
    constexpr int kMostEntries = 1000;  // of a folder that is not the scene's own
    int seen = 0;
    for (fs::directory_iterator entry(file.parent_path().empty() ? "." : file.parent_path(), failed), end;
         !failed && entry != end && seen < kMostEntries; entry.increment(failed), ++seen) {
        if (entry->path().extension() == ".bin") {
            std::error_code noSize;
            const uint64_t size = entry->file_size(noSize);
            total += noSize ? 0 : size;
        }
    }
    return total;
}

/// Compressed or quantised vertices unpack to some twenty times their bytes, tangents need as much again for
/// a while.
WorkerLimits limitsFor(uint64_t bytes) {
    WorkerLimits limits;
    limits.timeout = std::chrono::seconds(60);
    if (bytes > kLargeFile) {
        limits.memoryBytes += static_cast<size_t>(bytes) * 40;
        limits.timeout += std::chrono::seconds(bytes / kLargeFile * 30);
    }
    return limits;
}

std::span<const std::byte> bytesOf(const LoadReply& reply, const PackedImage& image) {
    return reply.pictures.bytes().subspan(image.offset, image.size);
}

}  // namespace

struct SceneLoader::Workers {
    uint64_t sceneBytes = 0;  ///< that the scene worker's limits are made for
    std::unique_ptr<Worker> scene = std::make_unique<Worker>(kSceneWorker, limitsFor(0));
    std::array<ImageFiles, 2> images;

    LoadReply import(const fs::path& file, const LoadOptions& options) {
        const uint64_t bytes = estimatedBytes(file);
        if (bytes > std::max(sceneBytes, kLargeFile)) {
            scene = std::make_unique<Worker>(kSceneWorker, limitsFor(bytes));
            sceneBytes = bytes;
        }
        const Message request = writeLoadRequest({file, options});
        Message answer;
        try {
            answer = scene->call(request);
        } catch (const InputError& error) {
            // What the worker refuses names the file; why the worker itself failed does not.
            const std::string reason = error.what();
            throw reason.starts_with(file.string() + ":") ? error : InputError(file.string() + ": " + reason);
        }
        return readLoadReply(std::move(answer));
    }

    /// All images, or their fallbacks, each decoded by whichever thread is free.
    std::vector<Bitmap> decode(const LoadReply& reply, const std::string& file,
                               std::vector<std::string>& warnings) {
        std::vector<Bitmap> bitmaps(reply.images.size());
        std::vector<std::exception_ptr> failures(reply.images.size());
        std::vector<size_t> order(
            bitmaps.size());  // the largest first, so that neither thread ends long after the other
        std::iota(order.begin(), order.end(), size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](size_t a, size_t b) { return reply.images[a].size > reply.images[b].size; });
        std::atomic<size_t> next{0};
        const auto work = [&](ImageFiles& decoder) {
            for (size_t n = next++; n < order.size(); n = next++) {
                const size_t i = order[n];
                try {
                    bitmaps[i] =
                        decoder.decode(bytesOf(reply, reply.images[i]), file + ": " + reply.images[i].name);
                } catch (...) {
                    failures[i] = std::current_exception();
                }
            }
        };
        if (bitmaps.size() > 1) {
            std::thread second([&] { work(images[1]); });
            work(images[0]);
            second.join();
        } else {
            work(images[0]);
        }
        for (size_t i = 0; i < bitmaps.size(); ++i) {
            const int fallback = reply.images[i].fallback;
            if (failures[i] == nullptr) {
                continue;
            }
            try {
                std::rethrow_exception(failures[i]);
            } catch (const InputError& error) {
                if (fallback < 0 || failures[static_cast<size_t>(fallback)] != nullptr) {
                    throw;
                }
                warnings.push_back(reply.images[i].name + ": taken from " +
                                   reply.images[static_cast<size_t>(fallback)].name + " (" + error.what() +
                                   ")");
                bitmaps[i] = bitmaps[static_cast<size_t>(fallback)];
            }
        }
        return bitmaps;
    }
};

SceneLoader::SceneLoader() : workers_(std::make_unique<Workers>()) {}

SceneLoader::~SceneLoader() = default;

Scene SceneLoader::load(const fs::path& file, const LoadOptions& options) {
    LoadReply reply = workers_->import(file, options);
    Scene scene = std::move(reply.scene);
    scene.images = workers_->decode(reply, scene.file, scene.warnings);
    makeEnvironment(scene);
    if (scene.environment && scene.environment->image >= 0)
        if (auto warning = badTexelWarning(scene.images[static_cast<size_t>(scene.environment->image)]))
            scene.warnings.push_back(std::move(*warning));
    std::set<int> lightImages;
    for (const Light& light : scene.lights)
        if (light.image >= 0) lightImages.insert(light.image);
    for (const int image : lightImages) {
        const auto index = static_cast<size_t>(image);
        if (const auto warning = clearBadTexels(scene.images[index]))
            scene.warnings.push_back(scene.imageNames[index] + " " + *warning);
    }
    return scene;
}

}  // namespace lobe
