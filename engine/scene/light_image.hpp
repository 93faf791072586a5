/// The picture that a rect light shows (LOBE_light_image).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace lobe {

/// Factors of a light's radiance, linear, no unit. Grey stands for equal red, green and blue; alpha does not
/// count; values that are negative or not finite are 0.
class LightImage {
public:
    explicit LightImage(const Bitmap& bitmap);

    int width() const { return width_; }
    int height() const { return height_; }
    glm::dvec3 texel(int x, int y) const;

    /// Bilinear between the centres of texels; the outermost go on to the edges. `place`: 0..1 from the left
    /// and from the top, as it is seen from the side that emits.
    glm::dvec3 at(const glm::dvec2& place) const;

    /// Of at most this size: means over the area that texels cover.
    LightImage reduced(int width, int height) const;

    /// Three values a texel, row by row from the top.
    const std::vector<float>& values() const { return values_; }

private:
    LightImage(int width, int height);
    int width_, height_;
    std::vector<float> values_;
};

/// Where a point of a rect is on its image, as LightImage::at() takes it. `offset`: from the rect's centre,
/// world, m.
glm::dvec2 placeOnImage(const Light& light, const glm::dvec3& offset);

/// Sets texels with a negative or not finite colour to 0, and says in words how many there were, if any.
std::optional<std::string> clearBadTexels(Bitmap& bitmap);

}  // namespace lobe
