#include "import/surroundings.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "import/gltf_schema.hpp"
#include "import/nodes.hpp"
#include "import/refuse.hpp"
#include "scene/sky.hpp"

namespace lobe {

using nlohmann::json;

namespace {

glm::dvec3 rgbOf(const json& object, const char* name, const glm::dvec3& absent) {
    const auto found = object.find(name);
    return found == object.end()
               ? absent
               : glm::dvec3((*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>());
}

glm::dmat3 rotationOf(const Document& document, const json& source, const std::string& property) {
    const auto found = source.find("rotation");
    if (found == source.end()) {
        return glm::dmat3(1.0);
    }
    const json& q = *found;
    const glm::dquat rotation(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>());
    const double length = glm::length(rotation);
    constexpr double kTolerance = 1e-3;  // written as floats, or rounded by hand
    if (!(std::abs(length - 1.0) <= kTolerance)) {
        refuse(document.file, property + ".rotation", shown(q), "a unit quaternion x, y, z, w");
    }
    return glm::mat3_cast(rotation / length);
}

Sky readSky(const json& source) {
    const std::string model = source["model"];
    Sky sky = defaultSky(model == "constant"   ? SkyModel::constant
                         : model == "gradient" ? SkyModel::gradient
                                               : SkyModel::preetham);
    sky.zenith = rgbOf(source, "zenith", sky.zenith);
    sky.horizon = rgbOf(source, "horizon", sky.horizon);
    sky.ground = rgbOf(source, "ground", sky.ground);
    sky.turbidity = source.value("turbidity", sky.turbidity);
    sky.sunElevation = std::min(source.value("sunElevation", sky.sunElevation), std::numbers::pi / 2.0);
    sky.sunAzimuth = source.value("sunAzimuth", sky.sunAzimuth);
    sky.sunDiameter = source.value("sunDiameter", sky.sunDiameter);
    return sky;
}

Environment readEnvironment(Document& document, TextureTable& images, const json& source,
                            const std::string& property) {
    Environment environment;
    const int ways = (source.contains("image") ? 1 : 0) + (source.contains("radiance") ? 1 : 0) +
                     (source.contains("sky") ? 1 : 0);
    if (ways != 1) {
        refuse(document.file, property,
               ways == 0 ? "neither image, radiance nor sky" : "more than one of image, radiance and sky",
               "one of them");
    }
    environment.intensity = source.value("intensity", 1.0);
    environment.background = source.value("background", true);
    if (source.contains("radiance")) {
        environment.radiance = rgbOf(source, "radiance", {});
        return environment;
    }
    if (source.contains("sky")) {
        environment.source.sky = readSky(source["sky"]);
    } else {
        environment.image = images.addFile(source["image"], property + ".image");
    }
    environment.worldFromMap = rotationOf(document, source, property);
    return environment;
}

Environment readImageBased(Document& document, TextureTable& images, const json& reference,
                           const std::string& property) {
    const json& root = document.json["extensions"];
    const json lights =
        root.contains(kImageBasedExtension) ? root[kImageBasedExtension]["lights"] : json::array();
    const auto index = reference["light"].get<size_t>();
    if (index >= lights.size()) {
        refuse(document.file, property + ".light", index,
               "the index of one of the " + std::to_string(lights.size()) + " lights of " +
                   kImageBasedExtension);
    }
    const json& source = lights[index];
    const std::string where = at(std::string("extensions.") + kImageBasedExtension + ".lights", index);
    Environment environment;
    environment.intensity = source.value("intensity", 1.0);
    environment.worldFromMap = rotationOf(document, source, where);
    ImageBasedLight light;
    for (const json& rgb : source.value("irradianceCoefficients", json::array())) {
        light.harmonics.emplace_back(rgb[0].get<double>(), rgb[1].get<double>(), rgb[2].get<double>());
    }
    const json levels = source.value("specularImages", json::array());
    if (levels.empty()) {
        if (light.harmonics.empty()) {
            refuse(document.file, where, "neither specularImages nor irradianceCoefficients", "them both");
        }
        document.warn(where, "has no specularImages; the environment is made of its irradianceCoefficients");
    } else {
        if (light.harmonics.empty()) {
            document.warn(where, "has no irradianceCoefficients; irradiance is computed from specularImages");
        }
        for (const json& image : levels[0]) {
            light.faces.push_back(images.addOwn(image.get<size_t>()));
        }
    }
    environment.source.imageBased = std::move(light);
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
    const json* environment = extension("LOBE_environment");
    if (const json* light = extension(kImageBasedExtension)) {
        const std::string property = at("scenes", *shown, std::string("extensions.") + kImageBasedExtension);
        if (environment != nullptr) {
            document.warn(property, "left out: the scene has a LOBE_environment too");
        } else {
            scene.environment = readImageBased(document, images, *light, property);
        }
    }
    if (environment != nullptr) {
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
