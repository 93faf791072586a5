// What becomes of a file that a person gives: by argument, dialog or drag and drop.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "base/error.hpp"
#include "batch.hpp"
#include "config.hpp"
#include "measure/report_files.hpp"
#include "model_files.hpp"
#include "output_name.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool isOneOf(const std::string& extension, const std::set<std::string>& extensions) {
    return extensions.contains(extension);
}

void openScene(Viewer& viewer, const fs::path& file, const std::vector<app::SettingLayer>& layers) {
    std::error_code failed;
    if (!fs::exists(file, failed)) throw InputError(file.string() + ": no such file; expected a glTF scene");
    viewer.loading.load({file, app::loadOptionsOf(*viewer.document.settings()), layers});
}

/// A model of one's own, for all materials.
void openModel(Viewer& viewer, const std::string& file) {
    json files = viewer.document.settings()->get("brdf_file");
    if (files.is_null()) files = json::array();
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    viewer.whileIdle([&] { app::loadModelFile(file); });
    viewer.worker.reload();
    viewer.document.changeAll({{"brdf_file", files}, {"brdf", fs::path(file).stem().string()}}, file);
}

/// A measured table, for the chosen material or for all.
void openTable(Viewer& viewer, const std::string& file) {
    const DrawnScene* drawn = viewer.drawn();
    if (drawn == nullptr) throw UsageError(file + ": open a scene first, whose material it is for");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file + ": cannot be read; expected a table of the MERL database");
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const Brdf& measured = requireBrdf("measured");
    TableRows rows;
    try {
        rows = measured.table->fromFile(std::as_bytes(std::span(bytes)));
    } catch (const InputError& error) {
        throw InputError(file + ": " + error.what());
    }
    Edits edits = viewer.document.edits();
    for (size_t i = 0; i < drawn->materials.size(); ++i) {
        if (viewer.ui.material >= 0 && static_cast<size_t>(viewer.ui.material) != i) continue;
        Material material = withModel(*viewer.document.scene(), drawn->materials[i], measured);
        material.values.resize(static_cast<size_t>(measured.valueCount()));
        material.values.insert(material.values.end(), rows.begin(), rows.end());
        edits.materials[static_cast<int>(i)] = std::make_shared<const Material>(std::move(material));
    }
    viewer.document.edit(std::move(edits));
    viewer.say(file + ": " + (viewer.ui.material >= 0 ? "for the chosen material" : "for all materials"));
}

/// Settings, a batch or a report: by what is in it.
void openJson(Viewer& viewer, const fs::path& file) {
    const json content = app::readJsonFile(file);
    if (content.is_object() && content.contains("shots")) {
        // Models of files that it names are registered, which pictures in the making refer to.
        viewer.whileIdle([&] { viewer.batch = app::shotsOfBatch(file, viewer.options.sources); });
        viewer.batchIndex = 0;
        viewer.say(file.string() + ": " + std::to_string(viewer.batch.size()) +
                   " shots; the arrow keys step");
        const app::Shot& first = viewer.batch.front();
        return openScene(viewer, first.scene, {{first.settings->toJson(), file.string()}});
    }
    if (content.is_object() && content.contains("schema") && content.contains("scenes")) {
        viewer.ui.report = measure::readReport(file);
        viewer.ui.reportFile = file.string();
        viewer.showPanel(Panel::time);
        viewer.say(file.string() + ": report, shown under Time");
        return;
    }
    app::Settings settings;
    viewer.whileIdle([&] { app::configFrom(file).apply(viewer.document.file(), settings); });
    json values = json::object();
    const app::Settings plain;
    const json all = settings.toJson();
    for (const auto& [key, value] : all.items())
        if (value != plain.get(key)) values[key] = value;
    viewer.whileIdle([&] { viewer.document.changeAll(values, file.string()); });
    viewer.camera.forget();
    viewer.say(file.string() + ": settings taken over");
}

}  // namespace

void Viewer::open(const std::string& file) {
    attempt([&] {
        const fs::path path = file;
        std::error_code failed;
        if (fs::is_directory(path, failed)) {
            batch.clear();
            return openScene(*this, app::sceneFiles({file}).front(), {});
        }
        if (!fs::exists(path, failed)) throw InputError(file + ": no such file");
        const std::string extension = app::lowerExtension(path);
        if (isOneOf(extension, {".gltf", ".glb"})) {
            batch.clear();
            openScene(*this, path, {});
        } else if (isOneOf(extension, {".hdr", ".exr", ".png", ".jpg", ".jpeg", ".webp"})) {
            document.change("env", file);
            say(file + ": the environment");
        } else if (extension == ".glsl") {
            openModel(*this, file);
        } else if (extension == ".binary") {
            openTable(*this, file);
        } else if (extension == ".json") {
            openJson(*this, path);
        } else {
            throw InputError(
                file + ": of unknown kind '" + extension +
                "'; expected .gltf, .glb, .hdr, .exr, .png, .jpg, .webp, .glsl, .binary or .json");
        }
    });
}

void Viewer::openNeighbour(int step) {
    attempt([&] {
        if (!batch.empty()) {
            const auto count = static_cast<int>(batch.size());
            batchIndex = static_cast<size_t>((static_cast<int>(batchIndex) + step + count) % count);
            const app::Shot& shot = batch[batchIndex];
            openScene(*this, shot.scene, {{shot.settings->toJson(), "batch " + std::to_string(batchIndex)}});
            return;
        }
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(fs::absolute(document.file()).parent_path()))
            if (isOneOf(app::lowerExtension(entry.path()), {".gltf", ".glb"})) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        const auto found = std::find_if(files.begin(), files.end(), [&](const fs::path& file) {
            return file.filename() == document.file().filename();
        });
        if (found == files.end()) throw InputError(document.file().string() + ": is no longer there");
        const auto count = static_cast<int>(files.size());
        const auto at = static_cast<int>(found - files.begin());
        openScene(*this, files[static_cast<size_t>((at + step + count) % count)], {});
    });
}

void Viewer::reloadScene() {
    loading.load({document.file(), app::loadOptionsOf(*document.settings()), {}, true});
}

}  // namespace lobe::view
