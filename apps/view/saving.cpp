// Pictures, states and command lines.
#include <algorithm>
#include <fstream>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "config.hpp"
#include "explain_text.hpp"
#include "gltf_export.hpp"
#include "image/image_files.hpp"
#include "shot_scene.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What differs from the built-in settings, and the size, which the window decides.
json changedSettings(const app::Settings& settings) {
    json result = json::object();
    const app::Settings plain;
    const json all = settings.toJson();
    for (const auto& [key, value] : all.items())
        if (key != "output" && (value != plain.get(key) || key == "resolution")) result[key] = value;
    // A state may lie in another folder than this program was started in.
    if (result.contains("brdf_file") && result["brdf_file"].is_array())
        for (json& file : result["brdf_file"])
            file = fs::absolute(file.get<std::string>()).string();
    return result;
}

/// As shells read it.
std::string quoted(const std::string& text) {
    if (!text.empty() &&
        text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                               "_-+=./,:%@") == std::string::npos)
        return text;
    std::string result = "'";
    for (const char c : text)
        result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

std::string valueText(const json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const json& part : value)
        text += (text.empty() ? "" : ",") + valueText(part);
    return text;
}

}  // namespace

fs::path Viewer::freeName(const std::string& suffix) {
    const std::string stem = document.scene() ? document.file().stem().string() : "lobe";
    std::error_code ignored;
    for (int i = 1;; ++i) {
        fs::path name = fs::path("out") / (stem + "_" + std::to_string(i) + suffix);
        // An edited scene is written beside its state; a picture that is still drawn has no file yet.
        fs::path scene = name;
        scene.replace_extension(".gltf");
        if (fs::exists(name, ignored) || (suffix == ".json" && fs::exists(scene, ignored))) continue;
        if (namesGiven_.insert(name.string()).second) return name;
    }
}

void Viewer::savePicture(const fs::path& file) {
    if (!document.scene()) return;
    attempt([&] {
        app::Settings settings = *document.settings();
        settings.set("output", file.string(), "window");
        FrameRequest request;
        request.file = document.file();
        request.base = document.scene();
        request.settings = std::make_shared<const app::Settings>(std::move(settings));
        request.edits = document.edits();
        worker.save({std::move(request), file});
    });
}

void Viewer::saveWindow() {
    const fs::path file = freeName("_window.png");
    fs::create_directories(file.parent_path());
    ImageFiles().write(file, window.pixels(), {});
    say("wrote " + file.string());
}

std::string Viewer::stateText() const {
    return changedSettings(*document.settings()).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string Viewer::commandLine() const {
    std::string line = "lobe render " + quoted(document.file().string());
    const json changed = changedSettings(*document.settings());
    for (const auto& [key, value] : changed.items()) {
        const std::string flag = app::requireSetting(key, "window").flag();
        if (value.is_object())
            for (const auto& [name, part] : value.items())
                line += " " + quoted(flag + "=" + name + "=" + valueText(part));
        else if (key == "brdf_file")
            for (const json& file : value)
                line += " " + quoted(flag + "=" + valueText(file));
        else
            line += " " + quoted(flag + "=" + valueText(value));
    }
    return line + " --no-config -o " + quoted(document.file().stem().string() + ".png");
}

void Viewer::useState(const std::string& text, const std::string& origin) {
    attempt([&] {
        const json values = json::parse(text, nullptr, false);
        if (!values.is_object())
            throw UsageError(origin + ": is no state; expected a JSON object of settings");
        whileIdle([&] { document.changeAll(values, origin); });
        camera.forget();
        say(origin + ": settings taken over");
    });
}

void saveState(Viewer& viewer, const fs::path& file) {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    fs::path edited = file;
    edited.replace_extension(".gltf");
    std::error_code ignored;
    if (!viewer.document.edits().empty() && fs::exists(edited, ignored))
        throw UsageError(
            edited.string() +
            ": the edited scene would be written here, and there is a file; expected another name");
    writeAtomically(file, viewer.stateText());
    viewer.say("wrote " + file.string() + ": lobe render SCENE --settings " + file.string());
    if (!viewer.document.edits().empty()) exportEdited(viewer, edited);
}

void exportEdited(Viewer& viewer, const fs::path& file) {
    if (!viewer.drawn()) throw UsageError("no picture yet, of which the scene could be written");
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    Scene facts;  // what was drawn of materials and lights
    facts.materials = viewer.drawn()->materials;
    facts.lights = viewer.drawn()->lights;
    facts.file = viewer.document.file().string();
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const EditedGltf made =
        editedGltf(viewer.document.file(), facts, viewer.document.edits(), file.stem().string() + "_files");
    for (const auto& [from, to] : made.files) {
        fs::create_directories((folder / to).parent_path());
        fs::copy_file(from, folder / to, fs::copy_options::overwrite_existing);
    }
    writeAtomically(file, made.gltf.dump(1) + "\n");
    viewer.say("wrote " + file.string());
}

void Viewer::explainPixel(double x, double y) {
    if (!document.scene() || explaining_.valid()) return;
    if (!full || full->settings->get("resolution") != document.settings()->get("resolution")) return;
    const auto px = static_cast<int>(x), py = static_cast<int>(y);
    const float* values = full->image.pixel(std::clamp(px, 0, full->image.width - 1),
                                            std::clamp(py, 0, full->image.height - 1));
    const glm::dvec3 shown(double{values[0]}, double{values[1]}, double{values[2]});
    explanation = "computing the truth of pixel " + std::to_string(px) + "," + std::to_string(py) + " ...";
    explaining_ = std::async(
        std::launch::async,
        [base = document.scene(), settings = document.settings(), edits = document.edits(), px, py, shown,
         context = worker.info().backend + " " + worker.info().renderer]() -> std::string {
            try {
                const std::shared_ptr<const Scene> scene = composedScene(base, *settings, edits);
                for (const Material& material : scene->materials)
                    if (const Brdf* brdf = findBrdf(material.brdf)) requireTwin(*brdf);
                const RenderOptions size = app::renderOptionsOf(*settings);
                const bool shadows = app::truthHasShadows(*settings);
                const reference::PixelIntegrator integrator(scene, app::cameraOf(*base, *settings, 0),
                                                            size.width, size.height, {.shadows = shadows});
                reference::Effort effort;
                effort.relativeError = 0.003;
                effort.mostRays = 1 << 16;
                const reference::Explanation found =
                    reference::explain(integrator, *scene, px, py, effort, shadows);
                return app::explanationText(*scene, {px, py, scene->file, &found, shown, context});
            } catch (const std::exception& failure) {
                return failure.what();
            }
        });
}

}  // namespace lobe::view
