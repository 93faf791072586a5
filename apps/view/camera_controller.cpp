#include "camera_controller.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/camera.hpp"

namespace lobe::view {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kSteepest = 89.9 / kDegrees;
constexpr double kTurnOfHeight = std::numbers::pi;  ///< radians that a drag over the picture's height turns
constexpr double kSettle = 0.06;                    ///< seconds in which two thirds of a way are gone
constexpr double kArrived = 1e-3;                   ///< of distance, and radians

}  // namespace

glm::dvec3 CameraController::outward(const Orbit& orbit) {
    return {std::sin(orbit.azimuth) * std::cos(orbit.elevation), std::sin(orbit.elevation),
            std::cos(orbit.azimuth) * std::cos(orbit.elevation)};
}

void CameraController::adopt(const Camera& camera, const Bounds& bounds) {
    const glm::dvec3 eye(camera.worldFromCamera[3]);
    const glm::dvec3 forward = -glm::dvec3(camera.worldFromCamera[2]);
    const double radius = bounds.radius() > 0.0 ? bounds.radius() : 1.0;
    const double depth = glm::dot(bounds.center() - eye, forward);
    Pose pose;
    pose.position = eye;
    pose.focal = eye + forward * std::max(depth, 0.1 * radius);
    pose.viewAngle = camera.orthographic ? 45.0 : camera.verticalFov * kDegrees;
    if (camera.orthographic)  // as large at the pivot
        pose.position = pose.focal - forward * (camera.yMag / std::tan(0.5 * pose.viewAngle / kDegrees));
    adopt(pose, bounds);
}

void CameraController::adopt(const Pose& pose, const Bounds& bounds) {
    bounds_ = bounds;
    viewAngle_ = std::clamp(pose.viewAngle, 0.01, 179.0);
    const glm::dvec3 offset = pose.position - pose.focal;
    target_.focal = pose.focal;
    target_.distance = std::max(glm::length(offset), 1e-9);
    const glm::dvec3 direction = offset / target_.distance;
    target_.elevation = std::asin(std::clamp(direction.y, -1.0, 1.0));
    target_.azimuth = std::atan2(direction.x, direction.z);
    present_ = target_;
    adopted_ = true;
    moving_ = false;
}

void CameraController::orbit(double dx, double dy, double height) {
    target_.azimuth -= dx / height * kTurnOfHeight;
    target_.elevation = std::clamp(target_.elevation + dy / height * kTurnOfHeight, -kSteepest, kSteepest);
    moving_ = true;
}

void CameraController::pan(double dx, double dy, double height) {
    const glm::dvec3 out = outward(target_);
    const glm::dvec3 right(std::cos(target_.azimuth), 0.0, -std::sin(target_.azimuth));
    const glm::dvec3 up = glm::cross(out, right);
    const double metres = 2.0 * target_.distance * std::tan(0.5 * viewAngle_ / kDegrees) / height;
    target_.focal += (-right * dx + up * dy) * metres;
    moving_ = true;
}

void CameraController::dolly(double steps) {
    const double radius = bounds_.radius() > 0.0 ? bounds_.radius() : 1.0;
    target_.distance = std::clamp(target_.distance * std::pow(0.9, steps), 1e-4 * radius, 1e4 * radius);
    moving_ = true;
}

void CameraController::fly(const glm::dvec3& way, double speed) {
    const glm::dvec3 out = outward(target_);
    const glm::dvec3 right(std::cos(target_.azimuth), 0.0, -std::sin(target_.azimuth));
    const double metres = speed * 2.0 * (bounds_.radius() > 0.0 ? bounds_.radius() : 1.0);
    target_.focal += (right * way.x + glm::dvec3(0.0, way.y, 0.0) - out * way.z) * metres;
    moving_ = true;
}

void CameraController::setFraming(double aspect) {
    Framing framing;
    framing.azimuthDeg = target_.azimuth * kDegrees;
    framing.elevationDeg = target_.elevation * kDegrees;
    framing.verticalFov = viewAngle_ / kDegrees;
    const Camera camera = framingCamera(bounds_, aspect, framing);
    target_.focal = bounds_.center();
    target_.distance = glm::length(glm::dvec3(camera.worldFromCamera[3]) - target_.focal);
    moving_ = true;
}

void CameraController::frame(double aspect) {
    setFraming(aspect);
}

void CameraController::lookFrom(double azimuthDeg, double elevationDeg, double aspect) {
    target_.azimuth = azimuthDeg / kDegrees;
    target_.elevation = std::clamp(elevationDeg / kDegrees, -kSteepest, kSteepest);
    // The shorter way round.
    const double turns = std::round((present_.azimuth - target_.azimuth) / (2.0 * std::numbers::pi));
    target_.azimuth += turns * 2.0 * std::numbers::pi;
    setFraming(aspect);
}

void CameraController::setPivot(const glm::dvec3& point) {
    target_.focal = point;
    moving_ = true;
}

bool CameraController::advance(double seconds) {
    if (!moving_) return false;
    const double share = 1.0 - std::exp(-std::max(seconds, 0.0) / kSettle);
    present_.focal += (target_.focal - present_.focal) * share;
    present_.azimuth += (target_.azimuth - present_.azimuth) * share;
    present_.elevation += (target_.elevation - present_.elevation) * share;
    present_.distance *= std::pow(target_.distance / present_.distance, share);
    const bool arrived = glm::length(target_.focal - present_.focal) < kArrived * target_.distance &&
                         std::abs(target_.azimuth - present_.azimuth) < kArrived &&
                         std::abs(target_.elevation - present_.elevation) < kArrived &&
                         std::abs(target_.distance / present_.distance - 1.0) < kArrived;
    if (arrived) {
        present_ = target_;
        moving_ = false;
    }
    return moving_;
}

Pose CameraController::pose() const {
    return {present_.focal + outward(present_) * present_.distance, present_.focal, viewAngle_};
}

}  // namespace lobe::view
