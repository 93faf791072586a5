/// A scene as plain data: validated, posed, in metres and radians, independent of files and of OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "scene/environment_source.hpp"
#include "shading/brdf.hpp"
#include "shading/fog.hpp"

namespace lobe {

enum class Wrap : uint8_t { repeat, mirroredRepeat, clampToEdge };
enum class Filter : uint8_t { nearest, linear };
enum class MipFilter : uint8_t { none, nearest, linear };

struct Sampler {
    Wrap wrapS = Wrap::repeat;
    Wrap wrapT = Wrap::repeat;
    Filter magnify = Filter::linear;
    Filter minify = Filter::linear;
    MipFilter mip = MipFilter::linear;
    bool operator==(const Sampler&) const = default;
};

struct Texture {
    int image = -1;  ///< index into Scene::images
    Sampler sampler;
};

/// Use of a texture by a material: which, through which UV set, with which transform (KHR_texture_transform).
struct TextureSlot {
    int texture = -1;  ///< index into Scene::textures; -1: none
    int uvSet = 0;     ///< 0 or 1
    glm::vec2 offset{0.0f};
    float rotation = 0.0f;  ///< radians, counter-clockwise in UV space as the extension defines
    glm::vec2 scale{1.0f};

    explicit operator bool() const { return texture >= 0; }
    bool transformed() const {
        return offset != glm::vec2(0.0f) || rotation != 0.0f || scale != glm::vec2(1.0f);
    }
    bool operator==(const TextureSlot&) const = default;
};

enum class AlphaMode : uint8_t { opaque, mask, blend };

struct Material {
    std::string name;
    std::string brdf = "metallic_roughness";  ///< registry name, or "unlit"
    ParameterValues values;                   ///< of that model
    std::vector<TextureSlot> textures;        ///< one a parameter of that model; multiplied into its value
    std::vector<uint8_t> textureChannels;     ///< for scalar parameters: channel 0..3 of the texture

    /// What glTF's own material said, kept so that another model can be chosen for the whole scene.
    MetallicRoughness metallicRoughness;
    TextureSlot baseColorTexture;
    TextureSlot metallicRoughnessTexture;

    float alpha = 1.0f;  ///< base colour factor's alpha; multiplied by baseColorTexture's alpha
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;

    TextureSlot normalTexture;
    float normalScale = 1.0f;
    TextureSlot occlusionTexture;
    float occlusionStrength = 1.0f;
    glm::vec3 emission{0.0f};  ///< factor times emissive strength: radiance, W/(m^2 sr)
    TextureSlot emissionTexture;
    int fileIndex = -1;  ///< among the materials of the file; -1: not one of them
};

/// Whether the material's model lets light through from behind, and the material any of it: such surfaces are
/// drawn over what lies behind them.
bool seesThrough(const Material& material);

/// A triangle list. Arrays are empty or as long as `positions`.
struct Primitive {
    std::string name;
    int material = -1;  ///< index into Scene::materials, always valid after import
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< never empty after import
    std::vector<glm::vec4>
        tangents;  ///< w = handedness; present iff the material has a normal map or needs a frame
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec4> colors;  ///< linear RGBA, multiplied into base colour and alpha
    std::vector<uint32_t> indices;  ///< 3 a triangle, all below positions.size()

    size_t triangleCount() const { return indices.size() / 3; }
};

struct Instance {
    int primitive = -1;
    glm::dmat4 worldFromLocal{1.0};
    std::string node;
    bool castsShadow = true;  ///< LOBE_shadow
};

/// Punctual lights first: isPunctual().
enum class LightType : uint8_t { directional, point, spot, rect, disk, sphere, tube };

struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::dvec3 position{0.0};  ///< world
    /// World, unit, the way light travels; rect, disk: the normal of the side that emits.
    glm::dvec3 direction{0.0, 0.0, -1.0};
    /// directional: irradiance on a facing surface, W/m^2; point, spot, sphere, tube: radiant intensity, W/sr
    /// (a tube's: seen from the side); rect, disk: radiance, W/(m^2 sr).
    glm::dvec3 intensity{1.0};
    std::optional<double> range;  ///< metres, from the centre; no window where absent; never of rect and disk
    double innerConeAngle = 0.0;  ///< spot, radians
    double outerConeAngle = 0.7853981633974483;
    /// World, unit, at right angles to `direction`: along a rect's width, along a tube.
    glm::dvec3 axis{1.0, 0.0, 0.0};
    double width = 0.0;       ///< rect, along `axis`, metres
    double height = 0.0;      ///< rect, across it, metres
    double radius = 0.0;      ///< disk, sphere, tube, metres
    double length = 0.0;      ///< tube: between the centres of its hemispherical ends, metres
    bool castsShadow = true;  ///< LOBE_shadow
    int image = -1;           ///< rect: index into Scene::images of its picture (LightImage); -1: none
};

