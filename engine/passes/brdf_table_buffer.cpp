#include "passes/brdf_table_buffer.hpp"

#include <algorithm>

#include "fit/table_cache.hpp"
#include "scene/brdf_tables.hpp"

namespace lobe {
namespace {

/// Beyond those that other inputs take one after the other, and the fixed ones of maps, layers and images (24
/// to 31).
constexpr int kUnit = 32;

}  // namespace

BrdfTableBuffer::BrdfTableBuffer(const Scene& scene, const FramePlan& plan) {
    std::vector<float> rows = gatherTables(scene.materials);
    std::vector<fit::TableRequest> requests;
    std::vector<size_t> places;
    for (const auto& [model, area] : plan.areaMethods) {
        if (area.method != AreaMethod::analytic || area.form.terms == 0) continue;
        requests.push_back(area.form.request);
        places.push_back(4 * static_cast<size_t>(area.form.firstRow));
    }
    const std::vector<fit::AreaTable> tables = fit::TableCache().tables(requests);
    for (size_t i = 0; i < tables.size(); ++i) {
        rows.resize(std::max(rows.size(), places[i] + tables[i].texels.size()));
        std::copy(tables[i].texels.begin(), tables[i].texels.end(),
                  rows.begin() + static_cast<std::ptrdiff_t>(places[i]));
    }
    if (!rows.empty()) buffer_ = gl::makeTextureBuffer(GL_RGBA32F, rows.data(), rows.size() * sizeof(float));
}

void BrdfTableBuffer::bind(const gl::Program& program) const {
    if (!buffer_.texture || program.uniform("uBrdfTable") < 0) return;
    glActiveTexture(GL_TEXTURE0 + kUnit);
    glBindTexture(GL_TEXTURE_BUFFER, buffer_.texture.id());
    program.set("uBrdfTable", kUnit);
}

}  // namespace lobe
