/// Rays through shaders/glsl/shadow/rays.glsl on the test context, and the same by brute force in double.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "passes/ray_scene.hpp"
#include "scene/camera.hpp"

namespace lobe::test {

/// One call of ray_visibility.
struct RayQuery {
    glm::vec3 position{0.0f};  ///< relative to the eye
    glm::vec3 normal{0.0f};
    glm::vec3 direction{0.0f};
    float distance = std::numeric_limits<float>::infinity();
};

/// The view from `eye` along -Z.
View viewFrom(const glm::dvec3& eye);

/// ray_visibility of each; fails the test if a ray was not finished.
std::vector<float> castRays(const Scene& scene, const View& view, const std::vector<RayQuery>& queries);

/// What brute force says of a ray: within `tolerance` (m) of an edge or of the ends of its way it says
/// nothing.
enum class Truth { visible, blocked, tooClose };

/// All triangles of the scene in double.
class BruteForce {
public:
    explicit BruteForce(const Scene& scene);
    /// Of the ray from `origin` (world), up to `distance` lengths of the direction.
    Truth visibility(const glm::dvec3& origin, const glm::dvec3& direction, double distance,
                     double tolerance) const;

private:
    std::vector<std::array<glm::dvec3, 3>> triangles_;
};

/// Where a query's way starts, in the world: off the surface by RayScene::positionError.
glm::dvec3 startOf(const RayQuery& query, const View& view, const glm::dvec2& error);

}  // namespace lobe::test
