#include "environment_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "environment/radiance_tree.hpp"
#include "math/random.hpp"
#include "passes/renderer.hpp"
#include "reference/pixel.hpp"
#include "scene/made_environment.hpp"
#include "support/scenes.hpp"

namespace lobe::bench {
namespace {

constexpr std::array kWidths{0.02, 0.1, 0.3, 1.0};
constexpr std::array kAngles{0.0, 30.0, 60.0, 75.0, 85.0};
constexpr double kGrazing = 70.0;        ///< degrees, between the classes of the table
constexpr int kViews = 5, kNormals = 6;  ///< lines of sight; normals around each
constexpr int kDirections = 512;
constexpr double kDegrees = std::numbers::pi / 180.0;

struct Method {
    const char* name;
    EnvironmentLighting by;
    EnvironmentDiffuse diffuse;
};
constexpr Method kPrefiltered{"prefiltered", EnvironmentLighting::prefiltered, EnvironmentDiffuse::map};
constexpr Method kSampled{"512 directions", EnvironmentLighting::sampled, EnvironmentDiffuse::map};
constexpr Method kSh2{"sh2", EnvironmentLighting::prefiltered, EnvironmentDiffuse::sh2};
constexpr Method kSh4{"sh4", EnvironmentLighting::prefiltered, EnvironmentDiffuse::sh4};

/// Spread evenly over all (Shoemake, Graphics Gems III).
glm::dmat3 rotation(int number) {
    Pcg32 random(11, static_cast<uint64_t>(number));
    const double share = random.uniform(), a = 2.0 * std::numbers::pi * random.uniform(),
                 b = 2.0 * std::numbers::pi * random.uniform();
    const double s = std::sqrt(1.0 - share), t = std::sqrt(share);
    return glm::mat3_cast(glm::dquat(t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)));
}

/// A square a pixel, tilted by an angle a column, in another direction each row.
Scene tilted(const Panorama& panorama, const Brdf& brdf, double width, int view) {
    Scene scene;
    const int material = test::addMaterial(scene, brdf.name);
    if (brdf.fromMetallicRoughness)
        scene.materials.back().values = brdf.fromMetallicRoughness({glm::dvec3(1.0), 1.0, std::sqrt(width)});
    const int quad = test::addQuad(scene, material, 0.4F);
    for (size_t column = 0; column < kAngles.size(); ++column)
        for (int row = 0; row < kNormals; ++row) {
            const double phi = 2.0 * std::numbers::pi * (row + 0.5) / kNormals;
            const glm::dvec3 place(static_cast<double>(column) + 0.5 - kAngles.size() / 2.0,
                                   kNormals / 2.0 - row - 0.5, 0.0);
            test::addInstance(scene, quad,
                              glm::rotate(glm::translate(glm::dmat4(1.0), place), kAngles[column] * kDegrees,
                                          glm::dvec3(-std::sin(phi), std::cos(phi), 0.0)));
        }
    scene.environment = Environment{};
    scene.environment->image = addPicture(scene, panorama.bitmap, panorama.name);
    scene.environment->background = false;
    scene.environment->worldFromMap = rotation(view);
    Camera camera;
    camera.worldFromCamera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 4.0));
    camera.orthographic = true;
    camera.xMag = kAngles.size() / 2.0;
    camera.yMag = kNormals / 2.0;
    camera.zNear = 0.1;
    camera.zFar = 10.0;
    scene.cameras.push_back(camera);
    return scene;
}

