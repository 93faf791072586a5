#include "scene/sky.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "base/thread_team.hpp"
#include "shading/colour_matching.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

double luminance(const glm::dvec3& rgb) {
    return 0.2126729 * rgb.r + 0.7151522 * rgb.g + 0.0721750 * rgb.b;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Of the level ground below a sky, W/m^2: midpoints over the hemisphere by its projected area.
glm::dvec3 irradianceOf(const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    constexpr int kRings = 96, kAround = 192;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kRings; ++i) {
        const double sine2 = (i + 0.5) / kRings;
        const double sine = std::sqrt(sine2), cosine = std::sqrt(1.0 - sine2);
        for (int j = 0; j < kAround; ++j) {
            const double phi = 2.0 * kPi * (j + 0.5) / kAround;
            sum += radiance({sine * std::sin(phi), cosine, sine * std::cos(phi)});
        }
    }
    return sum * (kPi / (kRings * kAround));
}

}  // namespace

Sky defaultSky(SkyModel model) {
    Sky sky;
    sky.model = model;
    if (model != SkyModel::gradient) return sky;
    sky.zenith = {0.16, 0.33, 0.75};
    sky.horizon = {0.85, 0.92, 1.0};
    sky.ground = {0.12, 0.1, 0.08};
    return sky;
}

glm::dvec3 insideGamut(const glm::dvec3& rgb) {
    const double least = std::min({rgb.r, rgb.g, rgb.b});
    if (least >= 0.0) return rgb;
    const double grey = std::max(luminance(rgb), 0.0);
    const double share = grey / (grey - least);
    return glm::max(grey + share * (rgb - grey), glm::dvec3(0.0));
}

double SkyRadiance::Perez::at(double cosZenith, double cosGamma, double gamma) const {
    return (1.0 + c[0] * std::exp(c[1] / cosZenith)) *
           (1.0 + c[2] * std::exp(c[3] * gamma) + c[4] * cosGamma * cosGamma);
}

SkyRadiance::SkyRadiance(const Sky& sky) : sky_(sky) {
    if (sky.model != SkyModel::preetham) return;
    const double elevation = sky.sunElevation, azimuth = sky.sunAzimuth;
    toSun_ = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
              std::cos(elevation) * std::cos(azimuth)};
    sun_ = sunIrradiance(sky.turbidity, elevation);
    const double t = sky.turbidity, s = kPi / 2.0 - elevation, s2 = s * s, s3 = s2 * s;
    perez_[0].c = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                   -0.0033 * t + 0.0452};
    perez_[1].c = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                   -0.0109 * t + 0.0529};
    perez_[2].c = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                   -0.0670 * t + 0.3703};
    const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * s);
    const std::array<double, 3> zenith{
        (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) * t * t +
            (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) * t +
            (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886),
        (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) * t * t +
            (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) * t +
            (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688),
        1000.0 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192)};
    for (size_t i = 0; i < perez_.size(); ++i)
        perez_[i].zenith = zenith[i] / perez_[i].at(1.0, std::cos(s), s);
    onGround_ = irradianceOf([&](const glm::dvec3& d) { return above(d); }) + sun_ * std::sin(elevation);
}

glm::dvec3 SkyRadiance::above(const glm::dvec3& d) const {
    // exp(b / cos) is 0 on the horizon itself, as b is negative at every turbidity.
    const double cosine = std::max(d.y, 1e-6), gamma = angleBetween(d, toSun_), cosGamma = std::cos(gamma);
    const auto value = [&](size_t i) { return perez_[i].zenith * perez_[i].at(cosine, cosGamma, gamma); };
    const double x = value(0), y = value(1), light = std::max(value(2), 0.0);
    return insideGamut(
        shading::linearSrgb(glm::dvec3(x / y, 1.0, (1.0 - x - y) / y) * (light / kLumensPerWatt)));
}

glm::dvec3 SkyRadiance::at(const glm::dvec3& d) const {
    switch (sky_.model) {
        case SkyModel::constant:
            return sky_.zenith;
        case SkyModel::gradient:
            return glm::mix(sky_.horizon, d.y >= 0.0 ? sky_.zenith : sky_.ground,
                            std::min(std::abs(d.y), 1.0));
        case SkyModel::preetham:
            break;
    }
    return d.y >= 0.0 ? above(d) : sky_.ground * onGround_ / kPi;
}

Bitmap skyPicture(const SkyRadiance& sky, int height, double sunDiameter) {
    constexpr int kSunSub = 16;  ///< points along each side of a texel near the sun
    Bitmap picture;
    picture.width = 2 * height;
    picture.height = height;
    picture.channels = 3;
    picture.type = ComponentType::f32;
    // Of less than a texel no point might be seen: its light is then spread over one.
    const double texel = kPi / height, radius = sunDiameter > 0.0 ? std::max(sunDiameter, texel) / 2.0 : 0.0;
    const double half = std::sin(radius);
    const glm::dvec3 disc = radius > 0.0 ? sky.sun() / (kPi * half * half) : glm::dvec3(0.0);
    const auto rows = static_cast<size_t>(height), columns = static_cast<size_t>(picture.width);
    std::vector<float> values(rows * columns * 3);
    ThreadTeam().each(rows, [&](size_t y) {
        for (size_t x = 0; x < columns; ++x) {
            const auto direction = [&](double across, double down) {
                const double phi =
                    2.0 * kPi * (static_cast<double>(x) + across) / static_cast<double>(columns);
                const double theta = texel * (static_cast<double>(y) + down);
                return glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                  -std::sin(theta) * std::cos(phi));
            };
            const bool near =
                radius > 0.0 && angleBetween(direction(0.5, 0.5), sky.toSun()) < radius + 2.0 * texel;
            const int sub = near ? kSunSub : 1;
            glm::dvec3 sum(0.0);
            double weights = 0.0;  // by solid angle, which differs within texels at the zenith
            for (int j = 0; j < sub; ++j)
                for (int i = 0; i < sub; ++i) {
                    const glm::dvec3 d = direction((i + 0.5) / sub, (j + 0.5) / sub);
                    const double weight = std::hypot(d.x, d.z);
                    sum += weight * sky.at(d);
                    if (near && angleBetween(d, sky.toSun()) < radius) sum += weight * disc;
                    weights += weight;
                }
            for (size_t c = 0; c < 3; ++c)
                values[(y * columns + x) * 3 + c] = static_cast<float>(sum[static_cast<int>(c)] / weights);
        }
    });
    picture.data.resize(values.size() * sizeof(float));
    std::memcpy(picture.data.data(), values.data(), picture.data.size());
    return picture;
}

}  // namespace lobe
