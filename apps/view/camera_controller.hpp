/// Orbit, pan, dolly and flight: a camera that moves smoothly, however fast pictures come.
#pragma once

#include "pose.hpp"
#include "scene/scene.hpp"

namespace lobe::view {

class CameraController {
public:
    /// Starts from a camera that was drawn with, looking at the depth of the bounds' centre.
    void adopt(const Camera& camera, const Bounds& bounds);
    void adopt(const Pose& pose, const Bounds& bounds);
    bool adopted() const { return adopted_; }
    void forget() { adopted_ = false; }

    // Pixels are those of the window; `height` is the picture's in them.
    void orbit(double dx, double dy, double height);
    void pan(double dx, double dy, double height);
    void dolly(double steps);                       ///< positive: nearer, a tenth each
    void fly(const glm::dvec3& way, double speed);  ///< right, up, forward; speed in diameters of the scene
    void frame(double aspect);                      ///< all of the scene, from the present side
    void lookFrom(double azimuthDeg, double elevationDeg, double aspect);
    void setPivot(const glm::dvec3& point);  ///< turns about it from now on; the eye keeps its distance

    /// Moves on by `seconds`; true while it has not arrived.
    bool advance(double seconds);
    bool moving() const { return moving_; }
    Pose pose() const;

private:
    /// Angles in radians; from the front, to the right and upwards.
    struct Orbit {
        glm::dvec3 focal{0.0};
        double azimuth = 0.0, elevation = 0.0, distance = 1.0;
    };
    static glm::dvec3 outward(const Orbit& orbit);
    void setFraming(double aspect);

    Orbit target_, present_;
    double viewAngle_ = 45.0;
    Bounds bounds_;
    bool adopted_ = false, moving_ = false;
};

}  // namespace lobe::view
