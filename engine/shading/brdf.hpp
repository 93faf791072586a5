/// The registry of reflectance models: each model's parameters, traits and double-precision twin, declared
/// once, in its one file of engine/shading/brdf. The GLSL struct and its packing, the glTF reading, the
/// G-buffer channels, the command line and the documentation are derived from what stands there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shading/area_model.hpp"
#include "shading/sampling_lobe.hpp"

namespace lobe {

/// A number, an RGB triple, a choice among named variants (stored as its index), or a table (stored as the
/// place of its first row in the buffer that GLSL reads tables from).
enum class ParameterKind : uint8_t { scalar, rgb, choice, table };

struct Parameter {
    std::string name;      ///< as in glTF (LOBE_materials_brdf), lowerCamelCase: "diffuse", "shininess"
    std::string glslName;  ///< as in the GLSL struct, snake_case
    ParameterKind kind = ParameterKind::scalar;
    glm::dvec3 defaultValue{0.0};  ///< scalars and choices use .x
    double minimum = 0.0;          ///< inclusive range, per channel
    double maximum = 1.0;
    std::string unit = "1";      ///< "1" for none
    std::string description;     ///< one line
    bool textureIsSrgb = false;  ///< colour-coded texture (diffuse, specular, base colour)
    bool mayBeTextured = true;
    std::vector<std::string> choices;  ///< for ParameterKind::choice
    /// Object of the scene format that holds the parameter: "fresnel", whose "type" is the group's choice.
    std::string group;
    /// The part of the range that surfaces use, where the range itself is far wider; tests and plots sample
    /// it.
    std::optional<std::pair<double, double>> usual;

    int components() const { return kind == ParameterKind::rgb ? 3 : 1; }
};

/// A model's parameters in one flat array of doubles, in the order of Brdf::parameters, rgb as three. Where
/// the model has a table, its numbers follow.
using ParameterValues = std::vector<double>;

/// Rows of four numbers that a model reads beside its parameters.
using TableRows = std::vector<double>;

/// How a model's table is written in files. One of `columns` and `fromFile` is given.
struct TableFormat {
    std::vector<std::string> columns;  ///< of an array of objects, each rgb: "cx", "cy", "cz", "n"
    /// From those columns, rgb of column c of element i at 3 (i * columns.size() + c). Throws InputError
    /// whose text starts with the property: "lobes[2].n: ...".
    std::function<TableRows(std::span<const double>)> fromColumns;
    /// From the bytes of a file. Throws InputError that says what is wrong with it.
    std::function<TableRows(std::span<const std::byte>)> fromFile;
    /// Tables that tests and documentation use, with names.
    std::function<std::vector<std::pair<std::string, TableRows>>()> examples;
};

/// Published values for a surface, which scenes refer to by name.
struct BrdfPreset {
    std::string name;    ///< "rolled brass"
    std::string source;  ///< where the values are from, and what about them is not
    ParameterValues values;
};

/// The glTF description of a surface, from which each model can be set up when it is chosen for a whole
/// scene.
struct MetallicRoughness {
    glm::dvec3 baseColor{1.0};
    double metallic = 1.0;
    double roughness = 1.0;
};

/// Directions in the local frame: z = shading normal, x = tangent; unit, both leaving the surface.
/// `h` is wi + wo, not normalised, added in world space before it was rotated (docs/numerics.md).
struct Directions {
    glm::dvec3 wi;  ///< to the light
    glm::dvec3 wo;  ///< to the eye
    glm::dvec3 h;
    Directions(const glm::dvec3& toLight, const glm::dvec3& toEye)
        : wi(toLight), wo(toEye), h(toLight + toEye) {}
};

/// A named term of a model's formula: "D", "F", "G".
struct BrdfFactor {
    std::string name;
    glm::dvec3 value;
};

struct BrdfTraits {
    bool reciprocal = true;
    bool energyConserving = true;  ///< directional albedo at most 1 over the whole parameter range
    /// The formula sees angles only. False where it multiplies components of both directions as they are, so
    /// that lengths that are 1 only to rounding count.
    bool anglesOnly = true;
    /// The lobe is one of the half vector, whose direction rounding blurs where wi and wo nearly oppose each
    /// other; else of the mirrored direction.
    bool halfVectorLobe = true;
    bool usesTangent = false;   ///< anisotropic: needs the frame's x axis
    bool scattersLight = true;  ///< false: shows no light without extent (ideal mirrors)
};

/// One reflectance model.
struct Brdf {
    std::string name;    ///< registry name = GLSL file's stem = glTF "model"
    std::string title;   ///< for people: "Blinn-Phong"
    std::string source;  ///< paper
    std::vector<Parameter> parameters;
    std::optional<TableFormat> table;
    std::vector<BrdfPreset> presets;
    BrdfTraits traits;

