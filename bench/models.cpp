#include "models.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "shading/brdf.hpp"

namespace lobe::bench {
namespace {

using harness::Evaluator;
using harness::Snippet;

constexpr size_t kRows = 1 << 17;
/// Lights a surface, each from a quarter turn further on: reading the inputs then takes less of the time.
constexpr int kLights = 4;
/// Below this, times of a textbook form are noise.
constexpr double kLeastTime = 0.5;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

Snippet inputsOf(const Brdf& brdf, const std::string& name) {
    Snippet snippet;
    snippet.name = brdf.name + "_" + name;
    snippet.inputs = {{"vec3", "wi"}, {"vec3", "wo"}};
    for (const Parameter& parameter : brdf.parameters)
        snippet.inputs.push_back({glslType(parameter.kind), parameter.glslName});
    return snippet;
}

/// Written out, as loops cost by themselves.
std::string overLights(const std::string& term) {
    std::string text;
    for (int light = 0; light < kLights; ++light)
        text += "    result[0].xyz += " + term + ";\n    wi.xy = vec2(-wi.y, wi.x);\n";
    return text;
}

std::string call(const Brdf& brdf) {
    std::string parameters;
    for (const Parameter& parameter : brdf.parameters)
        parameters += (parameters.empty() ? "" : ", ") + parameter.glslName;
    return overLights(brdf.name + "_f_cos(Dirs(wi, wo, wi + wo), " + glslParameterType(brdf) + "(" +
                      parameters + "))");
}

Snippet modelSnippet(const Brdf& brdf) {
    Snippet snippet = inputsOf(brdf, "model");
    snippet.includes = {"brdf/" + brdf.name + ".glsl"};
    snippet.body = call(brdf);
    return snippet;
}

Snippet textbookSnippet(const Brdf& brdf) {
    const std::filesystem::path file =
        std::filesystem::path(LOBE_SOURCE_DIR) / "bench/textbook" / (brdf.name + ".glsl");
    if (!std::filesystem::exists(file))
        throw InputError(file.string() + ": missing; every model has a textbook form");
    Snippet snippet = inputsOf(brdf, "textbook");
    snippet.includes = {"common/dirs.glsl"};
    snippet.functions = glslParameterStruct(brdf) + "\n#include \"" + file.string() + "\"\n";
    snippet.body = call(brdf);
    return snippet;
}

Snippet floorSnippet(const Brdf& brdf) {
    Snippet snippet = inputsOf(brdf, "floor");
    std::string sum = "wi + wo";
    for (const Parameter& parameter : brdf.parameters)
        sum += parameter.kind == ParameterKind::rgb ? " + " + parameter.glslName
                                                    : " + float(" + parameter.glslName + ")";
    snippet.body = overLights(sum);
    return snippet;
}

/// Rows of inputs, and the table that all share.
struct Inputs {
    std::vector<float> rows, table;
};

MetallicRoughness randomSurface(Pcg32& random) {
    return {{random.uniform(0.05, 1.0), random.uniform(0.05, 1.0), random.uniform(0.05, 1.0)},
            random.uniform(),
            random.uniform(0.1, 1.0)};
}

Inputs inputsFor(const Brdf& brdf, const std::string& fresnel) {
    Pcg32 random(17);
    Inputs inputs;
    const auto count = static_cast<size_t>(brdf.valueCount());
    if (brdf.table) {
        const ParameterValues values = brdf.fromMetallicRoughness({glm::dvec3(0.5), 0.5, 0.5});
        inputs.table.assign(values.begin() + static_cast<std::ptrdiff_t>(count), values.end());
    }
    const auto set = [&](ParameterValues& values, const char* name, double low, double high) {
        const auto at = static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name)));
        for (size_t c = 0; c < 3; ++c)
            values[at + c] = random.uniform(low, high);
    };
    for (size_t i = 0; i < kRows; ++i) {
        for (int direction = 0; direction < 2; ++direction) {
            const glm::dvec3 w = uniformHemisphere({random.uniform(), random.uniform()});
            for (int c = 0; c < 3; ++c)
                inputs.rows.push_back(static_cast<float>(w[c]));
        }
        // A table takes long to make, and all share one.
        ParameterValues values =
            brdf.table ? brdf.defaults() : brdf.fromMetallicRoughness(randomSurface(random));
        if (!fresnel.empty()) {
            const int index = brdf.parameterIndex("fresnel");
            const auto& choices = brdf.parameters[static_cast<size_t>(index)].choices;
            values[static_cast<size_t>(brdf.valueOffset(index))] =
                static_cast<double>(std::find(choices.begin(), choices.end(), fresnel) - choices.begin());
            if (fresnel != "schlick") {
                set(values, "eta", fresnel == "conductor" ? 0.15 : 1.2, 3.0);
                set(values, "k", 1.0, 5.0);
            }
        }
        for (size_t v = 0; v < count; ++v)
            inputs.rows.push_back(static_cast<float>(values[v]));
    }
    return inputs;
}

