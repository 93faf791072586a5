#include "reference/truth.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

namespace lobe::reference {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTile = 16;
constexpr double kFloorShare = 0.5;  ///< of the mean radiance
constexpr size_t kColor = 0, kError = 4, kSourcesAt = 7;

/// Sources that a scene can have, so that a picture holds no layer that is black for certain.
std::vector<Source> sourcesOf(const Scene& scene) {
    std::set<Source> sources;
    for (const Light& light : scene.lights)
        sources.insert(
            static_cast<Source>(static_cast<int>(Source::directional) + static_cast<int>(light.type)));
    for (const Material& material : scene.materials)
        if (material.emission != glm::vec3(0.0F) || findBrdf(material.brdf) == nullptr)
            sources.insert(Source::emission);
    if (scene.ambientRadiance) sources.insert(Source::ambient);
    if (scene.environment) sources.insert(Source::environment);
    if (scene.fog) sources.insert(Source::fog);
    return {sources.begin(), sources.end()};
}

float stored(double value) {
    return static_cast<float>(value);
}

class TruthRun {
public:
    TruthRun(const std::shared_ptr<const Scene>& scene, const Camera& camera, const TruthRequest& request,
             const Image* earlier, const std::atomic<bool>& stop)
        : request_(request),
          stop_(stop),
          sources_(sourcesOf(*scene)),
          integrator_(scene, camera, request.width, request.height, request.options),
          image_(request.width, request.height, truthChannels(*scene)) {
        if (earlier != nullptr && earlier->channels == image_.channels && earlier->width == image_.width &&
            earlier->height == image_.height) {
            image_.values = earlier->values;
            known_ = true;
        }
    }

    TruthResult run(const std::function<void(const TruthProgress&)>& progress,
                    const std::function<void(const Image&)>& checkpoint) {
        const auto start = Clock::now();
        if (request_.seconds)
            deadline_ = start + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(*request_.seconds));
        // A first look, of which the mean radiance is taken; then straight to what is wanted, or, against a
        // clock, there by halves.
        if (!known_) round(0, std::max(kFirstLook, request_.relativeError), kFirstRays, progress, checkpoint);
        known_ = true;
        double error =
            request_.seconds ? std::max(kFirstLook / 2, request_.relativeError) : request_.relativeError;
        for (uint64_t number = 1; !over(); ++number) {
            takeFloor();
            round(number, error, request_.mostRays, progress, checkpoint);
            if (error <= request_.relativeError) break;
            error = std::max(error / 2, request_.relativeError);
        }
        return result();
    }

private:
    static constexpr double kFirstLook = 0.1;
    static constexpr long long kFirstRays = 1024;

    /// A picture with pixels that nothing is known of is of no use: the first look is ended whatever the
    /// clock says.
    bool over() const { return stop_ || (known_ && deadline_ && Clock::now() >= *deadline_); }

    void takeFloor() {
        glm::dvec3 sum(0.0);
        for (size_t i = 0; i < image_.pixelCount(); ++i)
            for (int c = 0; c < 3; ++c)
                sum[c] += double{value(i, kColor + static_cast<size_t>(c))};
        floor_ = sum / static_cast<double>(image_.pixelCount()) * kFloorShare;
    }

    float& value(size_t pixel, size_t channel) {
        return image_.values[pixel * image_.channelCount() + channel];
    }

    bool goodEnough(size_t pixel, double relativeError) {
        for (size_t c = 0; c < 3; ++c)
            if (double{value(pixel, kError + c)} >
                relativeError * (double{value(pixel, kColor + c)} + floor_[static_cast<int>(c)]))
                return false;
        return true;
    }

    void round(uint64_t number, double relativeError, long long mostRays,
               const std::function<void(const TruthProgress&)>& progress,
               const std::function<void(const Image&)>& checkpoint) {
        const int columns = (image_.width + kTile - 1) / kTile, rows = (image_.height + kTile - 1) / kTile;
        const int tiles = columns * rows;
        std::atomic<int> next{0}, finished{0};
        std::exception_ptr failure;
        Effort effort;
        effort.relativeError = relativeError;
        effort.floor = floor_;
        effort.mostRays = mostRays;
        const auto work = [&] {
            try {
                for (int tile = next++; tile < tiles && !over(); tile = next++) {
                    const int x0 = tile % columns * kTile, y0 = tile / columns * kTile;
                    for (int y = y0; y < std::min(y0 + kTile, image_.height); ++y)
                        for (int x = x0; x < std::min(x0 + kTile, image_.width) && !over(); ++x)
                            pixel(x, y, effort, number);
                    ++finished;
                }
            } catch (...) {
                const std::lock_guard lock(mutex_);
                failure = std::current_exception();
                next = tiles;
            }
        };
        const unsigned count =
            request_.threads != 0 ? request_.threads : std::max(1U, std::thread::hardware_concurrency());
        std::atomic<unsigned> alive{count};
        std::vector<std::thread> threads;
        for (unsigned i = 0; i < count; ++i)
            threads.emplace_back([&] {
                work();
                --alive;
            });
        auto saved = Clock::now();
        while (alive > 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            progress({relativeError, static_cast<double>(finished) / tiles});
            if (known_ && Clock::now() - saved > std::chrono::seconds(30)) {
                Image copy;
                {
                    const std::lock_guard lock(mutex_);
                    copy = image_;
                }
                checkpoint(copy);
                saved = Clock::now();
            }
        }
        for (std::thread& thread : threads)
            thread.join();
        if (failure) std::rethrow_exception(failure);
        progress({relativeError, static_cast<double>(finished) / tiles});
    }

