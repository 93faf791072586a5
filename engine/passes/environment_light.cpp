#include "passes/environment_light.hpp"

#include <memory>

#include "environment/harmonics.hpp"
#include "fit/table_cache.hpp"
#include "math/low_discrepancy.hpp"

namespace lobe {
namespace {

/// Beyond those that other inputs take, and that of the tables of models; combined units reach to 48.
constexpr int kMapUnit = 28, kDirectionsUnit = 29, kLightUnit = 30;

gl::Texture upload(int width, int height, const std::vector<float>& rgba, GLint filter) {
    gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, rgba.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

/// The picture with a row more at each end, and the density of draws beside it.
gl::Texture uploadMap(const EnvironmentMap& map) {
    std::vector<float> texels;
    texels.reserve(4 * static_cast<size_t>(map.width()) * static_cast<size_t>(map.height() + 2));
    for (int y = -1; y <= map.height(); ++y)
        for (int x = 0; x < map.width(); ++x) {
            const glm::dvec3 rgb = map.at(x, y);
            for (int c = 0; c < 3; ++c)
                texels.push_back(static_cast<float>(rgb[c]));
            texels.push_back(y < 0 || y >= map.height() ? 0.0F : static_cast<float>(map.densityAt(x, y)));
        }
    return upload(map.width(), map.height() + 2, texels, GL_NEAREST);
}

/// Runs of a power of two are spread over the brightness as well as they can be.
gl::TextureBuffer uploadDirections(const EnvironmentMap& map) {
    const OwenSobol points({0, 0}, 1);
    std::vector<float> texels;
    texels.reserve(8 * static_cast<size_t>(kEnvironmentDirections));
    for (uint32_t i = 0; i < kEnvironmentDirections; ++i) {
        const glm::dvec3 direction = map.draw(points.at(i, 0), points.at(i, 1));
        const glm::dvec3 radiance = map.radiance(direction);
        for (int c = 0; c < 3; ++c)
            texels.push_back(static_cast<float>(direction[c]));
        texels.push_back(static_cast<float>(map.density(direction)));
        for (int c = 0; c < 3; ++c)
            texels.push_back(static_cast<float>(radiance[c]));
        texels.push_back(0.0F);
    }
    return gl::makeTextureBuffer(GL_RGBA32F, texels.data(), texels.size() * sizeof(float));
}

environment::Request requestOf(const AreaForm& form, bool irradiance) {
    environment::Request request{form.request, form.widths, irradiance};
    request.lobe.colorsVary = true;  // colours weigh what is made: one serves them all
    return request;
}

/// All that decides what is made for the environment of a scene, but for the texels of its images.
std::string madeOf(const Environment& environment, const FramePlan& plan) {
    std::string text;
    const auto add = [&](const auto& value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    add(environment.image);
    add(environment.background ? environment.backgroundImage : -1);
    add(plan.environmentMap);
    add(plan.environmentSamples);
    add(plan.quality.envDiffuse);
    // Maps are turned and scaled where they are looked up; draws and harmonics are made of what they give.
    if (plan.environmentSamples > 0 || plan.quality.envDiffuse != EnvironmentDiffuse::map) {
        add(environment.worldFromMap);
        add(environment.intensity);
        add(environment.radiance);
    }
    for (const auto& [model, how] : plan.environmentMethods) {
        if (how.method != EnvironmentMethod::prefiltered) continue;
        text += model + " ";
    }
    return text;
}

/// And which lobes of each model it was made for.
std::string lobesOf(const FramePlan& plan) {
    std::string text;
    for (const auto& [model, how] : plan.environmentMethods) {
        if (how.method != EnvironmentMethod::prefiltered) continue;
        const environment::Request request = requestOf(how.form, true);
        text += fit::tableKey(request.lobe);
        for (const double width : {request.widths.first, request.widths.second})
            text.append(reinterpret_cast<const char*>(&width), sizeof width);
    }
    return text;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Scene& scene, const FramePlan& plan, EnvironmentLight* earlier,
                                   bool borrow) {
    if (!scene.environment) return;
    made_ = madeOf(*scene.environment, plan);
    lobes_ = lobesOf(plan);
    if (earlier != nullptr && earlier->made_ == made_ && (borrow || earlier->lobes_ == lobes_)) {
        const bool others = earlier->lobes_ != lobes_;
        *this = std::move(*earlier);
        borrowed_ = others;
        // As EnvironmentMap has them, without the texels, of which it would make a copy.
        Environment bare = *scene.environment;
        if (bare.image >= 0) bare.radiance = glm::dvec3(1.0);
        const EnvironmentMap turned(bare, nullptr);
        mapFromWorld_ = glm::mat3(turned.mapFromWorld());
        scale_ = glm::vec3(turned.scale());
        return;
    }
    const EnvironmentMap map = EnvironmentMap::of(scene);
    mapFromWorld_ = glm::mat3(map.mapFromWorld());
    scale_ = glm::vec3(map.scale());
    if (plan.environmentMap) map_ = uploadMap(map);
    if (scene.environment->background && scene.environment->backgroundImage >= 0)
        background_ = uploadMap(EnvironmentMap::ofBackground(scene));
    if (plan.environmentSamples > 0) directions_ = uploadDirections(map);

    std::unique_ptr<environment::RadianceTree> tree;
    const auto grown = [&]() -> const environment::RadianceTree& {
        if (!tree) tree = std::make_unique<environment::RadianceTree>(map);
        return *tree;
    };
    const environment::Cache cache;
    const bool irradiance = plan.quality.envDiffuse == EnvironmentDiffuse::map;
    for (const auto& [model, how] : plan.environmentMethods) {
        if (how.method != EnvironmentMethod::prefiltered) continue;
        const environment::Request request = requestOf(how.form, irradiance);
        const std::string key = keyOf(map, request);
        std::optional<environment::Prefiltered> made = cache.find(key);
        if (!made) {
            made = environment::prefiltered(grown(), request);
            cache.keep(key, *made);
        }
        gl::Texture texture = upload(made->width, made->height, made->texels, GL_LINEAR);
        made->texels = {};
        prefiltered_.emplace(model, Prefiltered{std::move(*made), std::move(texture)});
    }
    if (!prefiltered_.empty() && !irradiance)
        harmonics_ = environment::irradianceHarmonics(
            grown(), plan.quality.envDiffuse == EnvironmentDiffuse::sh2 ? 2 : 4);
}

void EnvironmentLight::setPairs(const gl::Program& program, int first, int end) {
    program.set("uEnvPairsFirst", first);
    program.set("uEnvPairsEnd", end);
    program.set("uEnvMirrored", first == 0 ? 1 : 0);
}

int EnvironmentLight::bindMap(const gl::Program& program, int unit, const gl::Texture& map) const {
    if (!map || program.uniform("uEnvMap") < 0) return unit;
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, map.id());
    glBindSampler(static_cast<GLuint>(unit), 0);
    program.set("uEnvMap", unit);
    program.set("uEnvMapFromWorld", mapFromWorld_);
    program.set("uEnvScale", scale_);
    return unit + 1;
}

void EnvironmentLight::bindBackground(const gl::Program& program, int unit) const {
    bindMap(program, unit, background_ ? background_ : map_);
}

int EnvironmentLight::bind(const gl::Program& program, int firstUnit, const std::string& model,
                           int samples) const {
    bindMap(program, kMapUnit, map_);
    program.set("uEnvMirrored", 1);
    if (directions_.texture && program.uniform("uEnvDirections") >= 0) {
        glActiveTexture(GL_TEXTURE0 + kDirectionsUnit);
        glBindTexture(GL_TEXTURE_BUFFER, directions_.texture.id());
        program.set("uEnvDirections", kDirectionsUnit);
        program.set("uEnvFrame", frame_);
        program.set("uEnvPairsAll", pairsOf(samples));
        setPairs(program, 0, pairsOf(samples));
    }
    const auto found = prefiltered_.find(model);
    if (found == prefiltered_.end() || program.uniform("uEnvLight") < 0) return firstUnit;
    const environment::Prefiltered& layout = found->second.layout;
    glActiveTexture(GL_TEXTURE0 + kLightUnit);
    glBindTexture(GL_TEXTURE_2D, found->second.texture.id());
    glBindSampler(kLightUnit, 0);
    program.set("uEnvLight", kLightUnit);
    program.set("uEnvFromWorld", mapFromWorld_);
    program.set("uEnvLightScale", scale_);
    program.set("uEnvTable", glm::vec3(layout.tableX, layout.tableY, layout.tableRows));
    program.set("uEnvWidths", glm::vec2(layout.firstLogWidth, layout.rowsPerLogWidth));
    const auto square = [](const environment::Square& s) { return glm::vec3(s.x, s.y, s.size); };
    program.set("uEnvIrradiance", square(layout.irradiance));
    program.set("uEnvLayerCount", static_cast<int>(layout.layers.size()));
    for (size_t i = 0; i < layout.layers.size(); ++i)
        program.set("uEnvLayers[" + std::to_string(i) + "]", square(layout.layers[i]));
    for (size_t i = 0; i < harmonics_.size(); ++i)
        program.set("uEnvHarmonics[" + std::to_string(i) + "]", harmonics_[i]);
    return firstUnit;
}

}  // namespace lobe
