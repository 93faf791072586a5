#include "measure/cost.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "math/random.hpp"
#include "measure/variations.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;

constexpr double kLargestExponent = 3.0;

/// Constant and factor for an exponent, by least squares of relative distances with neither negative.
PowerLaw fitAt(const std::vector<double>& counts, const std::vector<double>& times, double exponent) {
    PowerLaw law;
    law.exponent = exponent;
    // Columns of the two unknowns, both over the time; the right side is 1.
    double cc = 0.0, cf = 0.0, ff = 0.0, c1 = 0.0, f1 = 0.0;
    for (size_t i = 0; i < counts.size(); ++i) {
        const double c = 1.0 / times[i], f = std::pow(counts[i], exponent) / times[i];
        cc += c * c;
        cf += c * f;
        ff += f * f;
        c1 += c;
        f1 += f;
    }
    const double determinant = cc * ff - cf * cf;
    if (determinant > 1e-12 * cc * ff) {
        law.constant = (c1 * ff - f1 * cf) / determinant;
        law.factor = (f1 * cc - c1 * cf) / determinant;
    } else {
        law.constant = c1 / cc;
    }
    if (law.factor < 0.0) law = {c1 / cc, 0.0, exponent, {}, 0.0};
    if (law.constant < 0.0) law = {0.0, f1 / ff, exponent, {}, 0.0};
    double squares = 0.0;
    for (size_t i = 0; i < counts.size(); ++i)
        squares += std::pow(law.at(counts[i]) / times[i] - 1.0, 2);
    law.misfit = std::sqrt(squares / static_cast<double>(counts.size()));
    return law;
}

PowerLaw fitMedians(const std::vector<double>& counts, const std::vector<double>& times) {
    constexpr double kCoarse = 0.05, kFine = 0.001;
    PowerLaw best = fitAt(counts, times, 0.0);
    const auto scan = [&](double low, double high, double step) {
        for (double exponent = std::max(low, 0.0); exponent <= std::min(high, kLargestExponent) + 1e-9;
             exponent += step)
            if (const PowerLaw law = fitAt(counts, times, exponent); law.misfit < best.misfit) best = law;
    };
    scan(0.0, kLargestExponent, kCoarse);
    scan(best.exponent - kCoarse, best.exponent + kCoarse, kFine);
    return best;
}

struct Variation {
    double count = 0.0;
    std::shared_ptr<const Scene> scene;
    int width = 0, height = 0;
};

size_t materialsInUse(const Scene& scene) {
    std::set<int> used;
    for (const Instance& instance : scene.instances)
        used.insert(scene.primitives[static_cast<size_t>(instance.primitive)].material);
    return used.size();
}

std::vector<Variation> variationsOf(const ReportScene& base, const std::string& what) {
    std::vector<Variation> all;
    const Scene& scene = *base.scene;
    const auto add = [&](double count, Scene changed) {
        all.push_back({count, std::make_shared<const Scene>(std::move(changed)), base.width, base.height});
    };
    if (what == "lights")
        for (const int copies : {1, 2, 4, 8, 16})
            add(static_cast<double>(scene.lights.size()) * copies, withLightCopies(scene, copies));
    if (what == "triangles")
        for (const int levels : {0, 1, 2, 3}) {
            Scene finer = withFinerTriangles(scene, levels);
            const auto count = static_cast<double>(finer.triangleCount());
            add(count, std::move(finer));
        }
    if (what == "materials")
        for (const int parts : {1, 2, 4, 8, 16}) {
            Scene more = withMaterialParts(scene, parts);
            const auto count = static_cast<double>(materialsInUse(more));
            if (all.empty() || count > all.back().count) add(count, std::move(more));
        }
    if (what == "pixels")
        for (const double scale : {0.25, 0.5, 0.75, 1.0, 1.5}) {
            const int width = std::max(1, static_cast<int>(base.width * scale));
            const int height = std::max(1, static_cast<int>(base.height * scale));
            all.push_back({double(width) * double(height), base.scene, width, height});
        }
    if (all.size() < 3 || all.front().count == 0.0)
        throw UsageError(scene.file + ": has too few " + what + " to vary; expected a scene with some");
    return all;
}

}  // namespace

