/// The scene's lights as texture buffers, relative to the eye, and their cluster lists for one view.
#pragma once

#include <optional>
#include <vector>

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "passes/cluster_grid.hpp"
#include "plan/plan.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// Most lights that one loop of a shader runs over: llvmpipe ends loops at 65535 iterations without a word.
inline constexpr int kLightsPerDraw = 32768;
/// The same where each casts rays: 8,000 iterations a ray.
inline constexpr int kLightsPerDrawOfRays = 8;

class LightBuffers {
public:
    LightBuffers(const Scene& scene, const FramePlan& plan);

    /// Positions are made relative to the eye in double and sent; cluster lists are made anew.
    void update(const View& view);

    /// Texture units from `firstUnit` on, and every light uniform that the program uses, for all lights of
    /// its types. Returns the first free unit.
    int bind(const gl::Program& program, int firstUnit) const;

    /// Those of a type that cast shadows, in the order of their slots.
    std::vector<const Light*> casting(LightType type) const;

    int count(LightType type) const { return static_cast<int>(lights_[static_cast<size_t>(type)].size()); }
    /// Lights of the type that are outside the clusters: the first ones of its buffer.
    int globalCount(LightType type) const { return global_[static_cast<size_t>(type)]; }
    /// Tiles (column, row) that clustered lights of the type reach, as one vec2 an instance.
    const gl::VertexArray& tileArray(LightType type) const { return tiles_[static_cast<size_t>(type)]; }
    int tileCount(LightType type) const { return tileCounts_[static_cast<size_t>(type)]; }

private:
    void updateClusters(const View& view);
    /// Metres beyond which the light shows nothing, or less than the plan's threshold; absent: none.
    std::optional<double> reachOf(const Light& light) const;

    double reach_;  ///< FramePlan::lightReach

    std::vector<const Light*> lights_[3];  ///< by type, those outside the clusters first
    int global_[3] = {0, 0, 0};
    bool clustered_[3] = {false, false, false};
    bool shadows_[3] = {false, false, false};  ///< whether slots of shadows go with the lights
    double sceneRadius_;
    glm::dvec3 sceneCenter_;
    gl::TextureBuffer buffers_[3];
    gl::TextureBuffer clusters_[3];
    gl::TextureBuffer indices_;
    gl::VertexArray tiles_[3];
    gl::Buffer tileBuffers_[3];
    int tileCounts_[3] = {0, 0, 0};
    glm::vec3 sliceFactors_{0.0f};
    glm::ivec2 clusterTiles_{0};
};

}  // namespace lobe
