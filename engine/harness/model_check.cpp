#include "harness/model_check.hpp"

#include <algorithm>
#include <thread>

namespace lobe::harness {
namespace {

/// Fewer rows are not worth a thread.
constexpr size_t kRowsPerThread = 64;

}  // namespace

ModelCheck::ModelCheck(const Brdf& brdf)
    : brdf_(brdf), parts_(std::max(1U, std::thread::hardware_concurrency()), Comparison(brdf, Axes::local)) {}

void ModelCheck::add(const std::vector<BrdfRow>& rows, const std::vector<glm::vec3>& got) {
    if (!rows.empty()) valuesOf(brdf_, rows.front());  // the tables are made once, before there are threads
    const size_t count = std::clamp<size_t>(rows.size() / kRowsPerThread, 1, parts_.size());
    std::vector<std::vector<ModelFault>> faults(count);
    // Neighbours are of one kind, so that each thread takes every n-th.
    const auto work = [&](size_t part) {
        for (size_t i = part; i < rows.size(); i += count)
            if (!parts_[part].check(rows[i], directionsOf(rows[i]), got[i]))
                faults[part].push_back({rows_ + i, parts_[part].message()});
    };
    std::vector<std::jthread> threads;
    for (size_t part = 1; part < count; ++part)
        threads.emplace_back(work, part);
    work(0);
    threads.clear();
    const auto known = static_cast<std::ptrdiff_t>(faults_.size());
    for (const std::vector<ModelFault>& found : faults)
        faults_.insert(faults_.end(), found.begin(), found.end());
    std::sort(faults_.begin() + known, faults_.end(),
              [](const ModelFault& a, const ModelFault& b) { return a.row < b.row; });
    rows_ += rows.size();
}

ModelFigures ModelCheck::figures() const {
    ModelFigures figures;
    double ill = 0.0;
    for (const Comparison& part : parts_) {
        if (part.count() == 0) continue;
        figures.values += part.count();
        ill += part.illConditionedShare() * double(part.count());
        figures.worstUlp = std::max(figures.worstUlp, part.worstUlp());
        if (part.worst() <= figures.worstUnits) continue;
        figures.worstUnits = part.worst();
        figures.worstRelative = part.worstRelative();
        figures.worstRow = part.worstRow();
    }
    if (figures.values > 0) figures.illConditionedShare = ill / double(figures.values);
    return figures;
}

}  // namespace lobe::harness
