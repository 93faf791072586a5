#include "shot_environment.hpp"

#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>

#include "base/content_hash.hpp"
#include "base/error.hpp"
#include "environment/blurred_picture.hpp"
#include "image/image_files.hpp"
#include "scene/environment_picture.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::array<std::array<const char*, 6>, 2> kFaceNames{
    {{"px", "nx", "py", "ny", "pz", "nz"}, {"posx", "negx", "posy", "negy", "posz", "negz"}}};

struct Picture {
    Bitmap bitmap;
    ContentHash hash;
};

Bitmap decoded(ImageFiles& files, const fs::path& file, ContentHash& hash) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string() + ": cannot be read; expected a picture of an environment");
    const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    hash.add(std::as_bytes(std::span(bytes)));
    return files.decode(std::as_bytes(std::span(bytes)), file.string());
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

Bitmap sixFaces(ImageFiles& files, const fs::path& given, ContentHash& hash) {
    for (const auto& names : kFaceNames) {
        if (!faceFile(given, names[0])) continue;
        std::array<Bitmap, 6> faces;
        for (size_t i = 0; i < faces.size(); ++i) {
            const auto file = faceFile(given, names[i]);
            if (!file)
                throw InputError(given.string() + ": no face " + names[i] +
                                 "; expected px, nx, py, ny, pz and nz, or " +
                                 "posx, negx, posy, negy, posz and negz");
            faces[i] = decoded(files, *file, hash);
        }
        return fromCubeFaces(faces, given.string());
    }
    throw InputError(given.string() + ": no face px or posx; expected six faces of a cube");
}

Picture read(const std::string& file) {
    ImageFiles files;
    Picture picture;
    if (file.find('*') != std::string::npos || fs::is_directory(file)) {
        picture.bitmap = sixFaces(files, file, picture.hash);
        return picture;
    }
    picture.bitmap = decoded(files, file, picture.hash);
    if (isCubeCross(picture.bitmap)) picture.bitmap = fromCubeCross(picture.bitmap);
    return picture;
}

int addPicture(Scene& scene, Bitmap bitmap, const std::string& name) {
    scene.imageNames.resize(scene.images.size());
    scene.images.push_back(std::move(bitmap));
    scene.imageNames.push_back(name);
    return static_cast<int>(scene.images.size()) - 1;
}

}  // namespace

bool hasEnvironment(const Scene& scene, const Settings& settings) {
    return scene.environment.has_value() || !settings.get("env").is_null();
}

json environmentChanges(const Scene& scene, const Settings& settings) {
    json changes = json::object();
    if (const json& file = settings.get("env"); !file.is_null()) changes["env"] = file;
    if (const json& turn = settings.get("env_rotation"); turn != 0.0) changes["env_rotation"] = turn;
    if (const json& factor = settings.get("env_intensity"); factor != 1.0) changes["env_intensity"] = factor;
    if (const json& seen = settings.get("env_background"); !seen.is_null()) changes["env_background"] = seen;
    if (!changes.empty() && !hasEnvironment(scene, settings)) return json::object();
    return changes;
}

void turnEnvironment(Environment& environment, const Settings& settings) {
    const double turn = glm::radians(settings.get("env_rotation").get<double>());
    environment.worldFromMap =
        glm::dmat3(glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0.0, 1.0, 0.0))) * environment.worldFromMap;
    environment.intensity *= settings.get("env_intensity").get<double>();
}

void applyEnvironment(Scene& scene, const Settings& settings) {
    if (environmentChanges(scene, settings).empty()) return;
    if (const json& file = settings.get("env"); !file.is_null()) {
        const std::string name = file.get<std::string>();
        Picture picture = read(name);
        if (auto warning = badTexelWarning(picture.bitmap)) scene.warnings.push_back(name + ": " + *warning);
        scene.environment = Environment{};
        scene.environment->image = addPicture(scene, std::move(picture.bitmap), name);
        const std::string both = scene.contentHash + picture.hash.hex();
        ContentHash hash;
        hash.add(std::as_bytes(std::span(both)));
        scene.contentHash = hash.hex();
    }
    Environment& environment = *scene.environment;
    turnEnvironment(environment, settings);
    const json& seen = settings.get("env_background");
    if (seen.is_null()) return;
    environment.background = seen != "hide";
    if (seen == "blur" && environment.image >= 0)
        environment.backgroundImage = addPicture(scene, blurredPicture(EnvironmentMap::of(scene)), "blurred");
}

}  // namespace lobe::app
