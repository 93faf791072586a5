#include "shading/parameters.hpp"

#include <cctype>

namespace lobe::shading {
namespace {

std::string snakeCase(const std::string& camelCase) {
    std::string snake;
    for (char c : camelCase) {
        if (std::isupper(static_cast<unsigned char>(c)) != 0) snake += '_';
        snake += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return snake;
}

Parameter makeParameter(std::string name, ParameterKind kind, const glm::dvec3& defaultValue, double maximum,
                        std::string description) {
    Parameter parameter;
    parameter.glslName = snakeCase(name);
    parameter.name = std::move(name);
    parameter.kind = kind;
    parameter.defaultValue = defaultValue;
    parameter.maximum = maximum;
    parameter.description = std::move(description);
    return parameter;
}

}  // namespace

Parameter rgbParameter(std::string name, const glm::dvec3& defaultValue, std::string description) {
    return makeParameter(std::move(name), ParameterKind::rgb, defaultValue, 1.0, std::move(description));
}

Parameter colorParameter(std::string name, const glm::dvec3& defaultValue, std::string description) {
    Parameter parameter = rgbParameter(std::move(name), defaultValue, std::move(description));
    parameter.textureIsSrgb = true;
    return parameter;
}

Parameter scalarParameter(std::string name, double defaultValue, double minimum, double maximum,
                          std::string description) {
    Parameter parameter = makeParameter(std::move(name), ParameterKind::scalar,
                                        glm::dvec3(defaultValue, 0.0, 0.0), maximum, std::move(description));
    parameter.minimum = minimum;
    return parameter;
}

Parameter choiceParameter(std::string name, std::vector<std::string> choices, std::string description) {
    Parameter parameter = makeParameter(std::move(name), ParameterKind::choice, glm::dvec3(0.0),
                                        static_cast<double>(choices.size()) - 1.0, std::move(description));
    parameter.mayBeTextured = false;
    parameter.choices = std::move(choices);
    return parameter;
}

Parameter tableParameter(std::string name, std::string description) {
    // Places are kept in floats, which count exactly to 2^24.
    Parameter parameter =
        makeParameter(std::move(name), ParameterKind::table, glm::dvec3(0.0), 0x1p24, std::move(description));
    parameter.mayBeTextured = false;
    return parameter;
}

glm::dvec3 rgbAt(std::span<const double> values, size_t offset) {
    return {values[offset], values[offset + 1], values[offset + 2]};
}

SamplingLobes baseAndLobe(double base, const SamplingLobe& lobe) {
    SamplingLobes lobes;
    lobes.add({LobeShape::cosine, base});
    lobes.add(lobe);
    return lobes;
}

}  // namespace lobe::shading
