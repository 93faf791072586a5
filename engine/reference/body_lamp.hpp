/// Light of a body with its image, if it shows one, for the integrals of this folder.
#pragma once

#include <memory>
#include <utility>

#include "reference/body_view.hpp"
#include "scene/light_image.hpp"

namespace lobe::reference {

/// A light's image, and places on it drawn by how bright they are.
class BodyImage {
public:
    explicit BodyImage(const Bitmap& bitmap);

    const LightImage& image() const { return image_; }
    /// A place for two numbers in [0, 1): uniform within squares about the texels, which are drawn by their
    /// mean.
    glm::dvec2 draw(double u, double v) const;
    /// Density of draw() at a place, of unit square.
    double density(const glm::dvec2& place) const;
    bool black() const { return rows_.back() == 0.0; }

private:
    LightImage image_;
    std::vector<double> rows_;     ///< running sums of the rows' weights, 0 first
    std::vector<double> columns_;  ///< the same within each row, width + 1 a row
};

/// A light as one point sees it. Keeps references to light and image.
class BodyLamp {
public:
    /// `radiance`: where the image is white; `image` may be null.
    BodyLamp(const Light& light, const glm::dvec3& point, const glm::dvec3& radiance, const BodyImage* image)
        : light_(light), point_(point), view_(light, point), radiance_(radiance), image_(image) {}

    const BodyView& view() const { return view_; }

    /// As BodyView::draw(); with an image half of them by its brightness.
    BodySample draw(double u, double v, double w) const;
    /// Density of draw() in a direction, 1/sr.
    double density(const glm::dvec3& direction) const;

    /// What comes from the light in a direction, `distance` metres away.
    glm::dvec3 radiance(const glm::dvec3& direction, double distance) const;
    /// The same with the distance; zeros where the light is not seen.
    std::pair<glm::dvec3, double> towards(const glm::dvec3& direction) const;

private:
    glm::dvec2 place(const glm::dvec3& direction, double distance) const;
    /// Densities by brightness in a direction.
    double imageDensity(const glm::dvec3& direction, double distance) const;
    const Light& light_;
    glm::dvec3 point_;
    BodyView view_;
    glm::dvec3 radiance_;
    const BodyImage* image_;
};

}  // namespace lobe::reference
