#include "model_files.hpp"

#include <algorithm>

#include "base/content_hash.hpp"
#include "base/error.hpp"
#include "passes/renderer.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr size_t kMostFiles = 16;

struct ModelFile {
    fs::path path;  ///< absolute, without links
    BrdfSource source;
    std::string name;
    std::string hash;
};

std::vector<ModelFile>& modelFiles() {
    static std::vector<ModelFile> files;
    return files;
}

fs::path identityOf(const std::string& file) {
    std::error_code failed;
    fs::path path = fs::weakly_canonical(file, failed);
    return failed ? fs::path(file) : path;
}

const ModelFile& modelFile(const std::string& file) {
    const fs::path path = identityOf(file);
    const auto found = std::find_if(modelFiles().begin(), modelFiles().end(),
                                    [&](const ModelFile& known) { return known.path == path; });
    if (found == modelFiles().end()) throw InputError(file + ": was not loaded");  // it moved since
    return *found;
}

template<class Action>
void forEachFile(const Settings& settings, Action action) {
    const json& files = settings.get("brdf_file");
    if (files.is_null()) return;
    for (const json& file : files)
        action(modelFile(file.get<std::string>()));
}

/// With the names and fingerprints that they have once `files` are registered, which this does.
std::vector<ModelFile> registered(std::vector<ModelFile> files) {
    std::vector<Brdf> models;
    models.reserve(files.size());
    for (ModelFile& file : files) {
        models.push_back(brdfFromSource(file.source));
        file.name = models.back().name;
    }
    std::vector<Brdf> before = loadedBrdfs();
    setLoadedBrdfs(std::move(models));
    try {
        for (ModelFile& file : files) {
            const std::string text = shaderLibrary().source("brdf/" + file.name + ".glsl", {}).text;
            ContentHash hash;
            hash.add(std::as_bytes(std::span(text)));
            file.hash = hash.hex();
        }
    } catch (...) {
        setLoadedBrdfs(std::move(before));
        throw;
    }
    return files;
}

}  // namespace

void rereadModelFiles() {
    std::vector<ModelFile> files = modelFiles();
    if (files.empty()) return;
    for (ModelFile& file : files)
        file.source = readBrdfSource(file.source.file);
    modelFiles() = registered(std::move(files));
}

void loadModelFile(const std::string& file) {
    std::vector<ModelFile>& files = modelFiles();
    const fs::path path = identityOf(file);
    if (std::any_of(files.begin(), files.end(), [&](const ModelFile& known) { return known.path == path; }))
        return;
    if (files.size() == kMostFiles)
        throw UsageError(file + ": more than " + std::to_string(kMostFiles) +
                         " models from files; expected fewer");
    std::vector<ModelFile> all = files;
    all.push_back({path, readBrdfSource(file), {}, {}});
    files = registered(std::move(all));
}

std::vector<std::string> modelNamesOf(const Settings& settings) {
    std::vector<std::string> names;
    forEachFile(settings, [&](const ModelFile& file) { names.push_back(file.name); });
    return names;
}

std::vector<BrdfSource> modelSourcesOf(const Settings& settings) {
    std::vector<BrdfSource> sources;
    forEachFile(settings, [&](const ModelFile& file) { sources.push_back(file.source); });
    return sources;
}

json modelHashesOf(const Settings& settings) {
    json hashes = json::object();
    forEachFile(settings, [&](const ModelFile& file) { hashes[file.name] = file.hash; });
    return hashes;
}

json withFilesIn(const fs::path& folder, json settings) {
    const auto moved = [&](json& file) {
        if (!file.is_string()) return;  // refused where it is read
        const std::string& name = file.get_ref<const std::string&>();
        const bool forced = name.starts_with("!");
        file = (forced ? "!" : "") + (folder / name.substr(forced ? 1 : 0)).string();
    };
    if (!settings.is_object()) return settings;
    for (auto& [key, value] : settings.items()) {
        std::string plain = key.substr(key.starts_with("!") ? 1 : 0);
        std::replace(plain.begin(), plain.end(), '-', '_');
        if (plain != "brdf_file") continue;
        if (value.is_array())
            std::for_each(value.begin(), value.end(), moved);
        else
            moved(value);
    }
    return settings;
}

}  // namespace lobe::app