double luminance(const glm::dvec3& rgb) {
    return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

/// Luminance, row by row.
using Values = std::vector<double>;

Values truthOf(const std::shared_ptr<const Scene>& scene) {
    reference::TruthOptions options;
    options.shadows = false;
    const int width = static_cast<int>(kAngles.size());
    const reference::PixelIntegrator integrator(scene, scene->cameras[0], width, kNormals, options);
    Values values(kAngles.size() * kNormals);
    environment::inParallel(values.size(), [&](size_t i) {
        reference::Effort effort;
        effort.relativeError = 0.01;
        effort.mostRays = 1 << 16;
        values[i] = luminance(
            integrator.at(static_cast<int>(i) % width, static_cast<int>(i) / width, effort, i).total());
    });
    return values;
}

Values drawn(gl::Context& context, const std::shared_ptr<const Scene>& scene, const Method& method) {
    RenderOptions options;
    options.width = static_cast<int>(kAngles.size());
    options.height = kNormals;
    options.quality.samples = 1;
    options.quality.shadows = Shadows::none;
    options.quality.envLighting = method.by;
    options.quality.envDiffuse = method.diffuse;
    options.quality.envSamples = kDirections;
    Renderer renderer(context);
    renderer.setScene(scene, options);
    const Picture picture = renderer.render(scene->cameras[0]);
    Values values;
    for (size_t i = 0; i < picture.image.pixelCount(); ++i) {
        const float* pixel = picture.image.values.data() + i * picture.image.channelCount();
        values.push_back(luminance({double{pixel[0]}, double{pixel[1]}, double{pixel[2]}}));
    }
    return values;
}

bool split(const Brdf& brdf, const ParameterValues& values) {
    return brdf.area && !fit::refusal({&brdf, values});
}

/// Those whose lobe has a width that glTF's roughness sets, seen from outside.
std::vector<const Brdf*> models() {
    std::vector<const Brdf*> list;
    for (const Brdf& brdf : allBrdfs())
        if (brdf.traits.scattersLight && brdf.fromMetallicRoughness && brdf.name != "thin_transmission" &&
            brdf.name != "he")  // half a second a sample
            list.push_back(&brdf);
    return list;
}

bool isLambert(const Brdf& brdf) {
    return brdf.area && brdf.area->terms == 0;
}

/// Of each method, at each angle.
std::vector<EnvironmentError> errorsOf(gl::Context& context, const Panorama& panorama, const Brdf& brdf,
                                       double width) {
    std::vector<EnvironmentError> errors;
    for (int view = 0; view < kViews; ++view) {
        const auto scene = std::make_shared<const Scene>(tilted(panorama, brdf, width, view));
        const Values truth = truthOf(scene);
        std::vector<Method> methods{kSampled};
        if (split(brdf, scene->materials[0].values)) methods.push_back(kPrefiltered);
        if (isLambert(brdf)) methods.insert(methods.end(), {kSh2, kSh4});
        if (view == 0)
            for (const Method& method : methods)
                for (const double angle : kAngles)
                    errors.push_back({panorama.name, brdf.name, method.name, width, angle});
        auto error = errors.begin();
        for (const Method& method : methods) {
            const Values picture = drawn(context, scene, method);
            for (size_t column = 0; column < kAngles.size(); ++column, ++error)
                for (size_t i = column; i < truth.size(); i += kAngles.size()) {
                    error->truth += truth[i] / (kViews * kNormals);
                    error->bias += (picture[i] - truth[i]) / (kViews * kNormals);
                    error->error += std::abs(picture[i] - truth[i]) / (kViews * kNormals);
                }
        }
    }
    return errors;
}

}  // namespace

std::vector<EnvironmentError> environmentErrors(gl::Context& context, const std::vector<Panorama>& panoramas,
                                                const std::function<void(const EnvironmentError&)>& done) {
    std::vector<EnvironmentError> errors;
    for (const Panorama& panorama : panoramas)
        for (const Brdf* brdf : models())
            for (const double width : kWidths) {
                if (isLambert(*brdf) && width < 1.0) continue;
                for (const EnvironmentError& error : errorsOf(context, panorama, *brdf, width)) {
                    errors.push_back(error);
                    done(error);
                }
            }
    return errors;
}

std::string errorTable(const std::vector<EnvironmentError>& errors) {
    struct Sum {
        double error = 0.0, truth = 0.0;
    };
    std::vector<std::string> panoramas;
    std::vector<std::pair<std::string, double>> rows;
    std::map<std::tuple<std::string, double, std::string, std::string, bool>, Sum> sums;
    for (const EnvironmentError& e : errors) {
        if (std::find(panoramas.begin(), panoramas.end(), e.panorama) == panoramas.end())
            panoramas.push_back(e.panorama);
        if (std::find(rows.begin(), rows.end(), std::pair(e.model, e.width)) == rows.end())
            rows.emplace_back(e.model, e.width);
        const bool grazing = e.method == kPrefiltered.name && e.angle > kGrazing;
        Sum& sum = sums[{e.model, e.width, e.panorama, e.method, grazing}];
        sum.error += e.error;
        sum.truth += e.truth;
    }
    const auto cell = [&](const auto& row, const std::string& panorama, const char* method, bool grazing) {
        const auto found = sums.find({row.first, row.second, panorama, method, grazing});
        if (found == sums.end()) return std::string("–");
        char text[32];
        std::snprintf(text, sizeof text, "%.1f",
                      100.0 * found->second.error / std::max(found->second.truth, 1e-12));
        return std::string(text);
    };
    std::string table = "| model | width |", line = "| --- | --- |";
    for (const std::string& panorama : panoramas) {
        table += " " + panorama + ": prefiltered to 60° | 75°, 85° | 512 directions |";
        line += " --- | --- | --- |";
    }
    table += "\n" + line + "\n";
    for (const auto& row : rows) {
        char width[32];
        std::snprintf(width, sizeof width, "%g", row.second);
        table += "| `" + row.first + "` | " + width + " |";
        for (const std::string& panorama : panoramas) {
            table += " " + cell(row, panorama, kPrefiltered.name, false) + " |";
            table += " " + cell(row, panorama, kPrefiltered.name, true) + " |";
            table += " " + cell(row, panorama, kSampled.name, false) + " |";
        }
        table += "\n";
    }
    return table;
}

}  // namespace lobe::bench
