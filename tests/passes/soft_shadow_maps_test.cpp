// Soft shadows by maps (shaders/glsl/shadow/soft_maps.glsl) against how much of the light's disc geometry
// hides.
#include <functional>
#include <random>

#include "base/resources.hpp"
#include "passes/pass.hpp"
#include "passes/shadow_map_pass.hpp"
#include "rendering.hpp"

namespace lobe::test {
namespace {

constexpr int kPixels = 64;
constexpr double kHalf = 2.0;  ///< half side of the square of ground that is looked at, m

/// Visibility of a sphere light at a grid of points of the plane y = height: x and z from -kHalf to kHalf.
constexpr const char* kFragment = R"(
struct LightReceiver { vec3 position; vec3 geometric_normal; float behind; };
#include "shadow/soft_maps.glsl"
uniform vec3 uOrigin, uAcross, uUp, uPlaneNormal;
uniform float uRadius;
uniform int uShadowSphere;
layout(location = 0) out vec4 oVisible;
void main()
{
    vec3 p = uOrigin + gl_FragCoord.x * uAcross + gl_FragCoord.y * uUp;
    float v = shadow_maps_soft(uShadowSphere, 0.0, LightReceiver(p, uPlaneNormal, 0.0), uRadius);
    oVisible = vec4(v, 0.0, 0.0, 1.0);
}
)";

struct Setting {
    int size = 1024, taps = 64;
};

/// The ground is y = 0 about `scene`'s origin.
std::vector<double> drawn(const Scene& scene, const Light& light, const Setting& setting) {
    eglContext().makeCurrent();
    Quality quality{.samples = 1, .gbufferBits = 32};
    quality.shadowMethod = ShadowMethod::maps;
    quality.shadowSize = setting.size;
    quality.shadowTaps = setting.taps;
    Scene lit = scene;
    lit.lights = {light};
    const Capabilities capabilities = capabilitiesOf(eglContext().info());
    // A point light's plan draws the same maps.
    Scene planned = lit;
    planned.lights[0].type = LightType::point;
    FramePlan plan = planFrame(summarise(planned), quality, capabilities);
    plan.shadows[LightType::sphere] = PlannedShadow::maps;
    ProgramCache programs(shaderLibrary());
    Targets targets(plan, kPixels, kPixels);
    const BrdfTableBuffer tables(lit, plan);
    SurfaceDraws surfaces(lit, plan, capabilities, programs, tables);
    LightBuffers lights(lit, plan);
    ScreenInputs inputs(lit, plan, tables);
    BodyLights bodies(lit, plan);
    ShadowMaps maps(lit, plan, lights, bodies);
    RayScene rays;
    EnvironmentLight environment(lit, plan);
    FrameResources resources{lit,    plan,        programs, targets, surfaces, lights,
                             bodies, environment, inputs,   rays,    maps,     {}};
    ShadowMapPass pass(*plan.pass("shadow.maps"), resources);
    pass.prepare();
    if (capabilities.clipControl) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const View view = makeView(lookAt({0, 5, 5}, {0, 0, 0}, 0.8), kPixels, kPixels);
    pass.run(view);

    const gl::ShaderLibrary library = shaderLibrary();
    const gl::Defines defines{{"SHADOW_SIDE", "1"}, {"SHADOW_TAPS", std::to_string(setting.taps)}};
    const gl::Program program(
        library.source("pass/screen.vert", defines),
        library.source("generated/soft_test.frag", defines, {{"generated/soft_test.frag", kFragment}}),
        "soft_test");
    const gl::Texture result = gl::makeTarget(GL_RGBA32F, kPixels, kPixels);
    const gl::Framebuffer framebuffer = gl::makeFramebuffer({result.id()}, 0, GL_DEPTH_ATTACHMENT);
    glViewport(0, 0, kPixels, kPixels);
    program.use();
    maps.bind(program);
    const double step = 2.0 * kHalf / kPixels;
    program.set("uOrigin", glm::vec3(glm::dvec3(-kHalf, 0.0, -kHalf) - view.eye));
    program.set("uAcross", glm::vec3(step, 0, 0));
    program.set("uUp", glm::vec3(0, 0, step));
    program.set("uPlaneNormal", glm::vec3(0, 1, 0));
    program.set("uRadius", static_cast<float>(light.radius));
    inputs.drawScreen(program);
    std::vector<float> texels(4 * kPixels * kPixels);
    glReadPixels(0, 0, kPixels, kPixels, GL_RGBA, GL_FLOAT, texels.data());
    gl::checkErrors("reading the test's result");
    std::vector<double> visible;
    for (size_t i = 0; i < texels.size(); i += 4)
        visible.push_back(static_cast<double>(texels[i]));
    return visible;
}

glm::dvec3 groundPoint(size_t i) {
    const double step = 2.0 * kHalf / kPixels;
    return {-kHalf + (static_cast<double>(i % kPixels) + 0.5) * step, 0.0,
            -kHalf + (static_cast<double>(i / kPixels) + 0.5) * step};
}

/// Share of the light's disc, as seen from a point, to which `blocked` leaves the way.
double truth(const glm::dvec3& point, const Light& light,
             const std::function<bool(const glm::dvec3&, const glm::dvec3&)>& blocked) {
    const glm::dvec3 toLight = light.position - point;
    const double distance = glm::length(toLight), sine = light.radius / distance;
    const glm::dvec3 z = toLight / distance;
    const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0.3, 0.2, 0.9))), y = glm::cross(z, x);
    // The disc that the sphere's outline spans, as the tangent cone meets it.
    const double tangent = sine / std::sqrt(1.0 - sine * sine);
    int open = 0, all = 0;
    for (int i = 0; i < 400; ++i) {
        const double r = tangent * std::sqrt((i + 0.5) / 400.0), turn = 2.399963229728653 * i;
        ++all;
        open += blocked(point, z + x * (r * std::cos(turn)) + y * (r * std::sin(turn))) ? 0 : 1;
    }
    return static_cast<double>(open) / all;
}

