#include "passes/material_glsl.hpp"

#include <algorithm>
#include <set>

namespace lobe {
namespace {

constexpr const char* kSwizzle = "rgba";

std::string uniformName(const Parameter& parameter) {
    return "uParam_" + parameter.glslName;
}

/// Includes the model and gives it the names that the passes call it by.
std::string modelAliases(const Brdf& brdf) {
    std::string text = "#include \"brdf/" + brdf.name + ".glsl\"\n" + brdf.glslSubstitutes;
    text += "#define MODEL_PARAMS " + glslParameterType(brdf) + "\n";
    for (const char* function : {"f_cos", "ambient", "roughness"})
        text += std::string("#define model_") + function + " " + brdf.name + "_" + function + "\n";
    if (brdf.mirror) text += "#define model_mirror " + brdf.name + "_mirror\n";
    if (brdf.transmittance) text += "#define model_transmittance " + brdf.name + "_transmittance\n";
    if (!brdf.area) return text;
    const int width = brdf.parameterIndex(brdf.area->width);
    text += "#define model_area " + brdf.name + "_area\n#define model_area_width(p) " +
            (width < 0 ? std::string("1.0") : "(p)." + brdf.parameters[static_cast<size_t>(width)].glslName) +
            "\n";
    return text;
}

std::string fetch(const SurfaceTexture& texture) {
    return "surface_sample" + std::to_string(texture.sample) + "()";
}

std::string sampleFunctions(const SurfaceFeatures& features) {
    std::string text;
    for (size_t i = 0; i < features.samples.size(); ++i) {
        const std::string n = std::to_string(i);
        const std::string uv = "vUv" + std::to_string(features.samples[i].uvSet);
        text += "uniform sampler2D uSample" + n + ";\n";
        std::string coordinate = uv;
        if (features.samples[i].transformed) {
            text += "uniform vec3 uUvRow" + n + "[2];\n";
            coordinate = "vec2(dot(uUvRow" + n + "[0], vec3(" + uv + ", 1.0)), dot(uUvRow" + n +
                         "[1], vec3(" + uv + ", 1.0)))";
        }
        text += "vec4 surface_sample" + n + "() { return texture(uSample" + n + ", " + coordinate + "); }\n";
    }
    return text;
}

std::string alphaFunction(const SurfaceFeatures& features) {
    if (features.alphaMode == AlphaMode::opaque) return {};
    std::string text =
        "uniform float uAlpha;\nuniform float uAlphaCutoff;\nfloat surface_alpha() { return uAlpha";
    if (const SurfaceTexture* texture = features.texture("alpha")) text += " * " + fetch(*texture) + ".a";
    if (features.vertexColors) text += " * vColor.a";
    return text + "; }\n";
}

std::string emissionFunction(const SurfaceFeatures& features) {
    if (features.brdf == kUnlit) {
        std::string text = "uniform vec3 uUnlitColor;\nvec3 surface_emission() { return uUnlitColor";
        if (const SurfaceTexture* texture = features.texture("baseColor"))
            text += " * " + fetch(*texture) + ".rgb";
        if (features.vertexColors) text += " * vColor.rgb";
        return text + "; }\n";
    }
    if (!features.emission) return "vec3 surface_emission() { return vec3(0.0); }\n";
    std::string text = "uniform vec3 uEmission;\nvec3 surface_emission() { return uEmission";
    if (const SurfaceTexture* texture = features.texture("emission"))
        text += " * " + fetch(*texture) + ".rgb";
    return text + "; }\n";
}

std::string occlusionAndNormal(const SurfaceFeatures& features) {
    std::string text;
    if (const SurfaceTexture* texture = features.texture("occlusion"))
        text +=
            "uniform float uOcclusionStrength;\nfloat surface_occlusion() { return 1.0 + uOcclusionStrength "
            "* (" +
            fetch(*texture) + ".r - 1.0); }\n";
    else
        text += "float surface_occlusion() { return 1.0; }\n";
    if (const SurfaceTexture* texture = features.texture("normal"))
        text += "uniform float uNormalScale;\nvec3 surface_normal_texel() { return (" + fetch(*texture) +
                ".rgb * 2.0 - 1.0) * vec3(uNormalScale, uNormalScale, 1.0); }\n";
    return text;
}

std::string parameterFunction(const Brdf& brdf, const SurfaceFeatures& features) {
    std::string uniforms, body;
    for (const Parameter& parameter : brdf.parameters) {
        uniforms += std::string("uniform ") + glslType(parameter.kind) + " " + uniformName(parameter) + ";\n";
        std::string value = uniformName(parameter);
        if (const SurfaceTexture* texture = features.texture(parameter.name)) {
            value += " * " + fetch(*texture) + ".";
            value += parameter.kind == ParameterKind::rgb ? std::string("rgb")
                                                          : std::string(1, kSwizzle[texture->channel]);
        }
        if (features.vertexColors && parameter.name == brdf.baseColorParameter) value += " * vColor.rgb";
        body += "    p." + parameter.glslName + " = " + value + ";\n";
    }
    return uniforms + "MODEL_PARAMS surface_params()\n{\n    MODEL_PARAMS p;\n" + body + "    return p;\n}\n";
}

std::string componentsOf(const Parameter& parameter, int first) {
    return std::string(kSwizzle).substr(static_cast<size_t>(first),
                                        static_cast<size_t>(parameter.components()));
}

std::string gbufferWriteFunction(const FramePlan& plan, const Brdf& brdf) {
    const PlannedBrdf* planned = plan.brdf(brdf.name);
    std::set<int> targets;
    std::string body;
    if (planned != nullptr)
        for (const ParameterPlace& place : planned->perPixel) {
            const Parameter& parameter = brdf.parameters[static_cast<size_t>(place.parameter)];
            targets.insert(place.target);
            body += "    oParameters" + std::to_string(place.target) + "." +
                    componentsOf(parameter, place.component) + " = p." + parameter.glslName + ";\n";
        }
    std::string outputs, clears;
    for (int target : targets) {
        const std::string name = "oParameters" + std::to_string(target);
        outputs += "layout(location = OUT_PARAMETERS" + std::to_string(target) + ") out vec4 " + name + ";\n";
        clears += "    " + name + " = vec4(0.0);\n";
    }
    return outputs + "void gbuffer_write_params(MODEL_PARAMS p)\n{\n" + clears + body + "}\n";
}

bool writesGbuffer(const FramePlan& plan, const SurfaceFeatures& features) {
    return plan.pass("gbuffer") != nullptr && !features.blended();
}

std::string varyings(const SurfaceFeatures& features) {
    std::string text;
    for (int set : {0, 1})
        if (features.usesUv(set)) text += "in vec2 vUv" + std::to_string(set) + ";\n";
    if (features.vertexColors) text += "in vec4 vColor;\n";
    return text;
}

}  // namespace

std::string surfaceMaterialGlsl(const FramePlan& plan, const SurfaceFeatures& features) {
    std::string text = varyings(features) + sampleFunctions(features) + alphaFunction(features) +
                       emissionFunction(features) + occlusionAndNormal(features);
    if (features.brdf == kUnlit) return text;
    const Brdf& brdf = requireBrdf(features.brdf);
    text = modelAliases(brdf) + text + parameterFunction(brdf, features);
    if (writesGbuffer(plan, features))
        text += "#ifdef GBUFFER\n" + gbufferWriteFunction(plan, brdf) + "#endif\n";
    return text;
}

std::string coverageGlsl(const SurfaceFeatures& features) {
    return varyings(features) + sampleFunctions(features) + alphaFunction(features);
}

std::string screenMaterialGlsl(const FramePlan& plan, const PlannedBrdf& planned) {
    if (planned.name == kUnlit) return {};
    const Brdf& brdf = requireBrdf(planned.name);
    std::string text = modelAliases(brdf);
    std::set<int> elsewhere;
    std::string body;
    std::set<int> targets;
    for (const ParameterPlace& place : planned.perPixel) {
        const Parameter& parameter = brdf.parameters[static_cast<size_t>(place.parameter)];
        elsewhere.insert(place.parameter);
        targets.insert(place.target);
        body += "    p." + parameter.glslName + " = g" + std::to_string(place.target) + "." +
                componentsOf(parameter, place.component) + ";\n";
    }
    std::string fetches;
    for (int target : targets)
        fetches += "    vec4 g" + std::to_string(target) + " = texelFetch(uParameters" +
                   std::to_string(target) + ", gbuffer_pixel(), 0);\n";
    if (!planned.perMaterial.empty()) {
        fetches += "    int row = int(texelFetch(uMaterialId, gbuffer_pixel(), 0).x - 1u) * " +
                   std::to_string(materialTableStride(plan)) + ";\n";
        int component = 0;
        int texels = 0;
        for (int index : planned.perMaterial) {
            const Parameter& parameter = brdf.parameters[static_cast<size_t>(index)];
            elsewhere.insert(index);
            std::string value;
            for (int c = 0; c < parameter.components(); ++c, ++component)
                value += (c ? ", m" : "m") + std::to_string(component / 4) + "." + kSwizzle[component % 4];
            texels = (component + 3) / 4;
            body += "    p." + parameter.glslName + " = " + glslType(parameter.kind) + "(" + value + ");\n";
        }
        for (int t = 0; t < texels; ++t)
            fetches += "    vec4 m" + std::to_string(t) + " = texelFetch(uMaterials, row + " +
                       std::to_string(t) + ");\n";
    }
    for (int index = 0; index < static_cast<int>(brdf.parameters.size()); ++index) {
        if (elsewhere.contains(index)) continue;
        const Parameter& parameter = brdf.parameters[static_cast<size_t>(index)];
        text += std::string("uniform ") + glslType(parameter.kind) + " " + uniformName(parameter) + ";\n";
        body += "    p." + parameter.glslName + " = " + uniformName(parameter) + ";\n";
    }
    return text + "MODEL_PARAMS gbuffer_read_params()\n{\n    MODEL_PARAMS p;\n" + fetches + body +
           "    return p;\n}\n";
}

int materialTableStride(const FramePlan& plan) {
    int floats = 0;
    for (const PlannedBrdf& planned : plan.brdfs) {
        int own = 0;
        for (int index : planned.perMaterial)
            own += requireBrdf(planned.name).parameters[static_cast<size_t>(index)].components();
        floats = std::max(floats, own);
    }
    return (floats + 3) / 4;
}

std::vector<float> materialTableRow(const FramePlan& plan, const Material& material) {
    std::vector<float> row;
    if (const PlannedBrdf* planned = plan.brdf(material.brdf)) {
        for (int index : planned->perMaterial) {
            const Brdf& brdf = requireBrdf(planned->name);
            const int offset = brdf.valueOffset(index);
            for (int c = 0; c < brdf.parameters[static_cast<size_t>(index)].components(); ++c)
                row.push_back(static_cast<float>(material.values[static_cast<size_t>(offset + c)]));
        }
    }
    row.resize(static_cast<size_t>(materialTableStride(plan)) * 4, 0.0f);
    return row;
}

}  // namespace lobe
