// Pictures with shadow maps: no surface shadows itself, and edges are where geometry puts them, within
// texels.
#include <glm/gtc/constants.hpp>
#include <random>

#include "passes/shadow_maps.hpp"
#include "rendering.hpp"

namespace lobe::test {
namespace {

constexpr int kSize = 512;

Quality mapped(int taps = 16, int size = kSize) {
    Quality quality{.samples = 1, .gbufferBits = 32};
    quality.shadows = Shadows::hard;
    quality.shadowMethod = ShadowMethod::maps;
    quality.shadowSize = size;
    quality.shadowTaps = taps;
    return quality;
}

Quality unshadowed() {
    Quality quality = mapped();
    quality.shadows = Shadows::none;
    return quality;
}

Image drawn(Renderer& renderer, const Scene& scene, const Camera& camera, const Quality& quality) {
    renderer.setScene(std::make_shared<Scene>(scene),
                      smallPicture(quality, {Aov::radiance}, quality.shadows));
    return renderer.render(camera).image;
}

/// Shadowed over unshadowed green radiance; -1 where that is black.
std::vector<double> visibility(Renderer& renderer, const Scene& scene, const Camera& camera,
                               const Quality& quality) {
    const Image with = drawn(renderer, scene, camera, quality);
    const Image without = drawn(renderer, scene, camera, unshadowed());
    std::vector<double> result;
    for (int y = 0; y < with.height; ++y)
        for (int x = 0; x < with.width; ++x) {
            const auto full = static_cast<double>(without.pixel(x, y)[1]);
            EXPECT_TRUE(std::isfinite(with.pixel(x, y)[1]));
            result.push_back(full > 0.0 ? static_cast<double>(with.pixel(x, y)[1]) / full : -1.0);
        }
    return result;
}

glm::dmat4 onGround(double half) {
    return glm::scale(glm::rotate(glm::dmat4(1.0), -glm::half_pi<double>(), glm::dvec3(1, 0, 0)),
                      glm::dvec3(half));
}

/// A plane of half size 4 at y = 0 and a ball of radius 0.5 at height 1, about `center`.
Scene ballOverGround(const glm::dvec3& center = glm::dvec3(0.0), double scale = 1.0) {
    Scene scene;
    const int material = addMaterial(scene, "lambert");
    const int quad = addQuad(scene, material, 1.0f);
    const int ball = addSphere(scene, material, 64);
    const glm::dmat4 place = glm::scale(glm::translate(glm::dmat4(1.0), center), glm::dvec3(scale));
    addInstance(scene, quad, place * onGround(4.0));
    addInstance(scene, ball, place * glm::scale(glm::translate(glm::dmat4(1.0), {0, 1, 0}), glm::dvec3(0.5)));
    return scene;
}

/// Looks down on the ground, from where the ball hides none of its shadow to the right.
Camera cameraAbove(const glm::dvec3& center = glm::dvec3(0.0), double scale = 1.0) {
    Camera camera =
        lookAt(center + scale * glm::dvec3(0.5, 6.0, 1.5), center + scale * glm::dvec3(0.5, 0, 0), 0.7);
    camera.zNear = 0.01 * scale;
    return camera;
}

/// World position of the ground (y of `center`) behind a pixel.
glm::dvec3 groundAt(const View& view, const glm::dvec3& center, int x, int row) {
    const double px = x + 0.5, py = view.height - row - 0.5;
    const glm::dvec3 ray = view.rayDirection + px * view.rayDirectionDx + py * view.rayDirectionDy;
    return view.eye + ray * ((center.y - view.eye.y) / ray.y);
}

/// How far the ray from a ground point to a light passes the ball, in its radii: below 1 it is blocked.
double passes(const glm::dvec3& from, const glm::dvec3& toLight, const glm::dvec3& ball) {
    const glm::dvec3 direction = glm::normalize(toLight), way = ball - from;
    return glm::length(way - direction * glm::dot(way, direction));
}

struct Edges {
    int lit = 0, dark = 0, between = 0;
};

/// Every ground pixel whose ray passes the ball's silhouette by more than `tolerance` m is fully lit or fully
/// dark, as it should be.
Edges checkEdges(Renderer& renderer, const Scene& scene, const Camera& camera, const glm::dvec3& center,
                 double scale, double tolerance, const Quality& quality) {
    const std::vector<double> seen = visibility(renderer, scene, camera, quality);
    const View view = makeView(camera, 96, 64);
    const glm::dvec3 ball = center + glm::dvec3(0, scale, 0);
    Edges edges;
    for (int row = 0; row < 64; ++row)
        for (int x = 0; x < 96; ++x) {
            const glm::dvec3 point = groundAt(view, center, x, row);
            if (passes(point, view.eye - point, ball) < 0.55 * scale) continue;  // the ball is before it
            if (std::max(std::abs(point.x - center.x), std::abs(point.z - center.z)) > 3.9 * scale) continue;
            const double v = seen[static_cast<size_t>(row) * 96 + static_cast<size_t>(x)];
            if (v < 0.0) continue;  // beyond the cone
            const Light& light = scene.lights[0];
            const glm::dvec3 toLight =
                light.type == LightType::directional ? -light.direction : light.position - point;
            const double outside = passes(point, toLight, ball) - 0.5 * scale;
            if (std::abs(outside) < tolerance) {
                ++edges.between;
                continue;
            }
            EXPECT_NEAR(v, outside > 0.0 ? 1.0 : 0.0, 1e-6) << x << ' ' << row << " passes by " << outside;
            ++(outside > 0.0 ? edges.lit : edges.dark);
        }
    return edges;
}

std::vector<Light> lightsOverGround(const glm::dvec3& center, double scale) {
    const double power = scale * scale;
    return {directional({0.6, -1.0, 0.1}, glm::dvec3(1.0)),
            point(center + scale * glm::dvec3(-1.0, 3.0, 0.2), glm::dvec3(10.0 * power)),
            spot(center + scale * glm::dvec3(-1.0, 3.0, 0.2), center + scale * glm::dvec3(0.5, 0, 0),
                 glm::dvec3(10.0 * power), 0.5, 0.6),
            spot(center + scale * glm::dvec3(-1.0, 3.0, 0.2), center + scale * glm::dvec3(0.5, 0, 0),
                 glm::dvec3(10.0 * power), 1.2, 1.4)};
}

TEST(ShadowMaps, EdgesAreWithinTheFilterOfWhereTheBallPutsThem) {
    Renderer renderer(eglContext());
    struct Case {
        glm::dvec3 center;
        double scale;
    };
    for (const auto& [center, scale] :
         {Case{{0, 0, 0}, 1.0}, Case{{1e6, 0, -1e6}, 1.0}, Case{{0, 0, 0}, 1e-4}, Case{{0, 0, 0}, 1e5}})
        for (const Light& light : lightsOverGround(center, scale))
            for (const int taps : {1, 16}) {
                SCOPED_TRACE(testing::Message()
                             << "type " << static_cast<int>(light.type) << " taps " << taps << " scale "
                             << scale << " x " << center.x << " cone " << light.outerConeAngle);
                Scene scene = ballOverGround(center, scale);
                scene.lights = {light};
                // Texels: of parallel light 8 m over the map; of a cube 2 over half of it at 1 m, and 3.5 m
                // away.
                const double texel =
                    scale * (light.type == LightType::directional ? 8.5 / kSize : 3.5 * 4.3 / kSize);
                const double radius = 0.5 * (std::sqrt(taps) - 1.0) + 1.0;
                const Edges edges = checkEdges(renderer, scene, cameraAbove(center, scale), center, scale,
                                               texel * (2.5 * radius) + 0.002 * scale, mapped(taps));
                EXPECT_GT(edges.lit, 1000);
                EXPECT_GT(edges.dark, 30);
                EXPECT_GT(edges.between, 0);
            }
}

/// A plane alone, lit from all angles: with its shadow the picture is the same in every bit.
TEST(ShadowMaps, NoPlaneShadowsItself) {
    Renderer renderer(eglContext());
    std::mt19937 engine(3);
    std::uniform_real_distribution<> uniform(-1.0, 1.0);
    for (int i = 0; i < 24; ++i) {
        Scene scene;
        const int quad = addQuad(scene, addMaterial(scene, "lambert"), 1.0f);
        const glm::dmat4 turn =
            glm::rotate(glm::rotate(glm::dmat4(1.0), uniform(engine), glm::dvec3(1, 0, 0)),
                        3.0 * uniform(engine), glm::dvec3(0, 1, 0));
        const glm::dvec3 middle = i % 4 == 3 ? glm::dvec3(1e6, -2e5, 3e5) : glm::dvec3(0.0);
        addInstance(
            scene, quad,
            glm::translate(glm::dmat4(1.0), middle) * turn * glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
        const glm::dvec3 normal = turn[2], along = turn[0], up = turn[1];
        // From straight above to half a degree above the horizon.
        const double angle = glm::half_pi<double>() - std::pow(10.0, -2.0 * (i % 12) / 11.0) * 1.4;
        const double way = 3.0 * uniform(engine);
        const glm::dvec3 toLight =
            std::cos(angle) * normal + std::sin(angle) * (std::cos(way) * along + std::sin(way) * up);
        const glm::dvec3 aim = middle + 0.3 * along;
        const Light kinds[] = {directional(-toLight, glm::dvec3(1.0)),
                               point(aim + 2.0 * toLight, glm::dvec3(5.0)),
                               spot(aim + 2.0 * toLight, aim, glm::dvec3(5.0), 0.3, 0.9),
                               spot(aim + 2.0 * toLight, aim, glm::dvec3(5.0), 0.3, 1.5)};
        Camera camera = lookAt(middle + 4.0 * normal + 1.0 * up, middle, 0.8);
        camera.zNear = 0.01;
        for (const Light& light : kinds)
            for (const int taps : {1, 9, 64}) {
                scene.lights = {light};
                const Image with = drawn(renderer, scene, camera, mapped(taps));
                ASSERT_NE(renderer.plan().pass("shadow.maps"), nullptr);
                const Image without = drawn(renderer, scene, camera, unshadowed());
                EXPECT_EQ(with.values, without.values)
                    << "plane " << i << ", " << glm::degrees(angle) << " degrees, type "
                    << static_cast<int>(light.type) << ", " << taps << " taps";
            }
    }
}

/// Depths are written by the shader then, and positions come from a channel of their own.
TEST(ShadowMaps, WithoutClipControlEdgesAndPlanesAreAsGood) {
    eglContext().release();
    {
        const auto context =
            gl::Context::create({.backend = gl::Backend::egl, .maskedExtensions = {"GL_ARB_clip_control"}});
        Renderer renderer(*context);
        for (const Light& light : lightsOverGround({0, 0, 0}, 1.0)) {
            SCOPED_TRACE(testing::Message() << "type " << static_cast<int>(light.type));
            Scene scene = ballOverGround();
            scene.lights = {light};
            const double texel = light.type == LightType::directional ? 8.5 / kSize : 3.5 * 4.3 / kSize;
            const Edges edges =
                checkEdges(renderer, scene, cameraAbove(), {0, 0, 0}, 1.0, 2.5 * texel + 0.002, mapped(1));
            EXPECT_GT(edges.dark, 30);
            scene.instances.pop_back();
            const Image with = drawn(renderer, scene, cameraAbove(), mapped());
            EXPECT_EQ(with.values, drawn(renderer, scene, cameraAbove(), unshadowed()).values);
        }
        context->release();
    }
    eglContext().makeCurrent();
}

TEST(ShadowMaps, ForwardShadingSeesTheSame) {
    Renderer renderer(eglContext());
    Scene scene = ballOverGround();
    scene.lights = lightsOverGround({0, 0, 0}, 1.0);
    scene.lights.push_back(point({1, 2, 2}, {5, 5, 5}));
    scene.lights.back().castsShadow = false;
    Quality forward = mapped();
    forward.shading = Shading::forward;
    const Image a = drawn(renderer, scene, cameraAbove(), mapped());
    const Image b = drawn(renderer, scene, cameraAbove(), forward);
    int differ = 0;
    for (size_t i = 0; i < a.values.size(); ++i)
        differ += std::abs(a.values[i] - b.values[i]) > 1e-3f * std::abs(a.values[i]) + 1e-5f ? 1 : 0;
    // Positions differ in the last bits, and with them comparisons at a texel's very edge.
    EXPECT_LT(differ, static_cast<int>(a.values.size()) / 200);
}

TEST(ShadowMaps, NeitherCasterNorLightThatIsSwitchedOffCasts) {
    Renderer renderer(eglContext());
    Scene scene = ballOverGround();
    scene.lights = {directional({0.6, -1.0, 0.1}, glm::dvec3(1.0))};
    const auto darkOnGround = [&] {
        const std::vector<double> seen = visibility(renderer, scene, cameraAbove(), mapped());
        const View view = makeView(cameraAbove(), 96, 64);
        int dark = 0;
        for (int i = 0; i < 96 * 64; ++i) {
            const glm::dvec3 p = groundAt(view, {0, 0, 0}, i % 96, i / 96);
            const bool behindBall = passes(p, view.eye - p, {0, 1, 0}) < 0.55;
            const double v = seen[static_cast<size_t>(i)];
            dark += !behindBall && v >= 0.0 && v < 1.0 ? 1 : 0;
        }
        return dark;
    };
    EXPECT_GT(darkOnGround(), 100);
    scene.instances[1].castsShadow = false;
    EXPECT_EQ(darkOnGround(), 0);
    scene.instances[1].castsShadow = true;
    scene.lights[0].castsShadow = false;
    EXPECT_EQ(darkOnGround(), 0);
}

TEST(ShadowMaps, MasksCutHoles) {
    Renderer renderer(eglContext());
    Scene scene;
    const int ground = addQuad(scene, addMaterial(scene, "lambert"), 2.0f);
    addInstance(scene, ground, onGround(1.0));
    const int masked = addMaterial(scene, "lambert");
    // Opaque where x < 0 (the texture's left half), a hole on the right.
    scene.materials[static_cast<size_t>(masked)].baseColorTexture.texture =
        addImage(scene, 8, 8, 4, [](int x, int, int c) { return c == 3 && x >= 4 ? 0 : 255; });
    scene.materials[static_cast<size_t>(masked)].alphaMode = AlphaMode::mask;
    const int plate = addQuad(scene, masked, 0.5f);
    addInstance(scene, plate, glm::translate(glm::dmat4(1.0), {0, 1, 0}) * onGround(1.0));
    scene.lights = {directional({0, -1, 0.0}, glm::dvec3(1.0))};
    Camera camera = lookAt({0, 0.5, 1.2}, {0, 0, 0}, 1.2);  // under the plate
    const std::vector<double> seen = visibility(renderer, scene, camera, mapped());
    const View view = makeView(camera, 96, 64);
    int dark = 0, lit = 0;
    for (int row = 32; row < 64; ++row)
        for (int x = 0; x < 96; ++x) {
            const glm::dvec3 p = groundAt(view, {0, 0, 0}, x, row);
            if (std::abs(p.z) > 0.45 || std::abs(p.x) > 0.42 || std::abs(p.x) < 0.1) continue;
            const double v = seen[static_cast<size_t>(row) * 96 + static_cast<size_t>(x)];
            EXPECT_EQ(v, p.x < 0.0 ? 0.0 : 1.0) << p.x << ' ' << p.z;
            ++(p.x < 0.0 ? dark : lit);
        }
    EXPECT_GT(dark, 50);
    EXPECT_GT(lit, 50);
}

TEST(ShadowMaps, LightInsideABallLightsNothingOutside) {
    Renderer renderer(eglContext());
    Scene scene = ballOverGround();
    scene.lights = {point({0, 1, 0}, glm::dvec3(10.0))};
    for (const double v : visibility(renderer, scene, cameraAbove(), mapped()))
        if (v >= 0.0) {
            EXPECT_EQ(v, 0.0);
        }
}

TEST(ShadowMaps, LightsAtOddPlacesAreFinite) {
    Renderer renderer(eglContext());
    const Light odd[] = {point({0, 0, 0}, glm::dvec3(1.0)),        // on the ground
                         point({0.5, -1e-7, 0}, glm::dvec3(1.0)),  // just below it
                         point({0, 1.5, 0}, glm::dvec3(1.0)),      // on the ball
                         point({1e6, 1e6, 0}, glm::dvec3(1e12)),   // far away
                         spot({0, 3, 0}, {0, 0, 0}, glm::dvec3(9.0), 0.0, 0.0),
                         spot({0, 3, 0}, {0, 0, 0}, glm::dvec3(9.0), 0.4, 0.4),
                         spot({0, 3, 0}, {0, 0, 0}, glm::dvec3(9.0), 0.0, glm::half_pi<double>()),
                         spot({0, -3, 0}, {0, 0, 0}, glm::dvec3(9.0), 0.2, 0.7),
                         directional({0, 1, 0}, glm::dvec3(1.0)),   // from below
                         directional({1, 0, 0}, glm::dvec3(1.0))};  // along the ground
    for (const Light& light : odd) {
        Scene scene = ballOverGround();
        scene.lights = {light};
        for (const double v : visibility(renderer, scene, cameraAbove(), mapped())) {
            if (v < 0.0) continue;
            EXPECT_GE(v, 0.0);
            EXPECT_LE(v, 1.0 + 1e-6);
        }
    }
}

TEST(ShadowMaps, CastersLargerThanTheMapStillCast) {
    Renderer renderer(eglContext());
    Scene scene;
    const int quad = addQuad(scene, addMaterial(scene, "lambert"), 1.0f);
    addInstance(scene, quad, onGround(1e4));
    addInstance(scene, quad, glm::translate(glm::dmat4(1.0), {1e4, 2, 0}) * onGround(1e4));  // over x > 0
    for (const Light& light : {directional({0, -1, 0.3}, glm::dvec3(1.0)), point({0, 4, 0}, glm::dvec3(30.0)),
                               spot({0, 4, 0}, {0, 0, 0}, glm::dvec3(30.0), 0.9, 1.0)}) {
        scene.lights = {light};
        Camera camera = lookAt({-3, 1.8, 3}, {1, 0, -1}, 1.0);
        camera.zNear = 0.01;
        const std::vector<double> seen = visibility(renderer, scene, camera, mapped(1, 1024));
        const View view = makeView(camera, 96, 64);
        int dark = 0, lit = 0;
        for (int row = 0; row < 64; ++row)
            for (int x = 0; x < 96; ++x) {
                const glm::dvec3 p = groundAt(view, {0, 0, 0}, x, row);
                const double v = seen[static_cast<size_t>(row) * 96 + static_cast<size_t>(x)];
                if (v < 0.0 || glm::dot(p - view.eye, view.forward) < 0.0 || glm::length(p) > 6.0 ||
                    std::abs(p.x) < 0.3)
                    continue;
                EXPECT_EQ(v, p.x > 0.0 ? 0.0 : 1.0) << p.x << ' ' << p.z;
                ++(p.x > 0.0 ? dark : lit);
            }
        EXPECT_GT(dark, 20);
        EXPECT_GT(lit, 20);
    }
}

TEST(ShadowMaps, ThirtyTwoLightsHaveTheirShadows) {
    Renderer renderer(eglContext());
    Scene scene = ballOverGround();
    for (int i = 0; i < 32; ++i) {
        const double turn = 2.0 * glm::pi<double>() * i / 32.0;
        scene.lights.push_back(
            point({2.0 * std::cos(turn), 3.0, 2.0 * std::sin(turn)}, glm::dvec3(0.3), 30.0));
    }
    const std::vector<double> all = visibility(renderer, scene, cameraAbove(), mapped(4));
    EXPECT_EQ(renderer.plan().pass("shadow.maps"), nullptr);  // the last one drawn had none
    // Each light alone: visibilities weigh in by unshadowed light.
    std::vector<double> sum(all.size(), 0.0), whole(all.size(), 0.0);
    const std::vector<Light> lights = scene.lights;
    for (const Light& light : lights) {
        scene.lights = {light};
        const Image with = drawn(renderer, scene, cameraAbove(), mapped(4));
        const Image without = drawn(renderer, scene, cameraAbove(), unshadowed());
        for (int i = 0; i < 96 * 64; ++i) {
            sum[static_cast<size_t>(i)] += static_cast<double>(with.pixel(i % 96, i / 96)[1]);
            whole[static_cast<size_t>(i)] += static_cast<double>(without.pixel(i % 96, i / 96)[1]);
        }
    }
    for (size_t i = 0; i < all.size(); ++i)
        if (whole[i] > 0.0) {
            EXPECT_NEAR(all[i], sum[i] / whole[i], 1e-4);
        }
}

TEST(ShadowMaps, AreDrawnOnceForSamplesAndForCamerasThatSeeTheSame) {
    Scene scene = ballOverGround();
    scene.lights = lightsOverGround({0, 0, 0}, 1.0);
    const FramePlan plan = planFrame(summarise(scene), mapped(), capabilitiesOf(eglContext().info()));
    eglContext().makeCurrent();
    const LightBuffers lights(scene, plan);
    ShadowMaps made(scene, plan, lights, BodyLights(scene, plan));
    const auto view = [](const glm::dvec3& eye, glm::dvec2 jitter = {}) {
        Camera camera = lookAt(eye, {0, 0.5, 0}, 1.4);
        camera.zNear = 0.01;
        return makeView(camera, 96, 64, jitter);
    };
    EXPECT_EQ(made.update(view({0, 3, 8})).size(), 1u + 6u + 1u + 6u);
    EXPECT_TRUE(made.update(view({0, 3, 8}, {0.2, 0.3})).empty());
    EXPECT_TRUE(made.update(view({1, 3, 8})).empty());
    // Close by less is seen, and parallel light's map follows.
    const size_t moved = made.update(view({0, 1, 1})).size();
    EXPECT_GE(moved, 1u);
    EXPECT_LE(moved, 4u);
}

}  // namespace
}  // namespace lobe::test