/// A plate of the given half side at a height, level.
bool meetsPlate(const glm::dvec3& from, const glm::dvec3& direction, double height, double half,
                double middle = 0.0) {
    const glm::dvec3 at = from + direction * ((height - from.y) / direction.y);
    return std::abs(at.x - middle) < half && std::abs(at.z) < half;
}

Scene plates(const std::vector<std::tuple<double, double, double>>& heightHalfMiddle) {
    Scene scene;
    const int material = addMaterial(scene, "lambert");
    const int quad = addQuad(scene, material, 1.0f);
    const auto level = [](double height, double half, double middle) {
        return glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), {middle, height, 0}),
                                      -1.5707963267948966, glm::dvec3(1, 0, 0)),
                          glm::dvec3(half));
    };
    addInstance(scene, quad, level(0.0, 10.0, 0.0));
    for (const auto& [height, half, middle] : heightHalfMiddle)
        addInstance(scene, quad, level(height, half, middle));
    return scene;
}

Light sphereLight(const glm::dvec3& position, double radius) {
    Light light = point(position, glm::dvec3(1.0));
    light.type = LightType::sphere;
    light.radius = radius;
    return light;
}

struct Error {
    double rms = 0.0, worst = 0.0;
    int penumbra = 0;
};

Error compareWith(const std::vector<double>& visible, const Light& light,
                  const std::function<bool(const glm::dvec3&, const glm::dvec3&)>& blocked) {
    Error error;
    double sum = 0.0;
    for (size_t i = 0; i < visible.size(); ++i) {
        const double expected = truth(groundPoint(i), light, blocked);
        EXPECT_GE(visible[i], 0.0);
        EXPECT_LE(visible[i], 1.0);
        if (expected <= 0.0 || expected >= 1.0) continue;
        ++error.penumbra;
        sum += (visible[i] - expected) * (visible[i] - expected);
        error.worst = std::max(error.worst, std::abs(visible[i] - expected));
    }
    error.rms = std::sqrt(sum / std::max(error.penumbra, 1));
    return error;
}

