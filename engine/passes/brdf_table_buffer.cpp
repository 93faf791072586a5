#include "passes/brdf_table_buffer.hpp"

#include "scene/brdf_tables.hpp"

namespace lobe {
namespace {

constexpr int kUnit = 15;

}  // namespace

BrdfTableBuffer::BrdfTableBuffer(const Scene& scene) {
    const std::vector<float> rows = gatherTables(scene.materials);
    if (!rows.empty()) buffer_ = gl::makeTextureBuffer(GL_RGBA32F, rows.data(), rows.size() * sizeof(float));
}

void BrdfTableBuffer::bind(const gl::Program& program) const {
    if (!buffer_.texture || program.uniform("uBrdfTable") < 0) return;
    glActiveTexture(GL_TEXTURE0 + kUnit);
    glBindTexture(GL_TEXTURE_BUFFER, buffer_.texture.id());
    program.set("uBrdfTable", kUnit);
}

}  // namespace lobe
