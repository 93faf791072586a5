#include "environment/sun_in_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <numbers>
#include <set>

namespace lobe::environment {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRingFrom = 4.0 * kPi / 180.0, kRingTo = 8.0 * kPi / 180.0;

double brightness(const glm::dvec3& rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3.0;
}

glm::dvec3 directionOf(const EnvironmentMap& map, int x, int y) {
    const double theta = kPi * (y + 0.5) / map.height(), phi = 2.0 * kPi * (x + 0.5) / map.width();
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Integral over [from, to] of |sin| times the line with value 1 at `peak` that falls to 0 in `step`.
double underTent(double from, double to, double peak, double step) {
    const auto side = [&](double a, double b, double slope) {
        // (1 + slope (t - peak)) sin t
        const auto antiderivative = [&](double t) {
            return -(1.0 + slope * (t - peak)) * std::cos(t) + slope * std::sin(t);
        };
        return antiderivative(b) - antiderivative(a);
    };
    const auto part = [&](double a, double b) {
        double sum = 0.0;
        if (a < peak) sum += side(a, std::min(b, peak), 1.0 / step);
        if (b > peak) sum += side(std::max(a, peak), b, -1.0 / step);
        return sum;
    };
    double sum = part(std::max(from, 0.0), std::min(to, kPi));
    if (from < 0.0) sum -= part(from, 0.0);
    if (to > kPi) sum -= part(kPi, to);
    return sum;
}

struct Texel {
    int x, y;
    glm::dvec3 rgb;
};

Texel brightest(const EnvironmentMap& map) {
    Texel most{0, 0, map.at(0, 0)};
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x)
            if (const glm::dvec3 rgb = map.at(x, y); brightness(rgb) > brightness(most.rgb))
                most = {x, y, rgb};
    return most;
}

/// Calls for each texel whose row is within `angle` of the one at y.
template<class Action>
void forRowsNear(const EnvironmentMap& map, int y, double angle, Action action) {
    const int reach = static_cast<int>(std::ceil(angle / kPi * map.height())) + 1;
    for (int j = std::max(0, y - reach); j <= std::min(map.height() - 1, y + reach); ++j)
        for (int i = 0; i < map.width(); ++i)
            action(i, j);
}

glm::dvec3 ringAbout(const EnvironmentMap& map, const Texel& middle) {
    const glm::dvec3 axis = directionOf(map, middle.x, middle.y);
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    forRowsNear(map, middle.y, kRingTo, [&](int x, int y) {
        const double angle = angleBetween(axis, directionOf(map, x, y));
        if (angle < kRingFrom || angle > kRingTo) return;
        const double weight = solidAngleOf(map, y);
        sum += weight * map.at(x, y);
        weights += weight;
    });
    return weights > 0.0 ? sum / weights : glm::dvec3(0.0);
}

/// Connected texels above a threshold, over the seam and the poles.
std::vector<std::pair<int, int>> grown(const EnvironmentMap& map, const Texel& from, double threshold) {
    std::set<std::pair<int, int>> seen{{from.x, from.y}};
    std::deque<std::pair<int, int>> waiting{{from.x, from.y}};
    const size_t most = static_cast<size_t>(map.width()) * static_cast<size_t>(map.height()) / 4;
    while (!waiting.empty() && seen.size() < most) {
        const auto [x, y] = waiting.front();
        waiting.pop_front();
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                int nx = x + i, ny = y + j;
                if (ny < 0 || ny >= map.height()) {
                    ny = ny < 0 ? -1 - ny : 2 * map.height() - 1 - ny;
                    nx += map.width() / 2;
                }
                nx = (nx % map.width() + map.width()) % map.width();
                if (brightness(map.at(nx, ny)) > threshold && seen.insert({nx, ny}).second)
                    waiting.emplace_back(nx, ny);
            }
    }
    return {seen.begin(), seen.end()};
}

std::string rounded(double value) {
    std::string text = std::to_string(std::round(value * 10.0) / 10.0);
    return text.substr(0, text.find('.') + 2);
}

}  // namespace

double solidAngleOf(const EnvironmentMap& map, int y) {
    const double step = kPi / map.height(), middle = step * (y + 0.5);
    return underTent(middle - step, middle + step, middle, step) * 2.0 * kPi / map.width();
}

