// Pictures with shadows by rays against traced ones in double, away from the shadows' edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "reference/tracer.hpp"
#include "rendering.hpp"
#include "shading/punctual.hpp"

namespace lobe::test {
namespace {

glm::dmat4 at(const glm::dvec3& position, const glm::dvec3& scale = glm::dvec3(1.0)) {
    return glm::scale(glm::translate(glm::dmat4(1.0), position), scale);
}

/// Things of Lambert's model on a floor, under a light of each type; one point light casts no shadows, and
/// neither does one of the balls.
Scene stage() {
    Scene scene;
    const int white = addMaterial(scene, "lambert");
    const int floor = addQuad(scene, white, 3.0f);
    const int ball = addSphere(scene, white, 24);
    addInstance(scene, floor, glm::rotate(glm::dmat4(1.0), -std::numbers::pi / 2, glm::dvec3(1, 0, 0)));
    addInstance(scene, ball, at({-0.9, 0.5, 0.0}, glm::dvec3(0.5)));
    addInstance(scene, ball, at({0.8, 0.9, -0.4}, {0.3, 0.7, 0.2}));
    addInstance(scene, ball, at({0.1, 0.2, 0.9}, glm::dvec3(0.2)));
    scene.instances.back().castsShadow = false;
    addInstance(scene, ball, at({0.2, 0.6, 0.3}, {0.01, 0.6, 0.01}));
    scene.lights.push_back(directional({0.5, -0.8, -0.3}, {1.5, 1.4, 1.2}));
    scene.lights.push_back(point({-1.5, 1.6, 1.2}, {2.0, 1.0, 0.5}));
    scene.lights.push_back(point({1.8, 1.2, 1.0}, {0.5, 1.0, 2.0}, 3.0));
    scene.lights.push_back(point({0.0, 2.5, 0.0}, {0.5, 0.5, 0.5}));
    scene.lights.back().castsShadow = false;
    scene.lights.push_back(spot({1.5, 2.0, 1.5}, {0, 0, 0}, {8.0, 8.0, 8.0}, 0.3, 0.45));
    return scene;
}

/// With a masked fence and a blended pane before the other things.
Scene fencedStage() {
    Scene scene = stage();
    const int fence = addMaterial(scene, "lambert");
    Material& wire = scene.materials[static_cast<size_t>(fence)];
    wire.alphaMode = AlphaMode::mask;
    wire.doubleSided = true;
    wire.baseColorTexture.texture =
        addImage(scene, 16, 16, 4, [](int x, int y, int c) { return c < 3 || x < 5 || y < 5 ? 255 : 0; });
    wire.baseColorTexture.scale = {5.0f, 4.0f};
    scene.textures.back().sampler.magnify = Filter::nearest;
    scene.textures.back().sampler.minify = Filter::nearest;
    scene.textures.back().sampler.mip = MipFilter::none;
    addInstance(scene, addQuad(scene, fence, 0.6f),
                glm::rotate(at({-0.3, 0.6, 1.3}), 0.3, glm::dvec3(0, 1, 0)));
    const int glass = addMaterial(scene, "lambert");
    Material& pane = scene.materials[static_cast<size_t>(glass)];
    pane.alphaMode = AlphaMode::blend;
    pane.doubleSided = true;
    pane.alpha = 0.4f;
    addInstance(scene, addQuad(scene, glass, 0.5f),
                glm::rotate(at({1.4, 0.5, 0.5}), -0.5, glm::dvec3(0, 1, 0)));
    return scene;
}

/// The same scene, larger and elsewhere.
Scene moved(const Scene& scene, double scale, const glm::dvec3& place) {
    Scene result = scene;
    for (Instance& instance : result.instances)
        instance.worldFromLocal = at(place, glm::dvec3(scale)) * instance.worldFromLocal;
    for (Light& light : result.lights) {
        light.position = place + scale * light.position;
        if (light.type != LightType::directional) light.intensity *= scale * scale;
        if (light.range) *light.range *= scale;
    }
    return result;
}

Camera cameraOf(double scale, const glm::dvec3& place) {
    Camera camera =
        lookAt(place + scale * glm::dvec3(0.3, 1.9, 3.6), place + scale * glm::dvec3(0.0, 0.4, 0.0), 0.8);
    camera.zNear = 0.01 * scale;
    return camera;
}

/// What a point of the picture shows, and what of each light its surfaces see.
struct Traced {
    glm::dvec3 radiance{0.0};
    std::vector<double> seen;  ///< visibility of each light from each layer, and which triangle it is
};

Traced trace(const Scene& scene, const reference::Tracer& tracer, const View& view, double x, double y) {
    std::vector<reference::SurfacePoint> layers;
    tracer.surfacesAlong(reference::pixelRay(view, x, y), nullptr, layers);
    Traced result;
    double passes = 1.0;
    for (const reference::SurfacePoint& point : layers) {
        glm::dvec3 sum(0.0);
        for (const Light& light : scene.lights) {
            glm::dvec3 direction = -light.direction;
            double distance = std::numeric_limits<double>::infinity(), attenuation = 1.0;
            if (light.type != LightType::directional) {
                distance = glm::length(light.position - point.position);
                direction = (light.position - point.position) / distance;
                attenuation = distanceAttenuation(distance * distance, light.range);
                if (light.type == LightType::spot)
                    attenuation *= spotAttenuation(-glm::dot(direction, light.direction),
                                                   light.innerConeAngle, light.outerConeAngle);
            }
            const double cosine = glm::dot(point.normal, direction);
            double visible = 0.0;
            if (cosine > 0.0 && attenuation > 0.0)
                visible = light.castsShadow ? tracer.visibility(point, direction, distance) : 1.0;
            result.seen.push_back(visible);
            sum += light.intensity *
                   (std::max(cosine, 0.0) * attenuation * visible * point.values()[0] / std::numbers::pi);
        }
        result.seen.push_back(point.instance);
        result.radiance += passes * point.alpha * sum;
        passes *= 1.0 - point.alpha;
    }
    return result;
}

struct Agreement {
    int compared = 0, edges = 0, wrong = 0;
    double worst = 0.0;
};

Agreement agreement(const Scene& scene, const Camera& camera, const Quality& quality) {
    constexpr int kWidth = 128, kHeight = 80;
    RenderOptions options = smallPicture(quality, {Aov::radiance}, Shadows::hard);
    options.width = kWidth;
    options.height = kHeight;
    const Image image = render(scene, camera, options);
    const View view = makeView(camera, kWidth, kHeight);
    const reference::Tracer tracer(std::make_shared<const Scene>(scene), view.eye);
    Agreement result;
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column) {
            const double x = column + 0.5, y = kHeight - row - 0.5;
            const Traced traced = trace(scene, tracer, view, x, y);
            bool edge = false;
            // Vertices are drawn up to half of 1/256 pixel away.
            for (const glm::dvec2& shift :
                 {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)})
                edge |=
                    trace(scene, tracer, view, x + 0.02 * shift.x, y + 0.02 * shift.y).seen != traced.seen;
            if (edge) {
                ++result.edges;
                continue;
            }
            ++result.compared;
            const glm::vec3 drawn(image.pixel(column, row)[0], image.pixel(column, row)[1],
                                  image.pixel(column, row)[2]);
            const double scale = std::max({traced.radiance.x, traced.radiance.y, traced.radiance.z, 1e-3});
            const double difference = glm::length(glm::dvec3(drawn) - traced.radiance) / scale;
            result.worst = std::max(result.worst, difference);
            if (!(difference < 2e-3)) ++result.wrong;
        }
    return result;
}