    void pixel(int x, int y, const Effort& effort, uint64_t number) {
        const size_t index =
            static_cast<size_t>(y) * static_cast<size_t>(image_.width) + static_cast<size_t>(x);
        // An error that few rays found may be too good to be true: what was asked for counts too.
        const size_t asked = image_.channelCount() - 1;
        if (known_ && goodEnough(index, effort.relativeError) && value(index, asked) > 0.0F &&
            value(index, asked) <= stored(effort.relativeError))
            return;
        const PixelTruth truth = integrator_.at(x, y, effort, number);
        const glm::dvec3 total = truth.total();
        const std::lock_guard lock(mutex_);
        for (size_t c = 0; c < 3; ++c) {
            const int i = static_cast<int>(c);
            value(index, kColor + c) = stored(total[i]);
            value(index, kError + c) = stored(std::sqrt(truth.variance[i]));
            for (size_t s = 0; s < sources_.size(); ++s)
                value(index, kSourcesAt + 3 * s + c) =
                    stored(truth.radiance[static_cast<size_t>(sources_[s])][i]);
        }
        value(index, 3) = stored(truth.coverage);
        const size_t surface = kSourcesAt + 3 * sources_.size();
        value(index, surface) = stored(truth.depth);
        for (size_t c = 0; c < 3; ++c)
            value(index, surface + 1 + c) = stored(truth.normal[static_cast<int>(c)]);
        value(index, surface + 4) = static_cast<float>(truth.material);
        value(index, surface + 5) = stored(effort.relativeError);
    }

    TruthResult result() {
        if (floor_ == glm::dvec3(0.0)) takeFloor();
        TruthResult result;
        double sum = 0.0;
        for (size_t i = 0; i < image_.pixelCount(); ++i) {
            result.unfinished += goodEnough(i, request_.relativeError) ? 0 : 1;
            for (size_t c = 0; c < 3; ++c) {
                const double scale = double{value(i, kColor + c)} + floor_[static_cast<int>(c)];
                const double error = scale > 0.0 ? double{value(i, kError + c)} / scale : 0.0;
                sum += error * error;
            }
        }
        result.relativeError = std::sqrt(sum / (3.0 * static_cast<double>(image_.pixelCount())));
        if (integrator_.environment() != nullptr) result.badTexels = integrator_.environment()->badTexels();
        result.image = std::move(image_);
        return result;
    }

    const TruthRequest& request_;
    const std::atomic<bool>& stop_;
    std::vector<Source> sources_;
    PixelIntegrator integrator_;
    Image image_;
    glm::dvec3 floor_{0.0};
    std::optional<Clock::time_point> deadline_;
    bool known_ = false;
    std::mutex mutex_;  ///< of what is written to the image while it may be copied
};

}  // namespace

std::vector<std::string> truthChannels(const Scene& scene) {
    std::vector<std::string> channels{"R", "G", "B", "A", "error.R", "error.G", "error.B"};
    for (const Source source : sourcesOf(scene))
        for (const char* c : {".R", ".G", ".B"})
            channels.push_back(nameOf(source) + std::string(c));
    for (const char* name : {"depth.Z", "normal.X", "normal.Y", "normal.Z", "material.id", "effort.Y"})
        channels.emplace_back(name);
    return channels;
}

TruthResult computeTruth(std::shared_ptr<const Scene> scene, const Camera& camera,
                         const TruthRequest& request, const Image* earlier, const std::atomic<bool>& stop,
                         const std::function<void(const TruthProgress&)>& progress,
                         const std::function<void(const Image&)>& checkpoint) {
    return TruthRun(std::move(scene), camera, request, earlier, stop).run(progress, checkpoint);
}

}  // namespace lobe::reference
