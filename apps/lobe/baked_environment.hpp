/// An environment prefiltered for models, as files that other programs can use.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image_files.hpp"
#include "scene/scene.hpp"

namespace lobe::app {

struct BakeRequest {
    std::vector<const Brdf*> models;
    /// Of each model's width parameter, as far as the model takes them; its own range where there is none.
    std::optional<std::pair<double, double>> widths;
};

/// Why nothing can be baked for a model, in words; empty: it can.
std::string whyNotBaked(const Brdf& brdf);

/// Writes environment.json, README.md, environment.exr, irradiance.exr and a folder for each model, of the
/// scene's environment. Each file appears whole or not at all; others in the folder are left alone.
/// `done`: called with what was written, a line each. Throws OutputError.
void bakeEnvironment(const Scene& scene, const BakeRequest& request, const std::filesystem::path& folder,
                     ImageFiles& files, const std::function<void(const std::string&)>& done);

}  // namespace lobe::app
