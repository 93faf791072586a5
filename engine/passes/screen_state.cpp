#include "passes/screen_state.hpp"

#include "passes/material_glsl.hpp"
#include "passes/parameters.hpp"

namespace lobe {

ScreenInputs::ScreenInputs(const Scene& scene, const FramePlan& plan, const BrdfTableBuffer& tables)
    : scene_(scene), plan_(plan), tables_(tables), empty_(gl::VertexArray::make()) {
    if (materialTableStride(plan) == 0) return;
    std::vector<float> table;
    for (const Material& material : scene.materials) {
        const std::vector<float> row = materialTableRow(plan, material);
        table.insert(table.end(), row.begin(), row.end());
    }
    materials_ = gl::makeTextureBuffer(GL_RGBA32F, table.data(), table.size() * sizeof(float));
}

int ScreenInputs::bindView(const gl::Program& program, const Targets& targets, const View& view) const {
    int unit = 0;
    if (program.uniform("uDepth") >= 0) {
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(
            GL_TEXTURE_2D,
            targets.texture(plan_.reversedDepth || !targets.has("linear_z") ? "depth" : "linear_z"));
        glBindSampler(0, 0);
        program.set("uDepth", unit++);
    }
    program.set("uDepthToZ", glm::vec4(view.depthToZ));
    program.set("uRayOrigin", glm::vec3(view.rayOrigin));
    program.set("uRayOriginDx", glm::vec3(view.rayOriginDx));
    program.set("uRayOriginDy", glm::vec3(view.rayOriginDy));
    program.set("uRayDirection", glm::vec3(view.rayDirection));
    program.set("uRayDirectionDx", glm::vec3(view.rayDirectionDx));
    program.set("uRayDirectionDy", glm::vec3(view.rayDirectionDy));
    return unit;
}

int ScreenInputs::bind(const gl::Program& program, const Targets& targets, const View& view,
                       const PlannedBrdf& brdf) const {
    int unit = bindView(program, targets, view);
    const auto attach = [&](const std::string& uniform, GLenum kind, GLuint texture) {
        if (program.uniform(uniform) < 0) return;
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(kind, texture);
        glBindSampler(static_cast<GLuint>(unit), 0);
        program.set(uniform, unit++);
    };
    if (targets.has("normal")) attach("uNormal", GL_TEXTURE_2D, targets.texture("normal"));
    if (targets.has("geometric_normal"))
        attach("uGeometricNormal", GL_TEXTURE_2D, targets.texture("geometric_normal"));
    if (targets.has("tangent")) attach("uTangent", GL_TEXTURE_2D, targets.texture("tangent"));
    if (targets.has("material")) attach("uMaterialId", GL_TEXTURE_2D, targets.texture("material"));
    for (int i = 0; targets.has("parameters" + std::to_string(i)); ++i)
        attach("uParameters" + std::to_string(i), GL_TEXTURE_2D,
               targets.texture("parameters" + std::to_string(i)));
    if (targets.has("occlusion")) attach("uOcclusion", GL_TEXTURE_2D, targets.texture("occlusion"));
    if (targets.has("ambient_occlusion"))
        attach("uAmbientOcclusion", GL_TEXTURE_2D, targets.texture("ambient_occlusion"));
    if (materials_.texture) attach("uMaterials", GL_TEXTURE_BUFFER, materials_.texture.id());

    tables_.bind(program);
    if (brdf.name == kUnlit) return unit;
    for (const Instance& instance : scene_.instances) {
        const Primitive& primitive = scene_.primitives[static_cast<size_t>(instance.primitive)];
        const Material& material = scene_.materials[static_cast<size_t>(primitive.material)];
        if (material.brdf != brdf.name || material.alphaMode == AlphaMode::blend || seesThrough(material))
            continue;
        // Parameters that reach the shader as uniforms are the same for all; any material of the model will
        // do.
        setParameters(program, requireBrdf(brdf.name), material.values);
        break;
    }
    return unit;
}

void ScreenInputs::setMask(const PlannedBrdf* brdf) const {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glDepthFunc(plan_.reversedDepth ? GL_LESS : GL_GREATER);
    glDisable(GL_CULL_FACE);
    if (!plan_.masked || brdf == nullptr) return;
    glEnable(GL_STENCIL_TEST);
    glStencilMask(0);
    glStencilFunc(GL_EQUAL, brdf->stencil, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

void ScreenInputs::setBackgroundMask() const {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_EQUAL);
    glDisable(GL_CULL_FACE);
}

void ScreenInputs::clearMask() const {
    glDisable(GL_STENCIL_TEST);
    glStencilMask(0xff);
    glDisable(GL_DEPTH_TEST);
}

void ScreenInputs::drawScreen(const gl::Program& program) const {
    program.set("uFarDepth", farDepth());
    glBindVertexArray(empty_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ScreenInputs::drawTiles(const gl::Program& program, const Targets& targets, const gl::VertexArray& tiles,
                             int count) const {
    program.set("uFarDepth", farDepth());
    program.set("uTileSize", glm::vec2(128.0f / static_cast<float>(targets.width()),
                                       128.0f / static_cast<float>(targets.height())));
    glBindVertexArray(tiles.id());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

}  // namespace lobe
