/// What is behind a pixel, for people, for programs, and as a test.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "reference/explanation.hpp"

namespace lobe::app {

struct ExplainedPixel {
    int x = 0, y = 0;
    std::string scene;
    const reference::Explanation* explanation = nullptr;
    std::optional<glm::dvec3> rendered;  ///< by OpenGL
    std::string context;                 ///< with what
};

std::string explanationText(const Scene& scene, const ExplainedPixel& pixel);
nlohmann::ordered_json explanationJson(const Scene& scene, const ExplainedPixel& pixel);

/// A test file for lobe-check: the front surface's model at the light that gives most, against the twin's
/// value, within the derived tolerance. Empty where no light reaches it or the model has a table.
std::string explanationTest(const ExplainedPixel& pixel);

}  // namespace lobe::app