Spot brightestSpot(const EnvironmentMap& map) {
    Spot spot;
    if (map.constant() || map.height() < 4) return spot;
    const Texel peak = brightest(map);
    spot.surroundings = ringAbout(map, peak);
    const double level = brightness(spot.surroundings);
    if (!(brightness(peak.rgb) > kSpotContrast * level)) return spot;
    spot.contrast = level > 0.0 ? brightness(peak.rgb) / level : HUGE_VAL;
    spot.texels = grown(map, peak, kSpotContrast * level);
    double all = 0.0, own = 0.0;
    for (int y = 0; y < map.height(); ++y) {
        const double weight = solidAngleOf(map, y);
        for (int x = 0; x < map.width(); ++x)
            all += weight * brightness(map.at(x, y));
    }
    glm::dvec3 middle(0.0);
    std::array<glm::dvec3, 3> channels{};  // the light of each, as a vector
    for (const auto& [x, y] : spot.texels) {
        const glm::dvec3 excess = glm::max(map.at(x, y) - spot.surroundings, glm::dvec3(0.0));
        const double weight = solidAngleOf(map, y);
        const glm::dvec3 direction = directionOf(map, x, y);
        middle += weight * brightness(excess) * direction;
        for (int c = 0; c < 3; ++c)
            channels[static_cast<size_t>(c)] += weight * excess[c] * direction;
        own += weight * brightness(excess);
    }
    spot.share = own / all;
    spot.direction = glm::normalize(middle);
    for (int c = 0; c < 3; ++c)
        spot.irradiance[c] = std::max(glm::dot(channels[static_cast<size_t>(c)], spot.direction), 0.0);
    std::vector<std::pair<double, double>> parts;  // angle, light
    for (const auto& [x, y] : spot.texels) {
        const glm::dvec3 excess = glm::max(map.at(x, y) - spot.surroundings, glm::dvec3(0.0));
        parts.emplace_back(angleBetween(spot.direction, directionOf(map, x, y)),
                           solidAngleOf(map, y) * brightness(excess));
    }
    std::sort(parts.begin(), parts.end());
    const double texel = kPi / map.height();  // to where interpolation ends
    spot.radius = parts.back().first + texel;
    double sum = 0.0;
    for (const auto& [angle, light] : parts)
        if (sum < 0.9 * own) {
            sum += light;
            spot.core = angle + texel / 2.0;
        }
    return spot;
}

std::string whyNoSun(const Spot& spot) {
    if (spot.texels.empty()) return "no spot of it stands out";
    if (spot.core > kWidestSun)
        return "its brightest spot is " + rounded(2.0 * spot.core * 180.0 / kPi) +
               " degrees wide, more than a sun's " + rounded(2.0 * kWidestSun * 180.0 / kPi);
    if (spot.contrast < kLeastContrast)
        return "its brightest spot is " + rounded(spot.contrast) +
               " times as bright as what is around it, less than " + rounded(kLeastContrast) + " times";
    if (spot.share < kLeastShare)
        return "its brightest spot gives " + rounded(100.0 * spot.share) + " % of its light, less than " +
               rounded(100.0 * kLeastShare) + " %";
    return {};
}

Bitmap withoutSpot(const EnvironmentMap& map, const Spot& spot) {
    Bitmap picture;
    picture.width = map.width();
    picture.height = map.height();
    picture.channels = 3;
    picture.type = ComponentType::f32;
    std::vector<float> values;
    values.reserve(static_cast<size_t>(map.width()) * static_cast<size_t>(map.height()) * 3);
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x) {
            const glm::dvec3 rgb = map.at(x, y);
            for (int c = 0; c < 3; ++c)
                values.push_back(static_cast<float>(rgb[c]));
        }
    for (const auto& [x, y] : spot.texels)
        for (int c = 0; c < 3; ++c) {
            float& value =
                values[(static_cast<size_t>(y) * static_cast<size_t>(map.width()) + static_cast<size_t>(x)) *
                           3 +
                       static_cast<size_t>(c)];
            value = std::min(value, static_cast<float>(spot.surroundings[c]));
        }
    picture.data.resize(values.size() * sizeof(float));
    std::memcpy(picture.data.data(), values.data(), picture.data.size());
    return picture;
}

}  // namespace lobe::environment