Quality rays() {
    Quality quality{.samples = 1, .gbufferBits = 32, .textureBits = 32};
    quality.shadows = Shadows::hard;
    quality.shadowMethod = ShadowMethod::rays;
    return quality;
}

void expectAgreement(const Agreement& a) {
    EXPECT_EQ(a.wrong, 0) << "worst " << a.worst << " of " << a.compared << ", " << a.edges << " at edges";
    EXPECT_GT(a.compared, 9000);
    EXPECT_LT(a.edges, 600);
}

TEST(ShadowRays, PicturesAreTheReferences) {
    expectAgreement(agreement(stage(), cameraOf(1.0, {}), rays()));
}

TEST(ShadowRays, FencesAndPanes) {
    expectAgreement(agreement(fencedStage(), cameraOf(1.0, {}), rays()));
}

TEST(ShadowRays, ForwardShading) {
    Quality quality = rays();
    quality.shading = Shading::forward;
    expectAgreement(agreement(fencedStage(), cameraOf(1.0, {}), quality));
}

TEST(ShadowRays, ClustersOfLights) {
    Quality quality = rays();
    quality.clusterFrom = 1;
    expectAgreement(agreement(stage(), cameraOf(1.0, {}), quality));
}

TEST(ShadowRays, FarFromTheOrigin) {
    const glm::dvec3 place(1e6, 2e6, -1e6);
    expectAgreement(agreement(moved(stage(), 1.0, place), cameraOf(1.0, place), rays()));
}

TEST(ShadowRays, TinyAndHuge) {
    for (const double scale : {1e-6, 1e6}) {
        SCOPED_TRACE(scale);
        expectAgreement(agreement(moved(fencedStage(), scale, glm::dvec3(0.0)), cameraOf(scale, {}), rays()));
    }
}

TEST(ShadowRays, ManyLightsAreDrawnInGroups) {
    Scene scene = stage();
    scene.lights.clear();
    for (int i = 0; i < 20; ++i)
        scene.lights.push_back(
            point({2.0 * std::cos(i), 1.0 + 0.05 * i, 2.0 * std::sin(i)}, glm::dvec3(0.1 + 0.01 * i)));
    const Agreement a = agreement(scene, cameraOf(1.0, {}), rays());
    EXPECT_EQ(a.wrong, 0) << "worst " << a.worst;
    EXPECT_GT(a.compared, 8000);
}

TEST(ShadowRays, RaysCutShortAreAnError) {
    // 60,000 triangles one behind the other: rays along them meet the boxes of all.
    Scene scene;
    const int white = addMaterial(scene, "lambert");
    addInstance(scene, addQuad(scene, white, 1.0f), at({0, 0, -1}));
    Primitive comb;
    comb.material = white;
    for (int i = 0; i < 60000; ++i) {
        const float z = 2.0f + 1e-4f * static_cast<float>(i);
        for (const glm::vec3& p : {glm::vec3(-1, -1, z), glm::vec3(1, -1, z), glm::vec3(-1, 1, z)}) {
            comb.indices.push_back(static_cast<uint32_t>(comb.positions.size()));
            comb.positions.push_back(p);
            comb.normals.emplace_back(0, 0, 1);
        }
    }
    scene.primitives.push_back(comb);
    addInstance(scene, 1);
    scene.lights.push_back(directional({0, 0, -1}, glm::dvec3(1.0)));
    Camera camera = lookAt({0.9, 0.9, 1}, {0.3, 0.3, -1}, 0.5);
    EXPECT_THROW(
        {
            try {
                render(scene, camera, smallPicture(rays(), {Aov::radiance}, Shadows::hard));
            } catch (const ContextError& error) {
                EXPECT_NE(std::string(error.what()).find("steps"), std::string::npos) << error.what();
                throw;
            }
        },
        ContextError);
}

}  // namespace
}  // namespace lobe::test
