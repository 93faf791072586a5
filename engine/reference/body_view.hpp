/// A light with a body as one point sees it: its directions as smooth maps from the unit square, for
/// quadrature, and as draws with a density, for sampling.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.hpp"

namespace lobe::reference {

struct BodySample {
    glm::dvec3 direction{0.0};  ///< unit, towards the light
    double distance = 0.0;      ///< to its surface, metres
    /// at(): solid angle per unit of the square, sr. draw(): 1 / density, sr. 0: nothing of the light there.
    double solidAngle = 0.0;
};

/// Of rect, disk, sphere or tube. From within a sphere or tube the light is seen in all directions: the limit
/// of coming near.
class BodyView {
public:
    BodyView(const Light& light, const glm::dvec3& point);

    /// How many maps cover what is seen of the light; 0 behind a rect or disk.
    int patches() const { return patches_; }

    /// Map number `patch`, 0 <= u, v <= 1: the sum over the maps of the integral of f(direction) solidAngle
    /// du dv is the integral of f over the directions in which the light is seen.
    BodySample at(int patch, double u, double v) const;

    /// A direction for three numbers in [0, 1). Rect: uniform in solid angle where that is not tiny; sphere:
    /// uniform in solid angle; else uniform in area.
    BodySample draw(double u, double v, double w) const;

    /// Density of draw() in a direction, 1/sr; 0 where the light is not seen.
    double density(const glm::dvec3& direction) const;

    /// Metres to the light in a direction, if it is seen there.
    std::optional<double> distanceAlong(const glm::dvec3& direction) const;

    /// Half the angle under which the light is seen, or more; radians.
    double angularRadius() const { return angularRadius_; }

private:
    BodySample towards(const glm::dvec3& target, const glm::dvec3& normal, double area) const;
    double surfaceDensity(const glm::dvec3& direction, double distance, const glm::dvec3& normal,
                          double area) const;
    glm::dvec3 world(const glm::dvec3& local) const { return frame_ * local; }
    void viewRect();
    BodySample rectAt(double u, double v) const;
    void viewDisk();
    BodySample diskAt(double u, double v) const;
    void viewSphere(const glm::dvec3& center, double radius);
    BodySample sphereAt(double polar, double v, double solidAngle) const;
    void viewTube();
    BodySample cylinderAt(double u, double v) const;
    BodySample capAt(int side, double u, double v) const;
    /// Where a ray meets the tube, and the outward normal there.
    struct Hit {
        double distance = 0.0;
        glm::dvec3 normal{0.0};
        int patch = 0;
    };
    std::optional<Hit> tubeHit(const glm::dvec3& direction) const;

    const Light& light_;
    glm::dvec3 point_;
    int patches_ = 0;
    double angularRadius_ = 0.0;
    /// Columns: `axis`, the axis across, and the side that emits (rect, disk); the direction to the centre as
    /// third (sphere); with the tube's axis as third (tube).
    glm::dmat3 frame_{1.0};
    glm::dvec3 center_{0.0};  ///< relative to the point, in that frame (sphere: metres along the third)
    bool inside_ = false;

    // Rect: the spherical rectangle of Urena, Fajardo and King (EGSR 2013).
    double solidAngle_ = 0.0, k_ = 0.0, b0_ = 0.0, b1_ = 0.0;
    bool spherical_ = false;
    // Disk: its centre seen from the foot of the perpendicular.
    double height_ = 0.0, offset_ = 0.0, azimuth_ = 0.0, azimuthRange_ = 0.0;
    // Sphere.
    double polarRange_ = 0.0;
    // Tube.
    double arc_ = 0.0, arcCenter_ = 0.0;
    std::array<double, 3> areas_{};  ///< of what the maps run over: cylinder, caps
};

}  // namespace lobe::reference
