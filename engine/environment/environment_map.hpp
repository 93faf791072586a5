/// A picture of light from infinity: looked up by direction, and drawn from by its brightness.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace lobe {

class EnvironmentMap {
public:
    /// `bitmap`: the picture of Scene::environment, null where that has none. 8- and 16-bit pictures are
    /// sRGB. Texels that are negative or not finite count as 0: badTexels() says how many there were.
    EnvironmentMap(const Environment& environment, const Bitmap* bitmap);

    /// The map of Scene::environment, which the scene must have.
    static EnvironmentMap of(const Scene& scene);
    /// The one that is seen behind surfaces, where it is.
    static EnvironmentMap ofBackground(const Scene& scene);

    /// W/(m^2 sr) from a unit direction of the world. Bilinear between texels, around the seam and over the
    /// poles.
    glm::dvec3 radiance(const glm::dvec3& direction) const;

    /// A direction for two numbers in [0, 1), with density().
    glm::dvec3 draw(double u, double v) const;
    /// 1/sr: the mean brightness of each texel's neighbourhood over the total; uniform for a constant
    /// environment.
    double density(const glm::dvec3& direction) const;

    bool constant() const { return texels_.empty(); }
    size_t badTexels() const { return badTexels_; }

    /// radiance() = scale() * relative(mapFromWorld() * direction): what of it intensity and rotation leave
    /// as it is.
    glm::dvec3 relative(const glm::dvec3& mapDirection) const;
    const glm::dvec3& scale() const { return scale_; }
    glm::dmat3 mapFromWorld() const { return glm::transpose(worldFromMap_); }
    /// Texels of the picture, 1 x 1 for a constant environment.
    int width() const { return constant() ? 1 : width_; }
    int height() const { return constant() ? 1 : height_; }
    /// relative() at the centre of a texel; rows from the top. Beyond its edges: around the seam, over the
    /// poles.
    glm::dvec3 at(int x, int y) const { return constant() ? glm::dvec3(1.0) : texel(x, y); }
    /// Of the texels: two maps with the same are alike but for scale and rotation.
    std::string contentHash() const;
    /// density() anywhere within a texel.
    double densityAt(int x, int y) const;

private:
    const glm::dvec3& texel(int x, int y) const;
    glm::dvec3 scale_;
    glm::dmat3 worldFromMap_;
    int width_ = 0, height_ = 0;
    std::vector<glm::dvec3> texels_;
    std::vector<double> rowSums_;  ///< cumulative over rows, height + 1
    std::vector<double> sums_;     ///< cumulative within each row, width + 1 a row
    size_t badTexels_ = 0;
};

}  // namespace lobe
