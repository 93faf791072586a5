/// Shadow maps on the GPU: one array texture of depths, and what shaders look them up by
/// (shaders/glsl/shadow/maps.glsl).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "passes/body_lights.hpp"
#include "passes/light_buffers.hpp"
#include "passes/shadow_fit.hpp"
#include "plan/plan.hpp"

namespace lobe {

/// A map and where it is kept.
struct PlacedShadowMap {
    ShadowProjection projection;
    ShadowTile tile;
};

class ShadowMaps {
public:
    /// Nothing is made where the plan has no maps. The scene is kept by reference.
    ShadowMaps(const Scene& scene, const FramePlan& plan, const LightBuffers& lights,
               const BodyLights& bodies);

    /// Fits the maps to what the view shows; returns those that must be drawn: all at first, later those
    /// whose projection has changed.
    std::vector<PlacedShadowMap> update(const View& view);

    /// Binds a framebuffer for one layer of depths.
    void bindForDrawing(int layer) const;
    /// Sets the samplers and uniforms of shadow/maps.glsl that the program uses.
    void bind(const gl::Program& program) const;

private:
    struct Slot {
        const Light* light = nullptr;
        std::vector<PlacedShadowMap> maps;  ///< one, four cascades or six faces
        std::array<double, kMostCascades - 1> ends{};
        std::array<double, 6> nearest{};  ///< of what casts, on each face, m; of lights with a body
    };
    void makeTexture();
    void placeLights();
    void fitDirectional(size_t slot, const View& view, std::vector<PlacedShadowMap>& changed);
    void sendRecords(const View& view);

    const Scene& scene_;
    PlannedShadowMaps planned_;
    ShadowFilter filter_;
    static constexpr size_t kTypes = static_cast<size_t>(LightType::tube) + 1;
    std::array<std::vector<Slot>, kTypes> slots_;  ///< by type of light, in the order of its shadows' slots
    std::vector<DirectionalFit> directional_;
    std::optional<View> fitted_;  ///< that directional maps are fitted to
    gl::Texture depths_;
    gl::Framebuffer framebuffer_;
    gl::Sampler comparing_, reading_;
    gl::TextureBuffer records_;
    std::array<int, kTypes> firstRecord_{};
    double turn_ = 0.0;  ///< of the taps of soft shadows
};

}  // namespace lobe
