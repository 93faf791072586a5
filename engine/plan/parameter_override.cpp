// Parameters of models, set for a whole scene.
#include <algorithm>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "plan/summary.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"

namespace lobe {
namespace {

constexpr const char* kMetal = "metal";

int indexOf(const Brdf& brdf, const std::string& name) {
    const auto found =
        std::find_if(brdf.parameters.begin(), brdf.parameters.end(), [&](const Parameter& parameter) {
            return parameter.kind != ParameterKind::table &&
                   (parameter.name == name || parameter.glslName == name);
        });
    return found == brdf.parameters.end() ? -1 : static_cast<int>(found - brdf.parameters.begin());
}

[[noreturn]] void refuse(const ParameterOverride& change, const std::string& expected) {
    throw UsageError("brdf_set: " + change.name + " '" + change.text + "'; expected " + expected);
}

std::vector<double> valuesFor(const Parameter& parameter, const ParameterOverride& change) {
    if (parameter.kind == ParameterKind::choice) {
        const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), change.text);
        if (found != parameter.choices.end()) return {static_cast<double>(found - parameter.choices.begin())};
        refuse(change, "one of " + listed(parameter.choices) + didYouMean(change.text, parameter.choices));
    }
    const auto components = static_cast<size_t>(parameter.components());
    if (change.numbers.size() == components) return change.numbers;
    if (change.numbers.size() == 1) return std::vector<double>(components, change.numbers[0]);
    refuse(change, components == 3 ? "a number, or three for red, green and blue" : "a number");
}

void assign(Material& material, const Brdf& brdf, int index, const std::vector<double>& values) {
    std::copy(values.begin(), values.end(), material.values.begin() + brdf.valueOffset(index));
    // The value is meant as it is; a texture would multiply it.
    material.textures[static_cast<size_t>(index)] = {};
}

bool hasFresnel(const Brdf& brdf) {
    const int type = brdf.parameterIndex("fresnel");
    return type >= 0 && brdf.parameters[static_cast<size_t>(type)].group == "fresnel";
}

/// Optical constants by name, for models with Fresnel's equations. False for others.
bool assignMetal(Material& material, const Brdf& brdf, const ParameterOverride& change) {
    if (!hasFresnel(brdf)) return false;
    shading::setMetal(brdf, material.values, shading::requireMetal(change.text, "brdf_set: metal"));
    for (const char* name : {"eta", "k"})  // a texture would multiply them
        material.textures[static_cast<size_t>(brdf.parameterIndex(name))] = {};
    return true;
}

/// The equations that read what was set.
void useFresnel(Material& material, const Brdf& brdf, const std::vector<ParameterOverride>& changes) {
    if (!hasFresnel(brdf)) return;
    std::vector<std::string> named;
    std::string choice;
    for (const ParameterOverride& change : changes) {
        named.push_back(change.name);
        if (change.name == "fresnel") choice = change.text;
    }
    double& type = material.values[static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex("fresnel")))];
    const auto present = static_cast<shading::FresnelType>(static_cast<int>(type));
    type = static_cast<double>(shading::fresnelTypeFor(present, named, choice, "brdf_set"));
}

void refuseUnknown(const Scene& scene, const ParameterOverride& change) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials)
        if (material.brdf != kUnlit)
            for (const Parameter& parameter : requireBrdf(material.brdf).parameters)
                if (parameter.kind != ParameterKind::table &&
                    std::find(names.begin(), names.end(), parameter.name) == names.end())
                    names.push_back(parameter.name);
    std::string all;
    if (std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
            return material.brdf != kUnlit && hasFresnel(requireBrdf(material.brdf));
        }))
        names.emplace_back(kMetal);
    for (const std::string& name : names)
        all += (all.empty() ? "" : ", ") + name;
    throw UsageError("brdf_set: " + change.name + ": no model that " + scene.file +
                     " is drawn with has such a number, colour or choice; expected one of " + listed(names) +
                     didYouMean(change.name, names));
}

}  // namespace

Scene withParameters(const Scene& scene, const std::vector<ParameterOverride>& changes) {
    Scene result = scene;
    for (const ParameterOverride& change : changes) {
        bool used = false;
        for (Material& material : result.materials) {
            if (material.brdf == kUnlit) continue;
            const Brdf& brdf = requireBrdf(material.brdf);
            const int index = indexOf(brdf, change.name);
            if (index < 0) {
                used |= change.name == kMetal && assignMetal(material, brdf, change);
                continue;
            }
            used = true;
            assign(material, brdf, index, valuesFor(brdf.parameters[static_cast<size_t>(index)], change));
            try {
                validateParameters(brdf, material.values, "brdf_set");
            } catch (const InputError& error) {
                throw UsageError(error.what());
            }
        }
        if (!used) refuseUnknown(scene, change);
    }
    for (Material& material : result.materials)
        if (material.brdf != kUnlit) useFresnel(material, requireBrdf(material.brdf), changes);
    return result;
}

}  // namespace lobe
