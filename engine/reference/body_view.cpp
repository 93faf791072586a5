#include "reference/body_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/sphere.hpp"

namespace lobe::reference {
namespace {

constexpr double kPi = std::numbers::pi;
/// Below this solid angle a rect's corners' angles cancel: its area is sampled instead, which is smooth
/// there.
constexpr double kTinySolidAngle = 1e-3;

double square(double x) {
    return x * x;
}

/// Angle between unit vectors' planes, accurate near 0 and pi.
double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

BodyView::BodyView(const Light& light, const glm::dvec3& point) : light_(light), point_(point) {
    switch (light.type) {
        case LightType::rect:
            viewRect();
            break;
        case LightType::disk:
            viewDisk();
            break;
        case LightType::sphere:
            viewSphere(light.position, light.radius);
            break;
        case LightType::tube:
            viewTube();
            break;
        default:
            break;
    }
}

BodySample BodyView::at(int patch, double u, double v) const {
    if (inside_ || light_.type == LightType::sphere) {
        const double polar = u * polarRange_;
        return sphereAt(polar, v, 2.0 * kPi * polarRange_ * std::sin(polar));
    }
    switch (light_.type) {
        case LightType::rect:
            return rectAt(u, v);
        case LightType::disk:
            return diskAt(u, v);
        default:
            return patch == 0 ? cylinderAt(u, v) : capAt(patch, u, v);
    }
}

BodySample BodyView::draw(double u, double v, double w) const {
    if (inside_ || light_.type == LightType::sphere) {
        const double half = std::sin(polarRange_ / 2);
        return sphereAt(2.0 * std::asin(std::sqrt(u) * half), v, 4.0 * kPi * half * half);
    }
    switch (light_.type) {
        case LightType::rect:
            return rectAt(u, v);
        case LightType::disk: {
            const double r = light_.radius * std::sqrt(u), phi = 2.0 * kPi * v;
            return towards(center_ + glm::dvec3(r * std::cos(phi), r * std::sin(phi), 0.0), {0.0, 0.0, 1.0},
                           kPi * square(light_.radius));
        }
        default: {
            const double total = areas_[0] + areas_[1] + areas_[2];
            double left = w * total;
            int patch = 0;
            while (patch < 2 && left >= areas_[static_cast<size_t>(patch)])
                left -= areas_[static_cast<size_t>(patch++)];
            if (areas_[static_cast<size_t>(patch)] == 0.0) patch = 1;
            glm::dvec3 normal, target;
            if (patch == 0) {
                const double phi = arcCenter_ + (2.0 * v - 1.0) * arc_;
                normal = {std::cos(phi), std::sin(phi), 0.0};
                target = center_ + light_.radius * normal + glm::dvec3(0, 0, (u - 0.5) * light_.length);
            } else {
                const double side = patch == 1 ? 1.0 : -1.0, phi = 2.0 * kPi * v;
                const double s = std::sqrt(std::max(0.0, 1.0 - u * u));
                normal = {s * std::cos(phi), s * std::sin(phi), side * u};
                target = center_ + light_.radius * normal + glm::dvec3(0, 0, side * 0.5 * light_.length);
            }
            return towards(target, normal, total);
        }
    }
}

double BodyView::density(const glm::dvec3& direction) const {
    const auto distance = distanceAlong(direction);
    if (!distance || patches_ == 0) return 0.0;
    if (inside_ || light_.type == LightType::sphere)
        return 1.0 / (4.0 * kPi * square(std::sin(polarRange_ / 2)));
    if (light_.type == LightType::rect && spherical_) return 1.0 / solidAngle_;
    if (light_.type == LightType::tube) {
        const auto hit = tubeHit(direction);
        return hit ? surfaceDensity(direction, hit->distance, hit->normal, areas_[0] + areas_[1] + areas_[2])
                   : 0.0;
    }
    const double area =
        light_.type == LightType::rect ? light_.width * light_.height : kPi * square(light_.radius);
    return surfaceDensity(direction, *distance, light_.direction, area);
}

std::optional<double> BodyView::distanceAlong(const glm::dvec3& direction) const {
    if (light_.type == LightType::tube) {
        const auto hit = tubeHit(direction);
        return hit ? std::optional(hit->distance) : std::nullopt;
    }
    if (light_.type == LightType::sphere) {
        const double distance = center_.z;
        const double along = glm::dot(direction, world({0, 0, 1})) * distance;
        const double root = square(light_.radius) - (square(distance) - square(along));
        if (root < 0.0 || (!inside_ && along < 0.0)) return std::nullopt;
        return std::max(0.0, inside_ ? along + std::sqrt(root) : along - std::sqrt(root));
    }
    const double facing = -glm::dot(direction, light_.direction);
    const glm::dvec3 toCenter = light_.position - point_;
    const double t = -glm::dot(toCenter, light_.direction) / facing;
    if (!(facing > 0.0) || !(t > 0.0)) return std::nullopt;
    const glm::dvec3 offset = glm::transpose(frame_) * (t * direction - toCenter);
    const bool hit = light_.type == LightType::rect
                         ? std::abs(offset.x) <= light_.width / 2 && std::abs(offset.y) <= light_.height / 2
                         : square(offset.x) + square(offset.y) <= square(light_.radius);
    return hit ? std::optional(t) : std::nullopt;
}

BodySample BodyView::towards(const glm::dvec3& target, const glm::dvec3& normal, double area) const {
    BodySample sample;
    sample.distance = glm::length(target);
    if (!(sample.distance > 0.0)) return {};
    const glm::dvec3 direction = target / sample.distance;
    const double facing = -glm::dot(direction, normal);
    sample.direction = world(direction);
    sample.solidAngle = facing > 0.0 ? area * facing / square(sample.distance) : 0.0;
    return sample;
}

double BodyView::surfaceDensity(const glm::dvec3& direction, double distance, const glm::dvec3& normal,
                                double area) const {
    const double facing = -glm::dot(direction, normal);
    return facing > 0.0 ? square(distance) / (area * facing) : 0.0;
}

void BodyView::viewRect() {
    const glm::dvec3 z = light_.direction;
    frame_ = glm::dmat3(light_.axis, glm::cross(z, light_.axis), z);
    center_ = glm::transpose(frame_) * (light_.position - point_);
    if (!(center_.z < 0.0)) return;  // behind, or in its plane
    patches_ = 1;
    const double x0 = center_.x - light_.width / 2, x1 = center_.x + light_.width / 2;
    const double y0 = center_.y - light_.height / 2, y1 = center_.y + light_.height / 2;
    const double z0 = center_.z;
    angularRadius_ = std::asin(std::min(
        1.0, 0.5 * std::hypot(light_.width, light_.height) / std::max(glm::length(center_), 1e-300)));
    const auto normalOf = [](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::normalize(glm::cross(a, b));
    };
    const glm::dvec3 c00(x0, y0, z0), c10(x1, y0, z0), c11(x1, y1, z0), c01(x0, y1, z0);
    const glm::dvec3 n0 = normalOf(c00, c10), n1 = normalOf(c10, c11), n2 = normalOf(c11, c01),
                     n3 = normalOf(c01, c00);
    const double g0 = angleBetween(-n0, n1), g1 = angleBetween(-n1, n2), g2 = angleBetween(-n2, n3),
                 g3 = angleBetween(-n3, n0);
    b0_ = n0.z;
    b1_ = n2.z;
    k_ = 2.0 * kPi - g2 - g3;
    solidAngle_ = g0 + g1 - k_;
    spherical_ = solidAngle_ > kTinySolidAngle;
}

BodySample BodyView::rectAt(double u, double v) const {
    if (!spherical_)
        return towards(center_ + glm::dvec3((u - 0.5) * light_.width, (v - 0.5) * light_.height, 0.0),
                       {0.0, 0.0, 1.0}, light_.width * light_.height);
    const double x0 = center_.x - light_.width / 2, x1 = center_.x + light_.width / 2;
    const double y0 = center_.y - light_.height / 2, y1 = center_.y + light_.height / 2;
    const double z0 = center_.z;
    const double angle = u * solidAngle_ + k_;
    const double fu = (std::cos(angle) * b0_ - b1_) / std::sin(angle);
    const double cu = std::clamp(std::copysign(1.0, fu) / std::sqrt(fu * fu + b0_ * b0_), -1.0, 1.0);
    const double x = std::clamp(-(cu * z0) / std::sqrt(std::max(1.0 - cu * cu, 1e-300)), x0, x1);
    const double d = std::sqrt(x * x + z0 * z0);
    const double h0 = y0 / std::sqrt(d * d + y0 * y0), h1 = y1 / std::sqrt(d * d + y1 * y1);
    const double h = h0 + v * (h1 - h0);
    const double y = std::clamp(h * d / std::sqrt(std::max(1.0 - h * h, 1e-300)), y0, y1);
    const glm::dvec3 target(x, y, z0);
    const double distance = glm::length(target);
    return {world(target / distance), distance, solidAngle_};
}

void BodyView::viewDisk() {
    const glm::dvec3 z = light_.direction;
    frame_ = glm::dmat3(light_.axis, glm::cross(z, light_.axis), z);
    center_ = glm::transpose(frame_) * (light_.position - point_);
    if (!(center_.z < 0.0)) return;
    patches_ = 1;
    height_ = -center_.z;
    offset_ = std::hypot(center_.x, center_.y);
    azimuth_ = std::atan2(center_.y, center_.x);
    azimuthRange_ = offset_ > light_.radius ? std::asin(light_.radius / offset_) : kPi;
    angularRadius_ = std::asin(std::min(1.0, light_.radius / glm::length(center_)));
}

/// Polar coordinates about the foot of the perpendicular: in them nothing peaks, however near the disk is.
BodySample BodyView::diskAt(double u, double v) const {
    const double r = light_.radius;
    double phi, phiRate, near = 0.0, far;
    if (offset_ > r) {
        // By the sine, as the chord's ends have square roots at the tangents.
        const double t = kPi * (v - 0.5);
        phi = azimuthRange_ * std::sin(t);
        phiRate = azimuthRange_ * kPi * std::cos(t);
        const double middle = offset_ * std::cos(phi);
        const double chord =
            std::sqrt(std::max(0.0, (r - offset_ * std::sin(phi)) * (r + offset_ * std::sin(phi))));
        far = middle + chord;
        near = (offset_ - r) * (offset_ + r) / far;
    } else {
        phi = 2.0 * kPi * v;
        phiRate = 2.0 * kPi;
        const double s = offset_ * std::sin(phi);
        far = offset_ * std::cos(phi) + std::sqrt(std::max(0.0, r * r - s * s));
    }
    const double start = std::atan2(near, height_);
    const double range = std::atan2(height_ * (far - near), square(height_) + near * far);
    const double polar = start + u * range;
    const double s = std::sin(polar), c = std::cos(polar);
    const double azimuth = azimuth_ + phi;
    return {world({s * std::cos(azimuth), s * std::sin(azimuth), -c}), height_ / std::max(c, 1e-300),
            phiRate * range * s};
}

void BodyView::viewSphere(const glm::dvec3& center, double radius) {
    const glm::dvec3 toCenter = center - point_;
    const double distance = glm::length(toCenter);
    inside_ = distance <= radius;
    patches_ = 1;
    frame_ = distance > 0.0 ? frameAbout(toCenter / distance) : glm::dmat3(1.0);
    center_ = {0.0, 0.0, distance};
    polarRange_ = inside_ ? kPi : std::asin(radius / distance);
    angularRadius_ = polarRange_;
}

BodySample BodyView::sphereAt(double polar, double v, double solidAngle) const {
    const double distance = center_.z, s = std::sin(polar), phi = 2.0 * kPi * v;
    BodySample sample{world({s * std::cos(phi), s * std::sin(phi), std::cos(polar)}), 0.0, solidAngle};
    if (light_.type == LightType::tube) {
        sample.distance = distanceAlong(sample.direction).value_or(0.0);
        return sample;
    }
    const double root =
        std::sqrt(std::max(0.0, (light_.radius - distance * s) * (light_.radius + distance * s)));
    sample.distance = std::max(0.0, distance * std::cos(polar) + (inside_ ? root : -root));
    return sample;
}

void BodyView::viewTube() {
    const glm::dvec3 toCenter = light_.position - point_;
    const double along = -glm::dot(toCenter, light_.axis);  // of the point, from the centre
    const double nearest = std::clamp(along, -light_.length / 2, light_.length / 2);
    const glm::dvec3 onAxis = toCenter + nearest * light_.axis;
    if (glm::length(onAxis) <= light_.radius) {
        viewSphere(light_.position, glm::length(toCenter) + light_.radius);
        frame_ = frameAbout(light_.axis);
        return;
    }
    frame_ = frameAbout(light_.axis);
    center_ = glm::transpose(frame_) * toCenter;
    const double off = std::hypot(center_.x, center_.y);
    arc_ = off > light_.radius ? std::acos(light_.radius / off) : 0.0;
    arcCenter_ = std::atan2(-center_.y, -center_.x);
    patches_ = 3;
    const double cap = 2.0 * kPi * square(light_.radius);
    areas_ = {2.0 * arc_ * light_.radius * light_.length, cap, cap};
    const double reach = light_.length / 2 + light_.radius, distance = glm::length(toCenter);
    angularRadius_ = distance > reach ? std::asin(reach / distance) : kPi / 2;
}

BodySample BodyView::cylinderAt(double u, double v) const {
    if (arc_ == 0.0 || light_.length == 0.0) return {};
    const double phi = arcCenter_ + (2.0 * v - 1.0) * arc_;
    const glm::dvec3 normal(std::cos(phi), std::sin(phi), 0.0);
    // Equiangular about the nearest place: the inverse square would peak there.
    const double h = std::hypot(center_.x, center_.y) - light_.radius;
    const double z0 = -center_.z;  // the point, from the centre, along the axis
    const double low = std::atan((-light_.length / 2 - z0) / h),
                 high = std::atan((light_.length / 2 - z0) / h);
    const double t = low + u * (high - low);
    const double z = z0 + h * std::tan(t);
    const double rate = h * (high - low) * (1.0 + square(std::tan(t)));
    return towards(center_ + light_.radius * normal + glm::dvec3(0, 0, z), normal,
                   2.0 * arc_ * light_.radius * rate);
}

BodySample BodyView::capAt(int side, double u, double v) const {
    const double sign = side == 1 ? 1.0 : -1.0, polar = u * kPi / 2, phi = 2.0 * kPi * v;
    const glm::dvec3 normal(std::sin(polar) * std::cos(phi), std::sin(polar) * std::sin(phi),
                            sign * std::cos(polar));
    return towards(center_ + light_.radius * normal + glm::dvec3(0, 0, sign * light_.length / 2), normal,
                   square(light_.radius * kPi) * std::sin(polar));
}

std::optional<BodyView::Hit> BodyView::tubeHit(const glm::dvec3& direction) const {
    const glm::dmat3 local = glm::transpose(frame_);
    const glm::dvec3 d = local * direction, origin = local * (point_ - light_.position);
    std::optional<Hit> best;
    const auto offer = [&](double t, const glm::dvec3& normal, int patch) {
        if (t >= 0.0 && (!best || (inside_ ? t > best->distance : t < best->distance)))
            best = Hit{t, world(normal), patch};
    };
    const double r = light_.radius, half = light_.length / 2;
    const double across = d.x * d.x + d.y * d.y;
    if (across > 0.0) {
        const double b = (origin.x * d.x + origin.y * d.y) / across;
        const glm::dvec2 foot(origin.x - b * d.x, origin.y - b * d.y);
        const double root = (r * r - glm::dot(foot, foot)) / across;
        if (root >= 0.0)
            for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)}) {
                const glm::dvec3 hit = origin + t * d;
                if (std::abs(hit.z) <= half) offer(t, {hit.x / r, hit.y / r, 0.0}, 0);
            }
    }
    for (const double sign : {1.0, -1.0}) {
        const glm::dvec3 o = origin - glm::dvec3(0, 0, sign * half);
        const double b = glm::dot(o, d);
        const glm::dvec3 foot = o - b * d;
        const double root = r * r - glm::dot(foot, foot);
        if (root >= 0.0)
            for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)}) {
                const glm::dvec3 normal = (o + t * d) / r;
                if (normal.z * sign >= 0.0) offer(t, normal, sign > 0 ? 1 : 2);
            }
    }
    return best;
}

}  // namespace lobe::reference