/// Share of the values in which the textbook form is astray; at least half have to agree, else it is another
/// model.
double astray(const std::string& name, const Evaluator& model, const Evaluator& textbook,
              const Inputs& inputs) {
    const auto stable = model.evaluate(inputs.rows, inputs.table);
    const auto plain = textbook.evaluate(inputs.rows, inputs.table);
    std::vector<double> errors;
    size_t wrong = 0;
    for (size_t i = 0; i < stable.rows(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const double exact = double{stable.row(i)[c]};
            if (exact < 1e-30) continue;
            const double error = std::abs(double{plain.row(i)[c]} / exact - 1.0);
            errors.push_back(std::isnan(error) ? 1e30 : error);
            if (!(error <= 0.01)) ++wrong;
        }
    if (errors.empty()) return 0.0;
    const double share = static_cast<double>(wrong) / static_cast<double>(errors.size());
    if (median(errors) > 1e-3)
        throw InputError("bench/textbook: " + name + ": off by " + std::to_string(median(errors)) +
                         " in the median; expected the same model");
    return share;
}

ModelTime measure(const Brdf& brdf, const std::string& fresnel, const gl::ContextInfo& info, int rounds) {
    const auto files = gl::ShaderLibrary::ofFiles({shaderDirectory()});
    const Evaluator model(files, modelSnippet(brdf));
    const Evaluator textbook(files, textbookSnippet(brdf));
    const Evaluator floor(files, floorSnippet(brdf));
    const Inputs inputs = inputsFor(brdf, fresnel);
    ModelTime result;
    result.name = brdf.name + (fresnel.empty() ? "" : ", " + fresnel);
    result.astray = astray(result.name, model, textbook, inputs);
    std::vector<double> models, textbooks, floors, ratios;
    const auto least = [&](const Evaluator& evaluator) {
        constexpr int kDraws = 3;
        const auto times = evaluator.drawTimes(inputs.rows, inputs.table, kDraws, info.software);
        return *std::min_element(times.begin(), times.end()) * 1e6 / static_cast<double>(kRows * kLights);
    };
    for (int round = 0; round < rounds; ++round) {
        const double f = least(floor);
        const double t = least(textbook);
        const double m = least(model);
        floors.push_back(f);
        textbooks.push_back(t - f);
        models.push_back(m - f);
        ratios.push_back((m - f) / std::max(t - f, 1e-9));
    }
    result.model = median(models);
    result.textbook = median(textbooks);
    result.floor = median(floors);
    result.ratio = result.textbook > kLeastTime ? median(ratios) : 0.0;
    return result;
}

}  // namespace

std::vector<ModelTime> modelTimes(const gl::ContextInfo& info, int rounds,
                                  const std::function<void(const ModelTime&)>& done) {
    std::vector<ModelTime> results;
    for (const Brdf& brdf : allBrdfs()) {
        std::vector<std::string> kinds{""};
        if (const int index = brdf.parameterIndex("fresnel"); index >= 0 && brdf.traits.scattersLight)
            kinds = brdf.parameters[static_cast<size_t>(index)].choices;
        for (const std::string& fresnel : kinds) {
            results.push_back(measure(brdf, fresnel, info, rounds));
            done(results.back());
        }
    }
    return results;
}

}  // namespace lobe::bench