TEST(SoftShadowMaps, OneLevelPlateIsRightUpToTheTaps) {
    const Light light = sphereLight({0.2, 4.0, 0.1}, 0.5);
    const Scene scene = plates({{1.5, 0.6, 0.0}});
    const auto blocked = [](const glm::dvec3& from, const glm::dvec3& to) {
        return meetsPlate(from, to, 1.5, 0.6);
    };
    double before = 1.0;
    for (const auto& [taps, most] : {std::pair(16, 0.06), std::pair(64, 0.03)}) {
        const Error error = compareWith(drawn(scene, light, {1024, taps}), light, blocked);
        EXPECT_GT(error.penumbra, 400);
        EXPECT_LT(error.rms, most) << taps << " taps";
        EXPECT_LT(error.rms, before);
        before = error.rms;
    }
}

TEST(SoftShadowMaps, TwoHeightsAreRoughlyRight) {
    const Light light = sphereLight({0.2, 4.0, 0.1}, 0.5);
    const Scene scene = plates({{1.5, 0.6, -0.5}, {0.5, 0.5, 0.6}});
    const auto blocked = [](const glm::dvec3& from, const glm::dvec3& to) {
        return meetsPlate(from, to, 1.5, 0.6, -0.5) || meetsPlate(from, to, 0.5, 0.5, 0.6);
    };
    const Error error = compareWith(drawn(scene, light, {1024, 64}), light, blocked);
    EXPECT_LT(error.rms, 0.08);
}

TEST(SoftShadowMaps, PlaneAloneIsLitWhateverTheRadiusAndWhereverTheLight) {
    const Scene scene = plates({});
    for (const double radius : {0.0, 1e-6, 0.1, 1.0, 1e4})
        for (const glm::dvec3& position :
             {glm::dvec3(0, 3, 0), glm::dvec3(1.9, 0.05, 1.9), glm::dvec3(8, 0.5, 0), glm::dvec3(0, -1, 0),
              glm::dvec3(0.3, 0, 0.1)})
            for (const double visible : drawn(scene, sphereLight(position, radius), {512, 16}))
                ASSERT_EQ(visible, 1.0) << radius << " at " << position.y;
}

TEST(SoftShadowMaps, SmallLightHasTheHardShadow) {
    const Light light = sphereLight({0.2, 4.0, 0.1}, 1e-6);
    const Scene scene = plates({{1.5, 0.6, 0.0}});
    const std::vector<double> visible = drawn(scene, light, {1024, 16});
    int dark = 0;
    for (size_t i = 0; i < visible.size(); ++i) {
        const glm::dvec3 p = groundPoint(i);
        const glm::dvec3 at = p + (light.position - p) * (1.5 / 4.0);
        const double inside = 0.6 - std::max(std::abs(at.x), std::abs(at.z));
        if (std::abs(inside) < 0.02) continue;
        EXPECT_EQ(visible[i], inside > 0.0 ? 0.0 : 1.0) << p.x << ' ' << p.z;
        dark += inside > 0.0 ? 1 : 0;
    }
    EXPECT_GT(dark, 300);
}

/// The whole way of a picture: plan, maps, light pass.
TEST(SoftShadowMaps, PictureIsNearTheOneByRays) {
    Scene scene = plates({{1.5, 0.6, 0.0}});
    scene.lights = {sphereLight({0.2, 4.0, 0.1}, 0.5)};
    Camera camera = lookAt({0, 1.4, 4.0}, {0, 0, 0}, 0.8);
    camera.zNear = 0.01;
    Quality quality{.samples = 4, .gbufferBits = 32};
    quality.shadowMethod = ShadowMethod::maps;
    quality.shadowSize = 1024;
    const Image maps = render(scene, camera, smallPicture(quality, {Aov::radiance}, quality.shadows));
    quality.shadowMethod = ShadowMethod::rays;
    quality.lightSamples = 64;
    const Image rays = render(scene, camera, smallPicture(quality, {Aov::radiance}, quality.shadows));
    quality.shadows = Shadows::none;
    const Image unshadowed = render(scene, camera, smallPicture(quality, {Aov::radiance}, quality.shadows));
    double off = 0.0, shadow = 0.0;
    for (int i = 0; i < 96 * 64; ++i) {
        const auto green = [i](const Image& image) {
            return static_cast<double>(image.pixel(i % 96, i / 96)[1]);
        };
        off += std::abs(green(maps) - green(rays));
        shadow += std::abs(green(unshadowed) - green(rays));
    }
    EXPECT_GT(shadow, 0.0);
    EXPECT_LT(off, 0.08 * shadow);
}

}  // namespace
}  // namespace lobe::test
