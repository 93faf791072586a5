#include "environment_pictures.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>

#include "base/error.hpp"
#include "environment/environment_map.hpp"
#include "image/image_files.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "scene/made_environment.hpp"
#include "scene/sky.hpp"

namespace lobe::bench {
namespace {

Bitmap pictureOf(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    Bitmap bitmap;
    bitmap.width = width;
    bitmap.height = height;
    bitmap.channels = 3;
    bitmap.type = ComponentType::f32;
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double theta = std::numbers::pi * (y + 0.5) / height;
            const double phi = 2.0 * std::numbers::pi * (x + 0.5) / width;
            const glm::dvec3 light = radiance(
                {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
            for (int c = 0; c < 3; ++c)
                values.push_back(static_cast<float>(light[c]));
        }
    bitmap.data.resize(values.size() * sizeof(float));
    std::memcpy(bitmap.data.data(), values.data(), bitmap.data.size());
    return bitmap;
}

/// 1 within `radius` (rad) of an axis, falling to 0 over half of it.
double spot(const glm::dvec3& d, const glm::dvec3& axis, double radius) {
    const double angle = std::atan2(glm::length(glm::cross(d, axis)), glm::dot(d, axis));
    return std::clamp((1.5 * radius - angle) / (0.5 * radius), 0.0, 1.0);
}

glm::dvec3 studio(const glm::dvec3& d) {
    const glm::dvec3 key = glm::normalize(glm::dvec3(0.7, 0.6, 0.5)),
                     fill = glm::normalize(glm::dvec3(-0.9, 0.3, 0.2));
    return glm::dvec3(0.25 + 0.15 * d.y) + glm::dvec3(6.0, 5.8, 5.4) * spot(d, key, 0.45) +
           glm::dvec3(1.6, 1.8, 2.2) * spot(d, fill, 0.6);
}

Bitmap sunny() {
    Sky sky;
    sky.sunElevation = 0.6;
    sky.sunAzimuth = 0.8;
    return skyPicture(SkyRadiance(sky), 512, kSunDiameter);
}

Bitmap night() {
    struct Lamp {
        glm::dvec3 axis, light;
    };
    Pcg32 random(7);
    std::vector<Lamp> lamps;
    for (int i = 0; i < 40; ++i) {
        glm::dvec3 axis = uniformSphere({random.uniform(), random.uniform()});
        axis.y = 0.3 * axis.y + 0.1;
        lamps.push_back({glm::normalize(axis), glm::dvec3(1.0, 0.8, 0.5) * random.logUniform(5.0, 200.0)});
    }
    return pictureOf(1024, 512, [&](const glm::dvec3& d) {
        glm::dvec3 sum(0.01, 0.012, 0.02);
        for (const Lamp& lamp : lamps)
            sum += lamp.light * spot(d, lamp.axis, 0.012);
        return sum;
    });
}

}  // namespace

std::vector<Panorama> panoramasOf(const std::vector<std::string>& files) {
    if (files.empty())
        return {{"soft studio", pictureOf(1024, 512, studio)}, {"sun", sunny()}, {"night", night()}};
    std::vector<Panorama> panoramas;
    ImageFiles decoder;
    for (const std::string& file : files) {
        std::ifstream stream(file, std::ios::binary);
        if (!stream) throw InputError(file + ": cannot be read; expected a picture of an environment");
        const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)),
                                      std::istreambuf_iterator<char>());
        panoramas.push_back({std::filesystem::path(file).stem().string(),
                             decoder.decode(std::as_bytes(std::span(bytes)), file)});
    }
    return panoramas;
}

Bitmap resized(const Bitmap& bitmap, int width, int height) {
    Environment environment;
    environment.image = 0;
    const EnvironmentMap map(environment, &bitmap);
    return pictureOf(width, height, [&](const glm::dvec3& d) { return map.relative(d); });
}

}  // namespace lobe::bench