    /// f_r(wi, wo) * cos(theta_i), in 1/sr, in double, from the paper's formula: the twin of NAME_f_cos in
    /// GLSL. Absent in models that were loaded from a file of their own (brdf_file.hpp): requireTwin().
    std::function<glm::dvec3(const Directions&, std::span<const double>)> fCos;

    /// Sum of the absolute values of the terms of fCos, where some of them are negative: each has roundings
    /// of its own, however small the sum. Absent: fCos.
    std::function<glm::dvec3(const Directions&, std::span<const double>)> termSizes;

    /// The terms that the formula's lobe is a product of, as the paper names them, for people to look at.
    /// Both directions are above the surface. Absent where a model has no such terms.
    std::function<std::vector<BrdfFactor>(const Directions&, std::span<const double>)> factors;

    /// The factor k_a that multiplies LOBE_ambient's radiance: the twin of NAME_ambient in GLSL.
    std::function<glm::dvec3(std::span<const double>)> ambient;

    /// Reflectance into the mirrored direction, which no light without extent shows, for cos(theta): the twin
    /// of NAME_mirror in GLSL. Absent where the model has no such part.
    std::function<glm::dvec3(double, std::span<const double>)> mirror;

    /// What a thin surface lets through of the light that comes straight from behind it, per channel, for
    /// cos(theta) of the way to the eye: the twin of NAME_transmittance in GLSL. Absent in models that let
    /// nothing through.
    std::function<glm::dvec3(double, std::span<const double>)> transmittance;

    /// Width of the sharpest lobe that these values give, as the largest |d ln f / d theta_h| in 1/rad
    /// (algorithms: 2/alpha for GGX, sqrt(n) for Blinn-Phong, 2 sqrt(n) for Phong, 0 for Lambert).
    std::function<double(std::span<const double>)> lobeSharpness;

    /// An upper bound of fCos over all directions, per channel, that does not fall where a parameter's value
    /// rises within rgb parameters, and is largest at an end of the range of any other. Absent: none is
    /// known, or the formula has none.
    std::function<glm::dvec3(std::span<const double>)> peak;

    /// Lobes from which to draw wi for this wo (sampling.hpp). Absent: found from fCos.
    std::function<SamplingLobes(const glm::dvec3& wo, std::span<const double>)> samplingLobes;

    /// How lights with a body are integrated without samples. Absent: they are sampled.
    std::optional<AreaModel> area;

    /// Values that imitate a metallic-roughness surface, for `--brdf NAME` on a whole scene.
    std::function<ParameterValues(const MetallicRoughness&)> fromMetallicRoughness;

    /// The rgb parameter that takes the place of glTF's base colour, with its texture: "diffuse",
    /// "baseColor".
    std::string baseColorParameter;

    /// Models that were loaded at run time only: the GLSL file, its text when it was read, and what stands in
    /// for functions that it lacks.
    std::string file, glsl, glslSubstitutes;

    int parameterIndex(std::string_view parameterName) const;  ///< -1 if there is none
    int valueOffset(int parameterIndex) const;                 ///< of its first double in ParameterValues
    int valueCount() const;                                    ///< without the table
    ParameterValues defaults() const;
    const BrdfPreset* findPreset(std::string_view presetName) const;  ///< null if there is none
    int tableParameter() const;  ///< index of the parameter of kind table, -1 if there is none
    /// The table's numbers at the end of `values`, four a row.
    std::span<const double> tableOf(std::span<const double> values) const;
};

/// All models that come with Lobe, sorted by name. References stay valid for the program's life.
const std::vector<Brdf>& allBrdfs();
/// Those loaded from files (brdf_file.hpp), until others take their place.
const std::vector<Brdf>& loadedBrdfs();
/// Takes the place of those loaded before. Not while another thread uses the registry. Throws UsageError if
/// two, or one and a model that comes with Lobe, have one name.
void setLoadedBrdfs(std::vector<Brdf> brdfs);
std::vector<std::string> brdfNames();  ///< of both
const Brdf* findBrdf(std::string_view name);
/// Throws UsageError with the nearest name.
const Brdf& requireBrdf(std::string_view name);
/// Throws UsageError for a model without a twin, which only those loaded from files are.
void requireTwin(const Brdf& brdf);

/// Throws InputError "WHERE: PARAMETER: VALUE; expected MIN..MAX" if a value is out of range or not finite.
void validateParameters(const Brdf& brdf, std::span<const double> values, const std::string& where);

/// `values` is too short or has a table of a wrong length: what is wrong, else empty.
std::string layoutError(const Brdf& brdf, std::span<const double> values);

/// "vec3", "float" or "int".
const char* glslType(ParameterKind kind);

/// GLSL source of the struct for this model's parameters (fields in declaration order), e.g.
/// "struct LambertParams { vec3 diffuse; };" and the type's name ("LambertParams").
std::string glslParameterStruct(const Brdf& brdf);
std::string glslParameterType(const Brdf& brdf);

}  // namespace lobe
