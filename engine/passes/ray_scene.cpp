#include "passes/ray_scene.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "passes/ray_hierarchy.hpp"

namespace lobe {
namespace {

/// Position from depth in float: rounding of the depth's plane, of the pixel's ray and of their product, in
/// lengths of the longest ray of the picture.
constexpr double kPositionRoundings = 16.0, kFloatRounding = 0x1p-24;
/// Rasterisers round vertices to a step of this many pixels, which moves a surface by half of it; GL asks for
/// 1/16, all drivers have 1/256.
constexpr double kSubpixel = 1.0 / 256.0;

/// Length of the ray through the corner of the picture where it is longest, for 1 m along the view axis.
double longestRay(const View& view) {
    double longest = 0.0;
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0})
            longest = std::max(longest, glm::length(view.rayDirection + x * view.width * view.rayDirectionDx +
                                                    y * view.height * view.rayDirectionDy));
    return longest;
}

}  // namespace

RayScene::RayScene(const Scene& scene, int maxTexels) {
    RayHierarchy hierarchy = buildRayHierarchy(scene);
    const size_t most =
        std::max({hierarchy.nodes.size() / 4, hierarchy.triangles.size() / 4, hierarchy.texels.size()});
    if (most > static_cast<size_t>(maxTexels))
        throw ContextError(scene.file + ": shadows by rays need a buffer of " + std::to_string(most) +
                           " texels; expected at most " + std::to_string(maxTexels) +
                           ", what the driver's buffers hold");
    opaqueNodes_ = hierarchy.opaqueNodes;
    allNodes_ = hierarchy.allNodes;
    center_ = hierarchy.center;
    scale_ = hierarchy.scale;
    error_ = hierarchy.error;
    bytes_ = hierarchy.bytes();
    // A buffer without texels is none that can be read.
    hierarchy.nodes.resize(std::max<size_t>(hierarchy.nodes.size(), 8));
    hierarchy.triangles.resize(std::max<size_t>(hierarchy.triangles.size(), 4));
    hierarchy.texels.resize(std::max<size_t>(hierarchy.texels.size(), 1));
    nodes_ =
        gl::makeTextureBuffer(GL_RGBA32UI, hierarchy.nodes.data(), hierarchy.nodes.size() * sizeof(uint32_t));
    triangles_ = gl::makeTextureBuffer(GL_RGBA32F, hierarchy.triangles.data(),
                                       hierarchy.triangles.size() * sizeof(float));
    texels_ =
        gl::makeTextureBuffer(GL_R32F, hierarchy.texels.data(), hierarchy.texels.size() * sizeof(float));
}

int RayScene::bind(const gl::Program& program, int firstUnit, const View& view) const {
    int unit = firstUnit;
    const auto attach = [&](const char* uniform, const gl::TextureBuffer& buffer) {
        if (!buffer.texture || program.uniform(uniform) < 0) return;
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(GL_TEXTURE_BUFFER, buffer.texture.id());
        program.set(uniform, unit++);
    };
    attach("uRayNodes", nodes_);
    attach("uRayTriangles", triangles_);
    attach("uRayTexels", texels_);
    if (unit == firstUnit) return unit;
    program.set("uRayNodesEnd", glm::ivec2(opaqueNodes_, allNodes_));
    program.set("uRayFrame", glm::vec4(glm::vec3(view.eye - center_), static_cast<float>(scale_)));
    program.set("uRayError", glm::vec2(positionError(view)));
    return unit;
}

glm::dvec2 RayScene::positionError(const View& view) const {
    const double pixel = std::max(glm::length(view.rayDirectionDx), glm::length(view.rayDirectionDy));
    const double pixelAcross = std::max(glm::length(view.rayOriginDx), glm::length(view.rayOriginDy));
    return {error_ + kSubpixel * pixelAcross,
            kFloatRounding * kPositionRoundings * longestRay(view) + kSubpixel * pixel};
}

}  // namespace lobe
