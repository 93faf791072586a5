#include "import/gltf_schema.hpp"

#include <cfloat>

#include "scene/sky.hpp"

namespace lobe {

namespace {

constexpr double kLargest = FLT_MAX;
constexpr double kPi = 3.14159265358979323846;

/// Sizes of lights: their squares and the squares' inverses are floats.
constexpr double kSmallestSize = 1e-9;
constexpr double kLargestSize = 1e9;
/// Of scattering: beyond, almost all light goes on straight, in a peak that floats do not resolve.
constexpr double kLargestAnisotropy = 0.999;
ValueRule sizeInMetres() {
    return number(kSmallestSize, kLargestSize);
}

ValueRule numbers(size_t count) {
    return arrayOf(number(), count, count);
}
ValueRule fractions(size_t count) {
    return arrayOf(number(0.0, 1.0), count, count);
}

const ObjectSchema& textureTransform() {
    static const ObjectSchema schema{{optional("offset", numbers(2)), optional("rotation", number()),
                                      optional("scale", numbers(2)), optional("texCoord", integer(0, 1023))}};
    return schema;
}

/// textureInfo; normal and occlusion textures add a factor of their own.
std::vector<PropertyRule> textureInfoProperties() {
    static const ObjectSchema extensions{{optional("KHR_texture_transform", objectOf(textureTransform()))}};
    return {required("index", indexOf("textures")), optional("texCoord", integer(0, 1023)),
            optional("extensions", objectOf(extensions))};
}

const ObjectSchema& textureInfo() {
    static const ObjectSchema schema{textureInfoProperties()};
    return schema;
}

ObjectSchema textureInfoWith(PropertyRule property) {
    ObjectSchema schema{textureInfoProperties()};
    schema.properties.push_back(std::move(property));
    return schema;
}

const ObjectSchema& accessor() {
    static const ObjectSchema sparseIndices{{required("bufferView", indexOf("bufferViews")),
                                             optional("byteOffset", integer(0, INT32_MAX)),
                                             required("componentType", oneOf({5121, 5123, 5125}))}};
    static const ObjectSchema sparseValues{
        {required("bufferView", indexOf("bufferViews")), optional("byteOffset", integer(0, INT32_MAX))}};
    static const ObjectSchema sparse{{required("count", integer(1, INT32_MAX)),
                                      required("indices", objectOf(sparseIndices)),
                                      required("values", objectOf(sparseValues))}};
    static const ObjectSchema schema{
        {optional("bufferView", indexOf("bufferViews")), optional("byteOffset", integer(0)),
         required("componentType", oneOf({5120, 5121, 5122, 5123, 5125, 5126})),
         optional("normalized", boolean()), required("count", integer(1, UINT32_MAX)),
         required("type",
                  oneOf(std::vector<std::string>{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"})),
         optional("sparse", objectOf(sparse))}};
    return schema;
}

const ObjectSchema& animation() {
    static const ObjectSchema target{{optional("node", indexOf("nodes")), required("path", text())}};
    static const ObjectSchema channel{
        {required("sampler", integer(0)), required("target", objectOf(target))}};
    static const ObjectSchema sampler{
        {required("input", indexOf("accessors")), required("output", indexOf("accessors")),
         optional("interpolation", oneOf(std::vector<std::string>{"LINEAR", "STEP", "CUBICSPLINE"}))}};
    static const ObjectSchema schema{{required("channels", arrayOf(objectOf(channel))),
                                      required("samplers", arrayOf(objectOf(sampler))),
                                      optional("name", text())}};
    return schema;
}

const ObjectSchema& camera() {
    static const ObjectSchema perspective{{optional("aspectRatio", numberAbove(0.0)),
                                           required("yfov",
                                                    [] {
                                                        ValueRule rule = numberAbove(0.0);
                                                        rule.maximum = kPi;
                                                        return rule;
                                                    }()),
                                           optional("zfar", numberAbove(0.0)),
                                           required("znear", numberAbove(0.0))}};
    static const ObjectSchema orthographic{{required("xmag", number()), required("ymag", number()),
                                            required("zfar", numberAbove(0.0)),
                                            required("znear", number(0.0, kLargest))}};
    static const ObjectSchema schema{
        {required("type", oneOf(std::vector<std::string>{"perspective", "orthographic"})),
         optional("perspective", objectOf(perspective)), optional("orthographic", objectOf(orthographic)),
         optional("name", text())}};
    return schema;
}

const ObjectSchema& material() {
    static const ObjectSchema metallicRoughness{
        {optional("baseColorFactor", fractions(4)), optional("baseColorTexture", objectOf(textureInfo())),
         optional("metallicFactor", number(0.0, 1.0)), optional("roughnessFactor", number(0.0, 1.0)),
         optional("metallicRoughnessTexture", objectOf(textureInfo()))}};
    static const ObjectSchema normalTexture = textureInfoWith(optional("scale", number()));
    static const ObjectSchema occlusionTexture = textureInfoWith(optional("strength", number(0.0, 1.0)));
    static const ObjectSchema emissiveStrength{{optional("emissiveStrength", number(0.0, kLargest))}};
    static const ObjectSchema transmission{{optional("transmissionFactor", number(0.0, 1.0)),
                                            optional("transmissionTexture", objectOf(textureInfo()))}};
    static const ObjectSchema brdf{{required("model", text())}};
    static const ObjectSchema empty{};
    static const ObjectSchema extensions{
        {optional("KHR_materials_unlit", objectOf(empty)),
         optional("KHR_materials_emissive_strength", objectOf(emissiveStrength)),
         optional("KHR_materials_transmission", objectOf(transmission)),
         optional("LOBE_materials_brdf", objectOf(brdf))}};
    static const ObjectSchema schema{
        {optional("name", text()), optional("pbrMetallicRoughness", objectOf(metallicRoughness)),
         optional("normalTexture", objectOf(normalTexture)),
         optional("occlusionTexture", objectOf(occlusionTexture)),
         optional("emissiveTexture", objectOf(textureInfo())), optional("emissiveFactor", fractions(3)),
         optional("alphaMode", oneOf(std::vector<std::string>{"OPAQUE", "MASK", "BLEND"})),
         optional("alphaCutoff", number(0.0, kLargest)), optional("doubleSided", boolean()),
         optional("extensions", objectOf(extensions))}};
    return schema;
}

const ObjectSchema& mesh() {
    static const ObjectSchema draco{{required("bufferView", indexOf("bufferViews")),
                                     required("attributes", mapOf(integer(0, UINT32_MAX)))}};
    static const ObjectSchema extensions{{optional("KHR_draco_mesh_compression", objectOf(draco))}};
    static const ObjectSchema primitive{
        {required("attributes", mapOf(indexOf("accessors"))), optional("indices", indexOf("accessors")),
         optional("material", indexOf("materials")), optional("mode", integer(0, 6)),
         optional("targets", arrayOf(mapOf(indexOf("accessors")), 1)),
         optional("extensions", objectOf(extensions))}};
    static const ObjectSchema schema{{optional("name", text()),
                                      required("primitives", arrayOf(objectOf(primitive), 1)),
                                      optional("weights", arrayOf(number(), 1))}};
    return schema;
}

const ObjectSchema& node() {
    static const ObjectSchema light{{required("light", integer(0))}};
    static const ObjectSchema shadow{{optional("cast", boolean())}};
    static const ObjectSchema visible{{optional("visible", boolean())}};
    static const ObjectSchema extensions{
        {optional(kLightsExtension, objectOf(light)), optional(kAreaLightsExtension, objectOf(light)),
         optional(kShadowExtension, objectOf(shadow)), optional(kVisibleLightExtension, objectOf(visible))}};
    static const ObjectSchema schema{
        {optional("name", text()), optional("camera", indexOf("cameras")),
         optional("children", arrayOf(indexOf("nodes"))), optional("skin", indexOf("skins")),
         optional("matrix", numbers(16)), optional("mesh", indexOf("meshes")),
         optional("rotation", numbers(4)), optional("scale", numbers(3)), optional("translation", numbers(3)),
         optional("weights", arrayOf(number(), 1)), optional("extensions", objectOf(extensions))}};
    return schema;
}

const ObjectSchema& scene() {
    static const ObjectSchema ambient{{optional("radiance", arrayOf(number(0.0, kLargest), 3, 3))}};
    const auto colour = [] { return arrayOf(number(0.0, kLargest), 3, 3); };
    constexpr double kRightAngle = kPi / 2 + 1e-6, kLargestSun = 0.2;
    static const ObjectSchema sky{
        {required("model", oneOf(std::vector<std::string>{"constant", "gradient", "preetham"})),
         optional("zenith", colour()), optional("horizon", colour()), optional("ground", colour()),
         optional("turbidity", number(kLeastTurbidity, kMostTurbidity)),
         optional("sunElevation", number(0.0, kRightAngle)), optional("sunAzimuth", number()),
         optional("sunDiameter", number(0.0, kLargestSun))}};
    static const ObjectSchema environment{
        {optional("image", text()), optional("radiance", colour()), optional("sky", objectOf(sky)),
         optional("intensity", number(0.0, kLargest)), optional("rotation", numbers(4)),
         optional("background", boolean())}};
    static const ObjectSchema fog{{optional("extinction", arrayOf(number(0.0, kLargest), 3, 3)),
                                   optional("radiance", arrayOf(number(0.0, kLargest), 3, 3)),
                                   optional("heightFalloff", number(0.0, kLargest)),
                                   optional("height", number()),
                                   optional("scattering", arrayOf(number(0.0, kLargest), 3, 3)),
                                   optional("anisotropy", number(-kLargestAnisotropy, kLargestAnisotropy))}};
    static const ObjectSchema imageBased{{required("light", integer(0))}};
    static const ObjectSchema extensions{
        {optional(kImageBasedExtension, objectOf(imageBased)), optional("LOBE_ambient", objectOf(ambient)),
         optional("LOBE_environment", objectOf(environment)), optional("LOBE_fog", objectOf(fog))}};
    static const ObjectSchema schema{{optional("name", text()), optional("nodes", arrayOf(indexOf("nodes"))),
                                      optional("extensions", objectOf(extensions))}};
    return schema;
}

const ObjectSchema& texture() {
    static const ObjectSchema webp{{required("source", indexOf("images"))}};
    static const ObjectSchema extensions{{optional("EXT_texture_webp", objectOf(webp))}};
    static const ObjectSchema schema{{optional("sampler", indexOf("samplers")),
                                      optional("source", indexOf("images")),
                                      optional("extensions", objectOf(extensions))}};
    return schema;
}

const ObjectSchema& rootExtensions() {
    // Right angles that were rounded to float on their way are a little over pi / 2.
    constexpr double kRightAngle = kPi / 2 + 1e-6;
    static const ObjectSchema spot{{optional("innerConeAngle", number(0.0, kRightAngle)),
                                    optional("outerConeAngle", number(0.0, kRightAngle))}};
    static const ObjectSchema shape{{required("shape", oneOf(std::vector<std::string>{"sphere", "tube"})),
                                     required("radius", sizeInMetres()),
                                     optional("length", number(0.0, kLargestSize))}};
    static const ObjectSchema image{{required("image", text())}};
    static const ObjectSchema lightExtensions{
        {optional(kLightShapeExtension, objectOf(shape)), optional(kLightImageExtension, objectOf(image))}};
    static const ObjectSchema areaLightExtensions{{optional(kLightImageExtension, objectOf(image))}};
    static const ObjectSchema light{
        {optional("name", text()),
         required("type", oneOf(std::vector<std::string>{"directional", "point", "spot"})),
         optional("color", arrayOf(number(0.0, kLargest), 3, 3)),
         optional("intensity", number(0.0, kLargest)), optional("range", numberAbove(0.0)),
         optional("spot", objectOf(spot)), optional("extensions", objectOf(lightExtensions))}};
    static const ObjectSchema lights{{required("lights", arrayOf(objectOf(light)))}};
    static const ObjectSchema rect{{optional("aspect", sizeInMetres())}};
    static const ObjectSchema areaLight{
        {optional("name", text()), required("type", oneOf(std::vector<std::string>{"rect", "disk"})),
         optional("color", arrayOf(number(0.0, kLargest), 3, 3)),
         optional("intensity", number(0.0, kLargest)), optional("size", sizeInMetres()),
         optional("rect", objectOf(rect)), optional("extensions", objectOf(areaLightExtensions))}};
    static const ObjectSchema areaLights{{required("lights", arrayOf(objectOf(areaLight)))}};
    static const ObjectSchema imageBasedLight{
        {optional("name", text()), optional("rotation", numbers(4)),
         optional("intensity", number(0.0, kLargest)),
         optional("irradianceCoefficients", arrayOf(numbers(3), 9, 9)),
         optional("specularImages", arrayOf(arrayOf(indexOf("images"), 6, 6))),
         optional("specularImageSize", integer(1))}};
    static const ObjectSchema imageBasedLights{{required("lights", arrayOf(objectOf(imageBasedLight)))}};
    static const ObjectSchema schema{{optional(kLightsExtension, objectOf(lights)),
                                      optional(kAreaLightsExtension, objectOf(areaLights)),
                                      optional(kImageBasedExtension, objectOf(imageBasedLights))}};
    return schema;
}

}  // namespace

const ObjectSchema& gltfSchema() {
    static const ObjectSchema asset{{required("version", text()), optional("minVersion", text())}};
    static const ObjectSchema buffer{{optional("uri", text()), required("byteLength", integer(1))}};
    static const ObjectSchema bufferView{
        {required("buffer", indexOf("buffers")), optional("byteOffset", integer(0)),
         required("byteLength", integer(1)), optional("byteStride", integer(4, 252))}};
    static const ObjectSchema image{{optional("uri", text()), optional("mimeType", text()),
                                     optional("bufferView", indexOf("bufferViews")),
                                     optional("name", text())}};
    static const ObjectSchema sampler{{optional("magFilter", oneOf({9728, 9729})),
                                       optional("minFilter", oneOf({9728, 9729, 9984, 9985, 9986, 9987})),
                                       optional("wrapS", oneOf({33071, 33648, 10497})),
                                       optional("wrapT", oneOf({33071, 33648, 10497}))}};
    static const ObjectSchema skin{
        {optional("inverseBindMatrices", indexOf("accessors")), optional("skeleton", indexOf("nodes")),
         required("joints", arrayOf(indexOf("nodes"), 1)), optional("name", text())}};
    static const ObjectSchema root{
        {required("asset", objectOf(asset)), optional("extensionsUsed", arrayOf(text())),
         optional("extensionsRequired", arrayOf(text())),
         optional("accessors", arrayOf(objectOf(accessor()))),
         optional("animations", arrayOf(objectOf(animation()))),
         optional("buffers", arrayOf(objectOf(buffer))),
         optional("bufferViews", arrayOf(objectOf(bufferView))),
         optional("cameras", arrayOf(objectOf(camera()))), optional("images", arrayOf(objectOf(image))),
         optional("materials", arrayOf(objectOf(material()))), optional("meshes", arrayOf(objectOf(mesh()))),
         optional("nodes", arrayOf(objectOf(node()))), optional("samplers", arrayOf(objectOf(sampler))),
         optional("scene", indexOf("scenes")), optional("scenes", arrayOf(objectOf(scene()))),
         optional("skins", arrayOf(objectOf(skin))), optional("textures", arrayOf(objectOf(texture()))),
         optional("extensions", objectOf(rootExtensions()))}};
    return root;
}

}  // namespace lobe
