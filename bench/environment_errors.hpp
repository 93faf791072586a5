/// How far off each method of showing an environment is, against quadrature in double.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "environment_pictures.hpp"
#include "gl/context.hpp"

namespace lobe::bench {

struct EnvironmentError {
    std::string panorama, model, method;
    double width = 0.0;  ///< slope of the surface (alpha): the square root is glTF's roughness
    double angle = 0.0;  ///< of view, degrees
    /// Means of luminance over lines of sight and normals around them: of the truth, of the difference, of
    /// its magnitude.
    double truth = 0.0, bias = 0.0, error = 0.0;
};

/// White metals, and Lambert's surface, in each panorama.
std::vector<EnvironmentError> environmentErrors(gl::Context& context, const std::vector<Panorama>& panoramas,
                                                const std::function<void(const EnvironmentError&)>& done);

/// As a table in Markdown: a row a model and width, for each panorama the error of the prefiltered map up to
/// 60 degrees and beyond, and of directions.
std::string errorTable(const std::vector<EnvironmentError>& errors);

}  // namespace lobe::bench
