/// An environment map as a tree over the sphere, summed with kernels whose width is far above a texel's.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "environment/environment_map.hpp"
#include "environment/zonal_kernel.hpp"

namespace lobe::environment {

/// Calls `work` for 0 .. count - 1 on all processors.
void inParallel(size_t count, const std::function<void(size_t)>& work);

/// The octahedral square of pass/environment.glsl: in [-1, 1]^2, about z.
glm::dvec3 octahedralDirection(glm::dvec2 p);

/// The square that one just outside the map's border is: each side folds over at its middle.
std::pair<int, int> foldedSquare(int x, int y, int size);

/// Squares of the octahedral map, each with its light as a whole and where most of it comes from. Directions
/// are the map's, radiance is EnvironmentMap::relative's.
class RadianceTree {
public:
    explicit RadianceTree(const EnvironmentMap& map);

    /// Squares along a side of the finest level, a power of two.
    int size() const { return size_; }
    /// Mean radiance of a square of the finest level.
    glm::vec3 radiance(int x, int y) const;
    /// Radiance weighed by a kernel about a unit direction: the sum over squares that are small against how
    /// fast the kernel changes, over the sum of the weights, so that a constant map stays as it is.
    glm::dvec3 blurred(const glm::vec3& axis, const ZonalKernel& kernel) const;

    /// Nearly the same, far quicker for narrow kernels: a sum over rings about the axis that hold given
    /// shares of the kernel, each read at twelve places from the level whose squares are as large as the
    /// parts of the ring.
    class Rings {
    public:
        static constexpr size_t kAround = 12;
        Rings(const RadianceTree& tree, const ZonalKernel& kernel);
        glm::dvec3 about(const glm::vec3& axis) const;

    private:
        struct Ring {
            float cosine, share;
            size_t level;
            std::array<glm::vec2, kAround> places;  ///< across the axis
        };
        const RadianceTree& tree_;
        std::vector<Ring> rings_;
    };

    struct Node {
        glm::vec3 direction;  ///< unit, of the middle of its light
        float radius;         ///< of a circle about it, rad
        glm::vec3 energy;     ///< radiance times solid angle
        float solidAngle;     ///< sr
    };
    const std::vector<Node>& finest() const { return levels_.front(); }
    const glm::dvec3& mean() const { return mean_; }

private:
    using Four = float __attribute__((vector_size(16)));
    /// Bilinear, of one level: red, green, blue.
    Four read(size_t level, const glm::vec3& direction) const;
    int size_ = 0;
    std::vector<std::vector<Four>> radiance_;  ///< of each level, with a border of one square
    std::vector<std::vector<Node>> levels_;    ///< from the finest to 4 x 4
    glm::dvec3 mean_{0.0};
};

}  // namespace lobe::environment
