#include "import/surroundings.hpp"

#include <glm/gtc/quaternion.hpp>

#include "import/nodes.hpp"
#include "import/refuse.hpp"

namespace lobe {

using nlohmann::json;

namespace {

glm::dvec3 rgbOf(const json& object, const char* name, const glm::dvec3& absent) {
    const auto found = object.find(name);
    return found == object.end()
               ? absent
               : glm::dvec3((*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>());
}

Environment readEnvironment(Document& document, TextureTable& images, const json& source,
                            const std::string& property) {
    Environment environment;
    const bool image = source.contains("image");
    if (image == source.contains("radiance")) {
        refuse(document.file, property, image ? "both image and radiance" : "neither image nor radiance",
               "one of them");
    }
    environment.intensity = source.value("intensity", 1.0);
    environment.background = source.value("background", true);
    if (!image) {
        environment.radiance = rgbOf(source, "radiance", {});
        return environment;
    }
    environment.image = images.addFile(source["image"], property + ".image");
    if (source.contains("rotation")) {
        const json& q = source["rotation"];
        const glm::dquat rotation(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(),
                                  q[2].get<double>());
        const double length = glm::length(rotation);
        constexpr double kTolerance = 1e-3;  // written as floats, or rounded by hand
        if (!(std::abs(length - 1.0) <= kTolerance)) {
            refuse(document.file, property + ".rotation", shown(q), "a unit quaternion x, y, z, w");
        }
        environment.worldFromMap = glm::mat3_cast(rotation / length);
    }
    return environment;
}

Fog readFog(Document& document, const json& source, const std::string& property) {
    Fog fog;
    fog.extinction = rgbOf(source, "extinction", fog.extinction);
    fog.radiance = rgbOf(source, "radiance", fog.radiance);
    fog.heightFalloff = source.value("heightFalloff", 0.0);
    fog.height = source.value("height", 0.0);
    fog.scattering = rgbOf(source, "scattering", fog.scattering);
    fog.anisotropy = source.value("anisotropy", 0.0);
    for (int c = 0; c < 3; ++c) {
        if (fog.scattering[c] > fog.extinction[c]) {
            refuse(document.file, at(property + ".scattering", static_cast<size_t>(c)), fog.scattering[c],
                   "at most the extinction, which it is a part of");
        }
    }
    if (fog.heightFalloff > 0.0 && fog.scattering != glm::dvec3(0.0)) {
        document.warn(property, "scattering is supported in fog without heightFalloff only; left out");
        fog.scattering = glm::dvec3(0.0);
    }
    return fog;
}

}  // namespace

void readSurroundings(Document& document, TextureTable& images, Scene& scene) {
    const auto shown = shownScene(document);
    if (!shown) {
        return;
    }
    const auto extension = [&](const char* name) { return document.extension("scenes", *shown, name); };
    if (const json* ambient = extension("LOBE_ambient");
        ambient != nullptr && ambient->contains("radiance")) {
        scene.ambientRadiance = rgbOf(*ambient, "radiance", {});
    }
    if (const json* environment = extension("LOBE_environment")) {
        scene.environment = readEnvironment(document, images, *environment,
                                            at("scenes", *shown, "extensions.LOBE_environment"));
    }
    if (const json* source = extension("LOBE_fog")) {
        const Fog fog = readFog(document, *source, at("scenes", *shown, "extensions.LOBE_fog"));
        if (fog.extinction != glm::dvec3(0.0)) {
            scene.fog = fog;
        }
    }
}

}  // namespace lobe
