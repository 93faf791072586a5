/// A reflectance model with the parameter values under which it is drawn.
#pragma once

#include <string>
#include <vector>

#include "shading/brdf.hpp"

namespace lobe::plot {

/// Values are rounded to floats, so that GLSL and twin see the same.
struct Model {
    const Brdf* brdf;
    ParameterValues values;  ///< valid, with the table where the model has one
    std::string table = {};  ///< name of that table, for people
    std::string metal = {};  ///< name of the metal whose optical constants the values are
};

/// A parameter's new value as written on a command line: "alpha", "0.1"; "diffuse", "0.5" or "0.5,0.2,0.1";
/// "normalization", "energy"; "file", the path of a table.
struct Assignment {
    std::string key, text;
};

/// The registry's defaults with assignments, in their order. Keys are the scene format's, and two that stand
/// for several: "alpha" for alphaX and alphaY where the model has those and no alpha, "metal" for a
/// conductor's eta and k by name. Throws UsageError that names model, parameter, value and what was expected.
Model makeModel(const std::string& name, const std::vector<Assignment>& assignments);

/// The model with a scalar parameter (or "alpha" as above) set; throws UsageError out of its range.
Model withParameter(Model model, const std::string& key, double value);

/// Whether a key can be assigned.
bool hasParameter(const Brdf& brdf, const std::string& key);

/// Throws UsageError "MODEL: unknown parameter ..." with the nearest name and all names.
[[noreturn]] void refuseParameter(const Brdf& brdf, const std::string& key);

/// The scalar parameter that `key` stands for; throws UsageError where it is none.
const Parameter& scalarParameterOf(const Brdf& brdf, const std::string& key);

/// Throws UsageError for models that scatter no light, of which there is nothing to draw but a direction.
void requireScatters(const Model& model);

/// The parameter that makes the model's lobe wide or narrow: what plots sweep unless told. Empty if it has
/// none.
std::string widthParameter(const Brdf& brdf);

/// "Ward: diffuse 0.5, specular (1, 0.8, 0.6), alpha 0.1": what counts under these values.
std::string describe(const Model& model);

/// The shortest decimal text of a float's value: 0.1, 1e-07.
std::string shortNumber(double value);

}  // namespace lobe::plot
