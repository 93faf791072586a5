#include "prefilter_times.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>

#include "environment/prefiltered.hpp"
#include "math/random.hpp"

namespace lobe::bench {
namespace {

using environment::Prefiltered;
using environment::RadianceTree;

constexpr const char* kModels[] = {"metallic_roughness",
                                   "ashikhmin_shirley",
                                   "beckmann_smith",
                                   "blinn_phong",
                                   "cook_torrance",
                                   "ggx",
                                   "oren_nayar",
                                   "phong",
                                   "ward"};
/// As environment/radiance_tree.cpp has them, of layers that are read in rings: the most reads a texel.
constexpr double kReads = 12.0 * 12.0;

struct Seconds {
    double clock = 1e9, processor = 1e9;
};

template<class Work>
Seconds timed(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t used = std::clock();
    work();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC};
}

/// Of the processor: on one core, as others may use it too.
template<class Work>
double secondsOf(const Work& work) {
    return timed(work).processor;
}

environment::Request requestOf(const Brdf& brdf, double narrowest) {
    environment::Request request{{&brdf, brdf.defaults()}, {0.0, 0.0}, true};
    request.lobe.colorsVary = true;
    request.lobe.widthVaries = !brdf.area->width.empty();
    const auto [least, most] = brdf.area->widths;
    // An exponent n is about as wide as a slope of sqrt(2 / n).
    const bool exponent = most > 1.0;
    request.widths = exponent ? std::pair(std::max(least, 2.0), std::min(most, 2.0 / (narrowest * narrowest)))
                              : std::pair(std::max(least, narrowest), most);
    return request;
}

/// ns to copy a byte, and to read four texels of a small level and mix them, on one core.
struct Floors {
    double copy, read;
};

Floors floors() {
    std::vector<char> from(size_t{64} << 20, 1), to(from.size());
    double copy = 1e9;
    for (int i = 0; i < 5; ++i)
        copy = std::min(copy, secondsOf([&] { std::memcpy(to.data(), from.data(), from.size()); }));
    constexpr int kSide = 128, kCount = 1 << 22;
    std::vector<glm::vec3> level(kSide * kSide, glm::vec3(1.0F));
    Pcg32 random(1);
    std::vector<uint32_t> places(4096);
    for (uint32_t& place : places)
        place = random.below(kSide * kSide - kSide - 1);
    volatile float sink = 0.0F;
    double read = 1e9;
    for (int i = 0; i < 5; ++i)
        read = std::min(read, secondsOf([&] {
                            glm::vec3 sum(0.0F);
                            for (size_t n = 0; n < kCount; ++n) {
                                const glm::vec3* at = &level[places[n % places.size()]];
                                sum += 0.25F * (at[0] + at[1] + at[kSide] + at[kSide + 1]);
                            }
                            sink = sink + sum.x + sum.y + sum.z;
                        }));
    return {copy / static_cast<double>(from.size()), read / kCount};
}

/// Of layers alone.
double layerTexels(const Prefiltered& made) {
    double sum = 0.0;
    for (const environment::Square& layer : made.layers)
        sum += static_cast<double>(layer.size) * layer.size;
    return sum;
}

}  // namespace

std::vector<PrefilterTime> prefilterTimes(const Bitmap& bitmap, double narrowest, int rounds,
                                          const std::function<void(const PrefilterTime&)>& done) {
    const Floors least = floors();
    Environment environment;
    environment.image = 0;
    std::vector<PrefilterTime> times;
    const auto add = [&](PrefilterTime time) {
        time.floor = time.bytes * least.copy + time.samples * least.read;
        times.push_back(time);
        done(time);
    };
    const auto repeated = [&](const char* what, double bytes, double samples,
                              const std::function<void()>& work) {
        PrefilterTime time{what, 1e9, 1e9, bytes, samples};
        for (int i = 0; i < rounds; ++i) {
            const Seconds seconds = timed(work);
            time.seconds = std::min(time.seconds, seconds.clock);
            time.processor = std::min(time.processor, seconds.processor);
        }
        return time;
    };
    std::optional<EnvironmentMap> map;
    std::optional<RadianceTree> tree;
    const auto whole = static_cast<double>(bitmap.data.size());
    const double texels = static_cast<double>(bitmap.width) * bitmap.height;
    add(repeated("map", whole, 0.0, [&] { map.emplace(environment, &bitmap); }));
    add(repeated("tree", whole, texels, [&] { tree.emplace(*map); }));
    PrefilterTime one{"one model"}, nine{"nine models"};
    const auto count = [](PrefilterTime& sum, const PrefilterTime& part) {
        sum.seconds += part.seconds;
        sum.processor += part.processor;
        sum.bytes += part.bytes;
        sum.samples += part.samples;
    };
    for (const PrefilterTime& time : times) {
        count(one, time);
        count(nine, time);
    }
    for (const char* name : kModels) {
        const environment::Request request = requestOf(requireBrdf(name), narrowest);
        Prefiltered made;
        PrefilterTime time = repeated(name, 0.0, 0.0, [&] { made = prefiltered(*tree, request); });
        time.bytes = static_cast<double>(made.texels.size() * sizeof(float));
        time.samples = kReads * layerTexels(made);
        add(time);
        count(nine, time);
        if (name == kModels[0]) count(one, time);
    }
    add(one);
    add(nine);
    return times;
}

}  // namespace lobe::bench
