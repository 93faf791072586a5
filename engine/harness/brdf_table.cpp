#include "harness/brdf_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <map>

#include "math/random.hpp"
#include "math/sphere.hpp"

namespace lobe::harness {
namespace {

const glm::dvec3 kNormal(0.0, 0.0, 1.0);

/// A model's example tables, made once, each number rounded to a float.
const std::vector<TableRows>& exampleTables(const Brdf& brdf) {
    static std::map<std::string, std::vector<TableRows>> known;
    std::vector<TableRows>& tables = known[brdf.name];
    if (tables.empty())
        for (auto& [name, rows] : brdf.table->examples()) {
            for (double& number : rows)
                number = double(static_cast<float>(number));
            tables.push_back(std::move(rows));
        }
    return tables;
}

float randomValue(const Parameter& parameter, Pcg32& random) {
    if (parameter.kind == ParameterKind::table) return 0.0f;
    if (parameter.kind == ParameterKind::choice)
        return static_cast<float>(random.below(static_cast<uint32_t>(parameter.choices.size())));
    if (parameter.usual && random.below(16) != 0) {
        const auto [low, high] = *parameter.usual;
        return static_cast<float>(random.below(2) == 0 ? random.uniform(low, high)
                                  : low > 0.0          ? random.logUniform(low, high)
                                                       : random.logUniform(1e-6 * high, high));
    }
    switch (random.below(6)) {
        case 0:
            return static_cast<float>(parameter.minimum);
        case 1:
            return static_cast<float>(parameter.maximum);
        case 2:
        case 3:
            return static_cast<float>(random.uniform(parameter.minimum, parameter.maximum));
        default: {
            const double span = parameter.maximum - parameter.minimum;
            return static_cast<float>(parameter.minimum + random.logUniform(1e-6 * span, span));
        }
    }
}

std::vector<float> randomValues(const Brdf& brdf, Pcg32& random) {
    std::vector<float> values;
    for (const Parameter& parameter : brdf.parameters)
        for (int c = 0; c < parameter.components(); ++c)
            values.push_back(std::clamp(randomValue(parameter, random), static_cast<float>(parameter.minimum),
                                        static_cast<float>(parameter.maximum)));
    return values;
}

int randomTable(const Brdf& brdf, Pcg32& random) {
    return brdf.table ? static_cast<int>(random.below(static_cast<uint32_t>(exampleTables(brdf).size())))
                      : -1;
}

glm::dvec3 anywhere(Pcg32& random) {
    return uniformHemisphere({random.uniform(), random.uniform()});
}

glm::dvec3 grazing(Pcg32& random) {
    const double elevation = random.logUniform(1e-7, 0.1);
    return fromPolar(glm::half_pi<double>() - elevation, random.uniform(0.0, glm::two_pi<double>()));
}

glm::dvec3 mirrored(const glm::dvec3& w) {
    return {-w.x, -w.y, w.z};
}

/// `w` turned by `angle` in a random plane.
glm::dvec3 turned(const glm::dvec3& w, double angle, Pcg32& random) {
    return frameAbout(w) * fromPolar(angle, random.uniform(0.0, glm::two_pi<double>()));
}

using Pair = std::pair<glm::dvec3, glm::dvec3>;

struct Kind {
    const char* name;
    std::function<Pair(Pcg32&, double sharpness)> directions;
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> list{
        {"random", [](Pcg32& r, double) { return Pair(anywhere(r), anywhere(r)); }},
        {"grazing light", [](Pcg32& r, double) { return Pair(grazing(r), anywhere(r)); }},
        {"grazing view", [](Pcg32& r, double) { return Pair(anywhere(r), grazing(r)); }},
        {"both grazing", [](Pcg32& r, double) { return Pair(grazing(r), grazing(r)); }},
        {"normal incidence",
         [](Pcg32& r, double) {
             switch (r.below(3)) {
                 case 0:
                     return Pair(kNormal, anywhere(r));
                 case 1:
                     return Pair(anywhere(r), kNormal);
                 default:
                     return Pair(kNormal, kNormal);
             }
         }},
        {"L = V",
         [](Pcg32& r, double) {
             const glm::dvec3 w = r.below(2) == 0 ? anywhere(r) : grazing(r);
             return Pair(w, w);
         }},
        {"L near -V",
         [](Pcg32& r, double) {
             const glm::dvec3 w = grazing(r);
             const glm::dvec3 back = turned(-w, r.logUniform(1e-7, 0.1), r);
             return Pair(w, glm::dvec3(back.x, back.y, std::abs(back.z)));
         }},
        {"near the mirrored direction", [](Pcg32& r, double sharpness) {
             const glm::dvec3 w = r.below(4) == 0 ? grazing(r) : anywhere(r);
             return Pair(w, turned(mirrored(w), r.logUniform(1e-4, 10.0) / (1.0 + sharpness), r));
         }}};
    return list;
}

/// The row's values with the place of its table.
void appendValues(const Brdf& brdf, const BrdfRow& row, const PackedTables& tables,
                  std::vector<float>& inputs) {
    const size_t start = inputs.size();
    inputs.insert(inputs.end(), row.values.begin(), row.values.end());
    if (row.table >= 0)
        inputs[start + static_cast<size_t>(brdf.valueOffset(brdf.tableParameter()))] =
            static_cast<float>(tables.firstRow[static_cast<size_t>(row.table)]);
}

std::string parameterConstructor(const Brdf& brdf) {
    std::string text = glslParameterType(brdf) + "(";
    for (const Parameter& parameter : brdf.parameters)
        text += (text.ends_with('(') ? "" : ", ") + parameter.glslName;
    return text + ")";
}

void addParameterInputs(const Brdf& brdf, std::vector<Variable>& inputs) {
    for (const Parameter& parameter : brdf.parameters) {
        inputs.push_back({glslType(parameter.kind), parameter.glslName});
    }
}

Snippet localSnippet(const Brdf& brdf) {
    Snippet snippet;
    snippet.name = brdf.name + "_local";
    snippet.includes = {"brdf/" + brdf.name + ".glsl"};
    snippet.inputs = {{"vec3", "wi"}, {"vec3", "wo"}};
    addParameterInputs(brdf, snippet.inputs);
    snippet.results = 3;
    snippet.body = "    " + glslParameterType(brdf) + " p = " + parameterConstructor(brdf) +
                   ";\n"
                   "    result[0].xyz = " +
                   brdf.name +
                   "_f_cos(Dirs(wi, wo, wi + wo), p);\n"
                   "    result[1] = vec4(" +
                   brdf.name + "_ambient(p), " + brdf.name + "_roughness(p));";
    if (brdf.mirror)
        snippet.body += "\n    result[2].xyz = " + brdf.name + "_mirror(wo.z, dot(wo.xy, wo.xy), p);";
    return snippet;
}

Snippet worldSnippet(const Brdf& brdf) {
    Snippet snippet;
    snippet.name = brdf.name + "_world";
    snippet.includes = {"brdf/" + brdf.name + ".glsl"};
    snippet.inputs = {{"vec3", "n"}, {"vec3", "wi"}, {"vec3", "wo"}};
    addParameterInputs(brdf, snippet.inputs);
    snippet.body = "    result[0].xyz = " + brdf.name + "_f_cos(dirs_make(frame_from_normal(n), wi, wo), " +
                   parameterConstructor(brdf) + ");";
    return snippet;
}

void append(std::vector<float>& inputs, const glm::vec3& v) {
    inputs.insert(inputs.end(), {v.x, v.y, v.z});
}

}  // namespace

PackedTables packTables(std::span<const TableRows> tables) {
    PackedTables packed;
    for (const TableRows& rows : tables) {
        packed.firstRow.push_back(static_cast<int>(packed.floats.size() / 4));
        packed.floats.insert(packed.floats.end(), rows.begin(), rows.end());
    }
    return packed;
}

PackedTables packTables(const Brdf& brdf) {
    return brdf.table ? packTables(exampleTables(brdf)) : PackedTables{};
}

std::vector<BrdfRow> brdfRows(const Brdf& brdf, int perKind, uint64_t seed) {
    Pcg32 random(seed);
    std::vector<BrdfRow> rows;
    for (const Kind& kind : kinds())
        for (int i = 0; i < perKind; ++i) {
            BrdfRow row{kind.name, {}, {}, randomValues(brdf, random), randomTable(brdf, random)};
            const auto [wi, wo] = kind.directions(random, brdf.lobeSharpness(valuesOf(brdf, row)));
            row.wi = glm::vec3(wi);
            row.wo = glm::vec3(wo);
            rows.push_back(std::move(row));
        }
    return rows;
}

std::vector<BrdfRow> hostileRows(const Brdf& brdf, uint64_t seed) {
    Pcg32 random(seed);
    std::vector<glm::vec3> directions{
        {0, 0, 1},       {0, 0, -1},      {1, 0, 0},           {-1, 0, 0},
        {0, 1, 0},       {1, 0, 1e-30f},  {-1, 0, 1e-30f},     {1, 0, 1e-38f},
        {-1, 0, 1e-38f}, {1, 0, 1e-42f},  {-1, 0, 1e-42f},     {0, -1, 1e-20f},
        {0, 0, 0},       {1, 0, -1e-30f}, {0.6f, 0.8f, 1e-7f}, {-0.6f, -0.8f, 1e-7f}};
    std::vector<BrdfRow> rows;
    for (const glm::vec3& wi : directions)
        for (const glm::vec3& wo : directions)
            for (int i = 0; i < 24; ++i)
                rows.push_back({"hostile", wi, wo, randomValues(brdf, random), randomTable(brdf, random)});
    return rows;
}

BrdfEvaluator::BrdfEvaluator(const gl::ShaderLibrary& library, const Brdf& brdf)
    : brdf_(brdf), evaluator_(library, localSnippet(brdf)) {}

std::vector<BrdfResult> BrdfEvaluator::evaluate(const std::vector<BrdfRow>& rows) const {
    return evaluate(
        rows, brdf_.table ? std::span<const TableRows>(exampleTables(brdf_)) : std::span<const TableRows>());
}

std::vector<BrdfResult> BrdfEvaluator::evaluate(const std::vector<BrdfRow>& rows,
                                                std::span<const TableRows> ofRows) const {
    const PackedTables tables = packTables(ofRows);
    std::vector<float> inputs;
    for (const BrdfRow& row : rows) {
        append(inputs, row.wi);
        append(inputs, row.wo);
        appendValues(brdf_, row, tables, inputs);
    }
    const ResultTable table = evaluator_.evaluate(inputs, tables.floats);
    std::vector<BrdfResult> results;
    for (size_t i = 0; i < table.rows(); ++i) {
        const auto r = table.row(i);
        results.push_back({{r[0], r[1], r[2]}, {r[4], r[5], r[6]}, r[7], {r[8], r[9], r[10]}});
    }
    return results;
}

WorldBrdfEvaluator::WorldBrdfEvaluator(const gl::ShaderLibrary& library, const Brdf& brdf)
    : brdf_(brdf), evaluator_(library, worldSnippet(brdf)) {}

std::vector<glm::vec3> WorldBrdfEvaluator::evaluate(const std::vector<BrdfRow>& rows,
                                                    const std::vector<glm::vec3>& normals) const {
    const PackedTables tables = packTables(brdf_);
    std::vector<float> inputs;
    for (size_t i = 0; i < rows.size(); ++i) {
        append(inputs, normals[i]);
        append(inputs, rows[i].wi);
        append(inputs, rows[i].wo);
        appendValues(brdf_, rows[i], tables, inputs);
    }
    const ResultTable table = evaluator_.evaluate(inputs, tables.floats);
    std::vector<glm::vec3> results;
    for (size_t i = 0; i < table.rows(); ++i)
        results.emplace_back(table.row(i)[0], table.row(i)[1], table.row(i)[2]);
    return results;
}

Directions directionsOf(const BrdfRow& row) {
    return {glm::normalize(glm::dvec3(row.wi)), glm::normalize(glm::dvec3(row.wo))};
}

ParameterValues valuesOf(const Brdf& brdf, const BrdfRow& row) {
    ParameterValues values(row.values.begin(), row.values.end());
    if (row.table >= 0) {
        const TableRows& rows = exampleTables(brdf)[static_cast<size_t>(row.table)];
        values.insert(values.end(), rows.begin(), rows.end());
    }
    return values;
}

}  // namespace lobe::harness