constexpr bool isPunctual(LightType type) {
    return type <= LightType::spot;
}

/// Radiance of a light with a body, W/(m^2 sr), before the window of its range. Zero for punctual lights,
/// which have none.
glm::dvec3 radianceOf(const Light& light);

/// Light from infinity, from all sides (LOBE_environment).
struct Environment {
    /// Index into Scene::images of an equirectangular picture of radiance: +Y up, its centre column along +Z,
    /// its left quarter column along +X; -1: `radiance` from everywhere.
    int image = -1;
    glm::dvec3 radiance{1.0};  ///< without an image, W/(m^2 sr)
    double intensity = 1.0;    ///< multiplies the image's radiance
    glm::dmat3 worldFromMap{1.0};
    bool background = true;  ///< seen where no surface is
    /// Index of another such picture that is seen in place of `image`, as the same one blurred or with its
    /// sun; -1: none.
    int backgroundImage = -1;
    bool castsShadow = true;  ///< surfaces keep its light from one another
    /// Index into Scene::lights of its sun, which is in neither `image` nor `radiance`; -1: none.
    int sun = -1;
    EnvironmentSource source;        ///< what `image` is made of, where that is no picture
    std::vector<std::string> notes;  ///< one line each: what was made or taken out of what was given, and why
};

/// Beer-Lambert transmittance of the way from surface to eye (LOBE_fog): sigma(y) = extinction
/// exp(-heightFalloff (y - height)), and radiance (1 - T) added; and the light of lamps that it scatters to
/// the eye.
struct Fog {
    glm::dvec3 extinction{0.0};  ///< 1/m
    glm::dvec3 radiance{0.0};    ///< W/(m^2 sr)
    double heightFalloff = 0.0;  ///< 1/m
    double height = 0.0;         ///< world y, metres
    glm::dvec3 scattering{0.0};  ///< 1/m, at most the extinction; 0 where density falls off with height
    double anisotropy = 0.0;     ///< in (-1, 1): mean cosine of scattering (Henyey and Greenstein)

    FogMedium medium() const { return {extinction, heightFalloff, height, scattering, anisotropy}; }
};

struct Camera {
    std::string name;
    glm::dmat4 worldFromCamera{1.0};  ///< rigid; looks along its -Z, +Y up
    bool orthographic = false;
    double verticalFov = 0.7853981633974483;  ///< radians, perspective
    std::optional<double>
        aspect;         ///< width / height where the file fixes it (then the picture is fitted inside)
    double xMag = 1.0;  ///< half width, orthographic
    double yMag = 1.0;  ///< half height, orthographic
    double zNear = 0.01;
    std::optional<double> zFar;  ///< absent: infinite
};

struct Bounds {
    glm::dvec3 lower{0.0};
    glm::dvec3 upper{0.0};
    bool empty = true;
    void add(const glm::dvec3& point);
    glm::dvec3 center() const { return (lower + upper) * 0.5; }
    double radius() const { return empty ? 0.0 : glm::length(upper - lower) * 0.5; }
};

struct Scene {
    std::string name;  ///< file stem: what {model} in a template stands for
    std::string file;
    std::string contentHash;  ///< of the bytes of the file and of everything that it refers to
    std::vector<Bitmap> images;
    std::vector<std::string> imageNames;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Primitive> primitives;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::optional<glm::dvec3> ambientRadiance;  ///< LOBE_ambient, W/(m^2 sr)
    std::optional<Environment> environment;
    std::optional<Fog> fog;
    std::vector<std::string> warnings;       ///< one line each: what was read otherwise than the file says
    std::vector<double> animationDurations;  ///< seconds, one an animation

    Bounds bounds() const;         ///< of all instances, in world space
    size_t triangleCount() const;  ///< drawn, counting each instance
};

}  // namespace lobe
