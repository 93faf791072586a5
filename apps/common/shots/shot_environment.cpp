#include "shot_environment.hpp"

#include <fstream>
#include <glm/trigonometric.hpp>
#include <iterator>

#include "base/content_hash.hpp"
#include "base/error.hpp"
#include "environment/blurred_picture.hpp"
#include "image/image_files.hpp"
#include "scene/environment_picture.hpp"
#include "scene/made_environment.hpp"
#include "shot_sky.hpp"
#include "shot_sun.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::array<std::array<const char*, 6>, 2> kFaceNames{
    {{"px", "nx", "py", "ny", "pz", "nz"}, {"posx", "negx", "posy", "negy", "posz", "negz"}}};

struct Picture {
    Bitmap bitmap;
    ContentHash hash;
    std::vector<std::string> warnings;
};

/// The picture of a file, which goes into the hash and the warnings of the whole.
Bitmap decoded(ImageFiles& files, const fs::path& file, Picture& whole) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string() + ": cannot be read; expected a picture of an environment");
    const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    whole.hash.add(std::as_bytes(std::span(bytes)));
    Bitmap bitmap = files.decode(std::as_bytes(std::span(bytes)), file.string());
    if (auto warning = badTexelWarning(bitmap)) whole.warnings.push_back(file.string() + ": " + *warning);
    return bitmap;
}

/// The file of one face: of a folder, or of a pattern whose * stands for the face's name.
std::optional<fs::path> faceFile(const fs::path& given, const std::string& name) {
    const std::string text = given.string();
    if (const size_t star = text.find('*'); star != std::string::npos) {
        fs::path file = text.substr(0, star) + name + text.substr(star + 1);
        return fs::exists(file) ? std::optional(file) : std::nullopt;
    }
    for (const char* extension : {".hdr", ".exr", ".png", ".jpg", ".jpeg", ".webp"})
        if (fs::path file = given / (name + extension); fs::exists(file)) return file;
    return {};
}

Bitmap sixFaces(ImageFiles& files, const fs::path& given, Picture& whole) {
    for (const auto& names : kFaceNames) {
        if (!faceFile(given, names[0])) continue;
        std::array<Bitmap, 6> faces;
        for (size_t i = 0; i < faces.size(); ++i) {
            const auto file = faceFile(given, names[i]);
            if (!file)
                throw InputError(given.string() + ": no face " + names[i] +
                                 "; expected px, nx, py, ny, pz and nz, or " +
                                 "posx, negx, posy, negy, posz and negz");
            faces[i] = decoded(files, *file, whole);
        }
        return fromCubeFaces(faces, given.string());
    }
    throw InputError(given.string() + ": no face px or posx; expected six faces of a cube");
}

Picture read(const std::string& file) {
    ImageFiles files;
    Picture picture;
    if (file.find('*') != std::string::npos || fs::is_directory(file)) {
        picture.bitmap = sixFaces(files, file, picture);
        return picture;
    }
    picture.bitmap = decoded(files, file, picture);
    if (isCubeCross(picture.bitmap)) picture.bitmap = fromCubeCross(picture.bitmap);
    return picture;
}

}  // namespace

bool hasEnvironment(const Scene& scene, const Settings& settings) {
    return scene.environment.has_value() || !settings.get("env").is_null() || !settings.get("sky").is_null();
}

json environmentChanges(const Scene& scene, const Settings& settings) {
    json changes = skyChanges(scene, settings);
    changes.update(sunChanges(scene, settings));
    if (const json& file = settings.get("env"); !file.is_null()) changes["env"] = file;
    if (const json& turn = settings.get("env_rotation"); turn != 0.0) changes["env_rotation"] = turn;
    if (const json& factor = settings.get("env_intensity"); factor != 1.0) changes["env_intensity"] = factor;
    if (const json& seen = settings.get("env_background"); !seen.is_null()) changes["env_background"] = seen;
    return changes;
}

void placeEnvironment(Scene& scene, const Settings& settings) {
    if (!scene.environment) return;
    turnEnvironment(scene, glm::radians(settings.get("env_rotation").get<double>()));
    scaleEnvironment(scene, settings.get("env_intensity").get<double>());
}

void applyEnvironment(Scene& scene, const Settings& settings) {
    const json changes = environmentChanges(scene, settings);
    if (changes.empty()) return;
    if (!hasEnvironment(scene, settings)) {
        std::string names;
        for (const auto& [name, value] : changes.items())
            names += (names.empty() ? "" : ", ") + name;
        scene.warnings.push_back(names + ": the scene has no environment; nothing is changed by it");
        return;
    }
    if (const json& file = settings.get("env"); !file.is_null()) {
        const std::string name = file.get<std::string>();
        Picture picture = read(name);
        scene.warnings.insert(scene.warnings.end(), picture.warnings.begin(), picture.warnings.end());
        removeEnvironment(scene);
        scene.environment = Environment{};
        scene.environment->image = addPicture(scene, std::move(picture.bitmap), name);
        const std::string both = scene.contentHash + picture.hash.hex();
        ContentHash hash;
        hash.add(std::as_bytes(std::span(both)));
        scene.contentHash = hash.hex();
    }
    // Before what is made for the background: a sun is drawn into that alone.
    if (const json& shown = settings.get("env_background"); !shown.is_null() && scene.environment)
        scene.environment->background = shown != "hide";
    applySky(scene, settings);
    applySun(scene, settings);
    placeEnvironment(scene, settings);
    Environment& environment = *scene.environment;
    const json& seen = settings.get("env_background");
    if (seen.is_null()) return;
    environment.background = seen != "hide";
    if (seen == "blur" && environment.image >= 0)
        environment.backgroundImage =
            addPicture(scene, blurredPicture(EnvironmentMap::ofBackground(scene)), "blurred");
}

}  // namespace lobe::app
