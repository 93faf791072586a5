#include "harness/model_check.hpp"

#include <algorithm>
#include <thread>

namespace lobe::harness {
namespace {

/// Rows with as much work for each thread: neighbours are of one kind, so that every n-th is taken.
struct Part {
    Comparison comparison;
    std::vector<ModelFault> faults;
};

std::vector<Part> compareParts(const Brdf& brdf, const std::vector<BrdfRow>& rows,
                               const std::vector<glm::vec3>& got, Comparison::Conditions conditions) {
    if (!rows.empty()) valuesOf(brdf, rows.front());  // the tables are made once, before there are threads
    const size_t count =
        std::clamp<size_t>(rows.size() / 256, 1, std::max(1U, std::thread::hardware_concurrency()));
    std::vector<Part> parts(count, Part{Comparison(brdf, Axes::local, conditions), {}});
    const auto work = [&](size_t first) {
        Part& part = parts[first];
        for (size_t i = first; i < rows.size(); i += count)
            if (!part.comparison.check(rows[i], directionsOf(rows[i]), got[i]))
                part.faults.push_back({i, part.comparison.message()});
    };
    std::vector<std::thread> threads;
    for (size_t first = 1; first < count; ++first)
        threads.emplace_back(work, first);
    work(0);
    for (std::thread& thread : threads)
        thread.join();
    return parts;
}

}  // namespace

ModelComparison compareWithTwin(const Brdf& brdf, const std::vector<BrdfRow>& rows,
                                const std::vector<glm::vec3>& got) {
    ModelComparison result;
    for (Part& part : compareParts(brdf, rows, got, Comparison::Conditions::whenNeeded)) {
        result.faults.insert(result.faults.end(), part.faults.begin(), part.faults.end());
        result.values += part.comparison.count();
        result.worstUlp = std::max(result.worstUlp, part.comparison.worstUlp());
        if (part.comparison.worst() <= result.worstUnits) continue;
        result.worstUnits = part.comparison.worst();
        result.worstRelative = part.comparison.worstRelative();
        result.worstRow = part.comparison.worstRow();
    }
    std::sort(result.faults.begin(), result.faults.end(),
              [](const ModelFault& a, const ModelFault& b) { return a.row < b.row; });
    return result;
}

double illConditionedShare(const Brdf& brdf, const std::vector<BrdfRow>& rows,
                           const std::vector<glm::vec3>& got) {
    double bad = 0.0;
    double all = 0.0;
    for (const Part& part : compareParts(brdf, rows, got, Comparison::Conditions::always)) {
        bad += part.comparison.illConditionedShare() * double(part.comparison.count());
        all += double(part.comparison.count());
    }
    return all > 0.0 ? bad / all : 0.0;
}

}  // namespace lobe::harness