double PowerLaw::at(double n) const {
    return constant + factor * std::pow(n, exponent);
}

PowerLaw fitPowerLaw(const std::vector<double>& counts, const std::vector<std::vector<double>>& times,
                     double confidence) {
    // Counts relative to the largest: powers stay small, and the factor is turned back at the end.
    const double largest = *std::max_element(counts.begin(), counts.end());
    std::vector<double> scaled, medians;
    for (size_t i = 0; i < counts.size(); ++i) {
        scaled.push_back(counts[i] / largest);
        medians.push_back(median(times[i]));
    }
    PowerLaw law = fitMedians(scaled, medians);
    constexpr int kResamples = 200;
    Pcg32 random(1);
    const auto rounds = static_cast<uint32_t>(times.front().size());
    std::vector<double> exponents;
    for (int r = 0; r < kResamples; ++r) {
        std::vector<std::vector<double>> drawn(times.size());
        for (uint32_t k = 0; k < rounds; ++k) {
            const uint32_t round = random.below(rounds);
            for (size_t i = 0; i < times.size(); ++i)
                drawn[i].push_back(times[i][round]);
        }
        std::vector<double> drawnMedians;
        for (const std::vector<double>& values : drawn)
            drawnMedians.push_back(median(values));
        exponents.push_back(fitMedians(scaled, drawnMedians).exponent);
    }
    std::sort(exponents.begin(), exponents.end());
    const auto tail = static_cast<size_t>(0.5 * (1.0 - confidence) * kResamples);
    law.exponentInterval = {exponents[tail], exponents[exponents.size() - 1 - tail], confidence};
    law.factor /= std::pow(largest, law.exponent);
    return law;
}

const std::vector<std::string>& costNames() {
    static const std::vector<std::string> names = {"lights", "pixels", "triangles", "materials"};
    return names;
}

json measureCost(gl::Context& context, const ReportScene& scene, const Quality& quality,
                 const std::string& what, double seconds, const ReportEvents& events) {
    const std::vector<Variation> variations = variationsOf(scene, what);
    const Clock clock = clockOf(context.info());
    Renderer renderer(context);
    const auto prepare = [&](size_t i) {
        events.progress(scene.key + ": " + std::to_string(static_cast<long long>(variations[i].count)) + " " +
                        what);
        RenderOptions options;
        options.width = variations[i].width;
        options.height = variations[i].height;
        options.quality = quality;
        options.timePasses = clock == Clock::timerQueries;
        renderer.setScene(variations[i].scene, options);
        renderer.render(scene.camera);
    };
    Repeats repeats;
    repeats.seconds = seconds;
    const std::vector<Samples> samples = interleave(
        variations.size(), repeats, prepare, [&](size_t) { return timeFrame(renderer, scene.camera, clock); },
        *events.stop);
    if (samples.front().clock.empty()) return {};  // stopped in the first round
    json points = json::array();
    std::vector<double> counts;
    std::vector<std::vector<double>> times;
    for (size_t i = 0; i < samples.size(); ++i) {
        const TimeSummary time = summariseTime(samples[i]);
        points.push_back({{"count", variations[i].count},
                          {"median_ms", time.median},
                          {"low_ms", time.interval.low},
                          {"high_ms", time.interval.high},
                          {"confidence", time.interval.confidence},
                          {"repeats", time.repeats}});
        counts.push_back(variations[i].count);
        times.push_back(samples[i].clock);
    }
    const PowerLaw law = fitPowerLaw(counts, times);
    return {{"what", what},
            {"scene", scene.scene->name},
            {"width", scene.width},
            {"height", scene.height},
            {"points", points},
            {"fit",
             {{"constant_ms", law.constant},
              {"factor_ms", law.factor},
              {"exponent", law.exponent},
              {"exponent_low", law.exponentInterval.low},
              {"exponent_high", law.exponentInterval.high},
              {"confidence", law.exponentInterval.confidence},
              {"misfit", law.misfit}}}};
}

}  // namespace lobe::measure
