/// Pictures of environments for tests.
#pragma once

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "environment/environment_map.hpp"

namespace lobe::test {

/// A float picture whose texels are f(x, y).
template<class Function>
Bitmap floatPicture(int width, int height, Function f) {
    Bitmap bitmap;
    bitmap.width = width;
    bitmap.height = height;
    bitmap.channels = 3;
    bitmap.type = ComponentType::f32;
    std::vector<glm::vec3> texels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            texels.push_back(f(x, y));
    bitmap.data.resize(texels.size() * sizeof(glm::vec3));
    std::memcpy(bitmap.data.data(), texels.data(), bitmap.data.size());
    return bitmap;
}

/// Whose texels are f(direction of their centre).
template<class Function>
Bitmap directionPicture(int width, int height, Function f) {
    return floatPicture(width, height, [&](int x, int y) {
        constexpr double kPi = std::numbers::pi;
        const double phi = 2.0 * kPi * (x + 0.5) / width, theta = kPi * (y + 0.5) / height;
        return f(
            glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)));
    });
}

inline EnvironmentMap mapOf(const Bitmap& bitmap) {
    Environment environment;
    environment.image = 0;
    return {environment, &bitmap};
}

/// A dim sky over a dark ground, and two lamps.
inline glm::vec3 skyWithLamps(const glm::dvec3& d) {
    const glm::dvec3 lamp = glm::normalize(glm::dvec3(0.6, 0.5, 0.7)),
                     other = glm::normalize(glm::dvec3(-0.8, 0.2, 0.1));
    glm::dvec3 light =
        d.y > 0.0 ? glm::dvec3(0.4, 0.5, 0.7) * (0.4 + 0.6 * d.y) : glm::dvec3(0.15, 0.12, 0.1);
    if (glm::dot(d, lamp) > 0.97) light += glm::dvec3(9.0, 8.0, 6.0);
    if (glm::dot(d, other) > 0.95) light += glm::dvec3(2.0, 2.5, 4.0);
    return light;
}

}  // namespace lobe::test
