#include "scene/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

glm::dvec3 column(const glm::dmat4& matrix, int index) {
    return glm::dvec3(matrix[index]);
}

/// Half extents of the picture plane: at distance 1 for a perspective camera, in metres for an orthographic
/// one.
glm::dvec2 halfExtents(const Camera& camera, double pictureAspect) {
    const double height = camera.orthographic ? camera.yMag : std::tan(camera.verticalFov * 0.5);
    const double width = camera.orthographic ? camera.xMag : height * camera.aspect.value_or(pictureAspect);
    // The file's window stays visible whole; a picture of another shape shows more of one side.
    if (width / height > pictureAspect) return {width, width / pictureAspect};
    return {height * pictureAspect, height};
}

}  // namespace

Camera lookAt(const glm::dvec3& position, const glm::dvec3& focalPoint, double verticalFov) {
    const glm::dvec3 offset = focalPoint - position;
    if (!(glm::length(offset) > 0.0))
        throw UsageError("camera position and focal point are the same point; expected two different ones");
    const glm::dvec3 forward = glm::normalize(offset);
    const glm::dvec3 up = std::abs(forward.y) > 0.999999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    Camera camera;
    camera.worldFromCamera = glm::inverse(glm::lookAt(glm::dvec3(0.0), forward, up));
    camera.worldFromCamera[3] = glm::dvec4(position, 1.0);
    camera.verticalFov = verticalFov;
    return camera;
}

Camera framingCamera(const Bounds& bounds, double aspect, const Framing& framing) {
    const double azimuth = framing.azimuthDeg * kRadians;
    const double elevation = framing.elevationDeg * kRadians;
    const glm::dvec3 direction(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                               std::cos(azimuth) * std::cos(elevation));
    const glm::dvec3 center = bounds.center();
    Camera camera = lookAt(center + direction, center, framing.verticalFov);
    camera.name = "framing";

    const glm::dvec2 tangent(std::tan(framing.verticalFov * 0.5) * aspect,
                             std::tan(framing.verticalFov * 0.5));
    double distance = 0.0;
    if (framing.fit == Fit::sphere || !(bounds.radius() > 0.0)) {
        const double radius = bounds.radius() > 0.0 ? bounds.radius() : 1.0;
        distance = radius / std::sin(std::atan(std::min(tangent.x, tangent.y)));
    } else {
        const glm::dmat3 cameraFromWorld = glm::transpose(glm::dmat3(camera.worldFromCamera));
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                                   (corner & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                                   (corner & 4) != 0 ? bounds.upper.z : bounds.lower.z);
            const glm::dvec3 p = cameraFromWorld * (point - center);
            distance = std::max(distance,
                                p.z + 1.05 * std::max(std::abs(p.x) / tangent.x, std::abs(p.y) / tangent.y));
        }
    }
    camera.worldFromCamera[3] = glm::dvec4(center + direction * distance, 1.0);
    fitDepthRange(camera, bounds);
    return camera;
}

Camera orbited(const Camera& camera, const glm::dvec3& pivot, double azimuthDeg) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), azimuthDeg * kRadians, glm::dvec3(0, 1, 0));
    Camera result = camera;
    const glm::dvec3 eye = column(camera.worldFromCamera, 3);
    result.worldFromCamera = turn * camera.worldFromCamera;
    result.worldFromCamera[3] = glm::dvec4(pivot + glm::dvec3(turn * glm::dvec4(eye - pivot, 0.0)), 1.0);
    return result;
}

void fitDepthRange(Camera& camera, const Bounds& bounds) {
    const double radius = bounds.radius() > 0.0 ? bounds.radius() : 1.0;
    const glm::dvec3 eye = column(camera.worldFromCamera, 3);
    const glm::dvec3 forward = -column(camera.worldFromCamera, 2);
    const double center = glm::dot(bounds.center() - eye, forward);
    // Reversed float depth is as exact near as far, so the near plane may be close: only what is in front is
    // kept.
    camera.zNear = std::max((center - radius) * 0.5, radius * 1e-4);
    if (camera.orthographic)
        camera.zFar = std::max(center + radius * 1.01, camera.zNear * 2.0);
    else
        camera.zFar.reset();
}

const Camera& findCamera(const Scene& scene, const std::string& nameOrIndex) {
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == nameOrIndex) return camera;
        names.push_back(camera.name);
    }
    const bool isNumber =
        !nameOrIndex.empty() && nameOrIndex.size() < 6 &&
        std::all_of(nameOrIndex.begin(), nameOrIndex.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (isNumber && std::stoul(nameOrIndex) < scene.cameras.size())
        return scene.cameras[std::stoul(nameOrIndex)];
    std::string list;
    for (size_t i = 0; i < names.size(); ++i)
        list += (i ? ", " : "") + std::to_string(i) + " '" + names[i] + "'";
    throw UsageError(scene.file + ": camera '" + nameOrIndex + "' not found; the scene has " +
                     (names.empty() ? "no camera" : list) + didYouMean(nameOrIndex, names));
}

View makeView(const Camera& camera, int width, int height, glm::dvec2 jitter) {
    const glm::dvec2 extent = halfExtents(camera, static_cast<double>(width) / height);
    const glm::dmat3 worldFromCamera(camera.worldFromCamera);
    const glm::dvec3 right = worldFromCamera[0];
    const glm::dvec3 up = worldFromCamera[1];
    const double near = camera.zNear;

    View view{};
    view.eye = column(camera.worldFromCamera, 3);
    view.forward = -worldFromCamera[2];
    view.orthographic = camera.orthographic;
    view.width = width;
    view.height = height;

    glm::dmat4 projection(0.0);
    projection[0][0] = 1.0 / extent.x;
    projection[1][1] = 1.0 / extent.y;
    if (camera.orthographic) {
        const double far = camera.zFar.value();
        projection[2][2] = 1.0 / (far - near);
        projection[3][2] = far / (far - near);
        projection[3][3] = 1.0;
        view.depthToZ = {far, -(far - near), 1.0, 0.0};
    } else if (camera.zFar) {
        const double far = *camera.zFar;
        projection[2][2] = near / (far - near);
        projection[3][2] = near * far / (far - near);
        projection[2][3] = -1.0;
        view.depthToZ = {near * far, 0.0, near, far - near};
    } else {
        projection[3][2] = near;
        projection[2][3] = -1.0;
        view.depthToZ = {near, 0.0, 0.0, 1.0};
    }
    glm::dmat4 shift(1.0);
    shift[3][0] = -2.0 * jitter.x / width;
    shift[3][1] = -2.0 * jitter.y / height;
    view.clipFromRelative = shift * projection * glm::dmat4(glm::transpose(worldFromCamera));

    const glm::dvec3 dx = right * (2.0 * extent.x / width);
    const glm::dvec3 dy = up * (2.0 * extent.y / height);
    const glm::dvec3 corner = dx * (jitter.x - 0.5 * width) + dy * (jitter.y - 0.5 * height);
    if (camera.orthographic) {
        view.rayOrigin = corner;
        view.rayOriginDx = dx;
        view.rayOriginDy = dy;
        view.rayDirection = view.forward;
        view.rayDirectionDx = view.rayDirectionDy = glm::dvec3(0.0);
    } else {
        view.rayOrigin = view.rayOriginDx = view.rayOriginDy = glm::dvec3(0.0);
        view.rayDirection = view.forward + corner;
        view.rayDirectionDx = dx;
        view.rayDirectionDy = dy;
    }
    return view;
}

}  // namespace lobe
