#include "scenes.hpp"

#include <random>

#include "support/scenes.hpp"

namespace lobe::bench {
namespace {

using namespace lobe::test;

Camera view(const glm::dvec3& from, const glm::dvec3& to, double fov) {
    Camera camera = lookAt(from, to, fov);
    camera.zNear = 0.05;
    return camera;
}

glm::dmat4 at(const glm::dvec3& position, const glm::dvec3& scale = glm::dvec3(1.0)) {
    return glm::scale(glm::translate(glm::dmat4(1.0), position), scale);
}

glm::dmat4 turned(const glm::dvec3& position, double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), position), degrees * std::numbers::pi / 180.0, axis);
}

}  // namespace

Scene flat() {
    Scene scene;
    scene.name = "flat";
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 10.0f));
    scene.lights.push_back(directional({0.2, -0.3, -1}, glm::dvec3(3.0)));
    scene.cameras.push_back(view({0, 0, 4}, {0, 0, 0}, 0.7));
    return scene;
}

Scene balls(int n) {
    Scene scene;
    const int ball = addSphere(scene, addMaterial(scene, "metallic_roughness"), n);
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 4.0f),
                turned({0, 0, 0}, -90, {1, 0, 0}));
    for (int i = 0; i < 9; ++i)
        addInstance(scene, ball,
                    at({1.6 * (i % 3) - 1.6, 0.6 + 0.2 * (i % 2), 1.6 * (i / 3) - 1.6}, glm::dvec3(0.6)));
    scene.name = "9 balls, " + std::to_string(scene.triangleCount()) + " triangles";
    scene.cameras.push_back(view({0, 3.2, 7}, {0, 0.4, 0}, 0.75));
    return scene;
}

Scene hall() {
    Scene scene;
    scene.name = "hall";
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const int floor = addQuad(scene, addMaterial(scene, "metallic_roughness"), 20.0f);
    addInstance(scene, floor, turned({0, 0, 0}, -90, {1, 0, 0}));
    addInstance(scene, floor, turned({0, 0, -20}, 0, {1, 0, 0}));
    addInstance(scene, floor, turned({-8, 0, 0}, 90, {0, 1, 0}));
    addInstance(scene, floor, turned({8, 0, 0}, -90, {0, 1, 0}));
    // 99 shapes of 2 * 71 * 142 = 20,000 triangles, half of them placed once more than the other: 1.0 million
    // drawn.
    for (int i = 0; i < 99; ++i) {
        const int material = addMaterial(scene, i % 3 == 0 ? "blinn_phong" : "metallic_roughness");
        Material& m = scene.materials[static_cast<size_t>(material)];
        m.values = requireBrdf(m.brdf).fromMetallicRoughness(
            {{0.2 + 0.8 * unit(random), 0.2 + 0.8 * unit(random), 0.2 + 0.8 * unit(random)},
             i % 5 == 0 ? 1.0 : 0.0,
             0.2 + 0.6 * unit(random)});
        const int shape = addSphere(scene, material, i % 2 ? 50 : 51);
        const double x = (i % 2 ? 1 : -1) * (3.0 + unit(random) * 3.0);
        const double z = 14.0 - 33.0 * (i / 99.0);
        addInstance(scene, shape, at({x, 0.4 + 3.0 * (i % 4), z}, {0.4, 0.4 + 1.2 * (i % 3), 0.4}));
    }
    for (int i = 0; i < 64; ++i)
        scene.lights.push_back(
            point({-7.0 + 14.0 * unit(random), 0.5 + 4.0 * unit(random), -18.0 + 32.0 * unit(random)},
                  glm::dvec3(4.0 * unit(random), 3.0, 4.0 * unit(random)), 5.0));
    for (int i = 0; i < 8; ++i) {
        Light light = spot({i % 2 ? 3.0 : -3.0, 6.0, 12.0 - 4.0 * i}, {0, 0, 11.0 - 4.0 * i},
                           glm::dvec3(40.0), 0.3, 0.5);
        light.range = 10.0;
        scene.lights.push_back(light);
    }
    scene.cameras.push_back(view({0, 2.5, 18}, {0, 2, 0}, 0.9));
    return scene;
}

Scene lightField(int count) {
    Scene scene;
    scene.name = std::to_string(count) + " lights";
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 20.0f),
                turned({0, 0, 0}, -90, {1, 0, 0}));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-18.0, 18.0), colour(0.2, 1.0), height(0.2, 2.0);
    // The area that all lights reach together grows like sqrt(count): few large ones, many small ones.
    const double range = count == 1 ? 40.0 : 14.0 / std::pow(count, 0.35);
    for (int i = 0; i < count; ++i)
        scene.lights.push_back(point({place(random), height(random), place(random)},
                                     glm::dvec3(colour(random), colour(random), colour(random)), range));
    scene.cameras.push_back(view({0, 8, 22}, {0, 0, 0}, 0.9));
    return scene;
}

}  // namespace lobe::bench
