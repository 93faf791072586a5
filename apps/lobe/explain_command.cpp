// lobe explain: surface, lights and terms behind one pixel.
#include <iostream>

#include "arguments.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "explain_text.hpp"
#include "passes/renderer.hpp"
#include "shot_scene.hpp"

namespace lobe::app {
namespace {

struct Place {
    int x = 0, y = 0;
};

Place placeOf(const std::string& text, const RenderOptions& options) {
    Place place;
    int used = 0;
    if (std::sscanf(text.c_str(), "%d,%d%n", &place.x, &place.y, &used) != 2 ||
        static_cast<size_t>(used) != text.size())
        throw UsageError("--pixel '" + text + "': expected X,Y, as 320,180");
    if (place.x < 0 || place.x >= options.width || place.y < 0 || place.y >= options.height)
        throw UsageError("--pixel '" + text + "': expected a pixel of the picture, 0,0 to " +
                         std::to_string(options.width - 1) + "," + std::to_string(options.height - 1));
    return place;
}

/// The engine's own value, by the settings' quality but through the pixel's centre.
void render(const std::shared_ptr<const Scene>& scene, const Camera& camera, const Settings& settings,
            ExplainedPixel& pixel) {
    const gl::ContextRequest request{.backend = gl::parseBackend(settings.get("backend").get<std::string>()),
                                     .device = settings.get("device").get<int>()};
    try {
        const auto context = gl::Context::create(request);
        Renderer renderer(*context);
        RenderOptions options = renderOptionsOf(settings);
        options.quality.samples = 1;
        options.aovs = {Aov::radiance};
        renderer.setScene(scene, options);
        const Image image = renderer.render(camera).image;
        const float* values = image.pixel(pixel.x, pixel.y);
        pixel.rendered = glm::dvec3(double{values[0]}, double{values[1]}, double{values[2]});
        pixel.context = context->info().backend + " " + context->info().renderer;
    } catch (const ContextError& error) {
        if (request.backend != gl::Backend::automatic) throw;
        std::cerr << "lobe: warning: not rendered, as there is no context: " << error.what() << '\n';
    }
}

}  // namespace

int explainCommand(const std::vector<std::string>& list) {
    Arguments arguments(
        "explain",
        "What one pixel sees: surface, parameters, each light's share with its terms and visibility, "
        "the truth, and what OpenGL makes of it.");
    std::vector<std::string> inputs;
    std::string where, testFile;
    bool json = false, noShadows = false;
    double error = 0.001;
    arguments.app().add_option("scene", inputs, "glTF scene; - is standard input")->type_name("SCENE");
    arguments.app()
        .add_option("--pixel", where, "which, from the left and from the top")
        ->type_name("X,Y")
        ->required();
    arguments.app()
        .add_option("--test", testFile,
                    "write a lobe-check test of this surface under its strongest light here")
        ->type_name("FILE");
    arguments.app()
        .add_option("--error", error, "standard error wanted of the truth, as a share of it [0.001]")
        ->type_name("SHARE")
        ->check(CLI::Range(1e-5, 1.0));
    arguments.app().add_flag("--no-shadows", noShadows,
                             "everything sees every light, as with --shadows none");
    arguments.app().add_flag("--json", json, "for programs");
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;

    const std::vector<std::filesystem::path> files = sceneFiles(inputs);
    if (files.size() != 1) throw UsageError(std::to_string(files.size()) + " scenes; expected one");
    const Settings settings = arguments.sources().resolve(files[0]);
    requireOneCamera(settings);
    const bool shadows = !noShadows && settings.get("shadows") != "none";
    const RenderOptions options = renderOptionsOf(settings);
    const Place place = placeOf(where, options);

    SceneLoader loader;
    const auto scene = preparedScene(
        std::make_shared<const Scene>(loader.load(files[0], loadOptionsOf(settings))), settings);
    for (const std::string& warning : scene->warnings)
        std::cerr << "lobe: warning: " << scene->file << ": " << warning << '\n';
    for (const Material& material : scene->materials)
        if (const Brdf* brdf = findBrdf(material.brdf)) requireTwin(*brdf);
    const Camera camera = cameraOf(*scene, settings, 0);

    const reference::PixelIntegrator integrator(scene, camera, options.width, options.height,
                                                {.shadows = shadows});
    reference::Effort effort;
    effort.relativeError = error;
    const reference::Explanation explanation =
        reference::explain(integrator, *scene, place.x, place.y, effort, shadows);
    ExplainedPixel pixel{place.x, place.y, files[0].string(), &explanation, {}, {}};
    render(scene, camera, settings, pixel);
    std::cout << (json ? explanationJson(*scene, pixel).dump(2) + "\n" : explanationText(*scene, pixel));
    const std::string test = explanationTest(pixel);
    if (!testFile.empty()) {
        if (test.empty())
            throw UsageError(
                "--test: no test can be written of this pixel; expected a lit surface whose model has "
                "no table");
        writeAtomically(testFile, test);
    } else if (!json && !test.empty()) {
        std::cout << "\nAs a test for lobe-check (--test FILE writes it):\n\n" << test;
    }
    return 0;
}

}  // namespace lobe::app
