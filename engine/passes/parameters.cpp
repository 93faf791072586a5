#include "passes/parameters.hpp"

namespace lobe {

void setParameters(const gl::Program& program, const Brdf& brdf, std::span<const double> values) {
    size_t offset = 0;
    for (const Parameter& parameter : brdf.parameters) {
        const std::string name = "uParam_" + parameter.glslName;
        switch (parameter.kind) {
            case ParameterKind::rgb:
                program.set(name, glm::vec3(values[offset], values[offset + 1], values[offset + 2]));
                break;
            case ParameterKind::scalar:
                program.set(name, static_cast<float>(values[offset]));
                break;
            case ParameterKind::choice:
            case ParameterKind::table:
                program.set(name, static_cast<int>(values[offset]));
                break;
        }
        offset += static_cast<size_t>(parameter.components());
    }
}

}  // namespace lobe
