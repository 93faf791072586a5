/// Registered models over tables, by their GLSL and by their twins.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "gl/objects.hpp"
#include "harness/evaluator.hpp"
#include "harness/table_evaluation.hpp"

namespace lobe::harness {
namespace {

constexpr size_t kMostRows = 1 << 16;
/// Places of tables are kept in floats, which count exactly to 2^24.
constexpr size_t kMostTableRows = 1 << 24;
/// Rounding of a direction to a few decimals is no mistake.
constexpr double kNearUnit = 1e-3;

std::string textOf(const glm::dvec3& rgb) {
    return numberText(rgb.r) + "," + numberText(rgb.g) + "," + numberText(rgb.b);
}

class ModelTable : public TableEvaluation {
public:
    ModelTable(const Brdf& brdf, const TableHeader& header, const std::optional<TableRows>& table)
        : brdf_(brdf), name_(header.name), columns_(brdf, header.columns, header.name, table) {}

    std::vector<std::string> resultColumns() const override { return {"f_cos_r", "f_cos_g", "f_cos_b"}; }

protected:
    ModelColumns::Row read(const CsvRow& row) {
        const ModelColumns::Row result = columns_.read(row);
        const double off = std::max(std::abs(result.lengthL - 1.0), std::abs(result.lengthV - 1.0));
        if (off > kNearUnit && warnings_.empty())
            warnings_.push_back(name_ + ":" + std::to_string(row.line) + ": directions of lengths " +
                                numberText(result.lengthL) + " and " + numberText(result.lengthV) +
                                "; taken as directions of length 1, and so are others");
        return result;
    }
    const Brdf& brdf_;

private:
    std::string name_;
    ModelColumns columns_;
};

class TwinTable : public ModelTable {
public:
    using ModelTable::ModelTable;

    void add(const CsvRow& row) override {
        const ModelColumns::Row r = read(row);
        lines_.push_back(textOf(brdf_.fCos(Directions(r.l, r.v), r.values)));
    }
    bool isFull() const override { return lines_.size() >= kMostRows; }
    std::vector<std::string> finish() override { return std::exchange(lines_, {}); }

private:
    std::vector<std::string> lines_;
};

class GlslTable : public ModelTable {
public:
    GlslTable(const Brdf& brdf, const TableHeader& header, const std::optional<TableRows>& table)
        : ModelTable(brdf, header, table),
          evaluator_(gl::ShaderLibrary(shaderDirectory()), snippet(brdf)),
          width_(static_cast<size_t>(inputWidth(evaluator_.snippet()))) {
        GLint texels = 0;
        glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
        mostTableRows_ = std::min(kMostTableRows, static_cast<size_t>(std::max(texels, 0)));
    }

    void add(const CsvRow& row) override {
        const ModelColumns::Row r = read(row);
        for (const glm::dvec3& w : {r.l, r.v, r.l + r.v})
            for (int c = 0; c < 3; ++c)
                inputs_.push_back(static_cast<float>(w[c]));
        const size_t start = inputs_.size();
        const auto count = static_cast<size_t>(brdf_.valueCount());
        for (size_t i = 0; i < count; ++i)
            inputs_.push_back(static_cast<float>(r.values[i]));
        if (!brdf_.table) return;
        takeTable(r);
        const auto at = static_cast<size_t>(brdf_.valueOffset(brdf_.tableParameter()));
        inputs_[start + at] = static_cast<float>(tablePlace_);
    }

    /// Full also where one more table as large as the last would not fit.
    bool isFull() const override {
        return inputs_.size() >= kMostRows * width_ || (brdf_.table && tableChanges_ && tooManyTables());
    }

    std::vector<std::string> finish() override {
        const ResultTable results = evaluator_.evaluate(inputs_, tables_);
        std::vector<std::string> lines;
        lines.reserve(results.rows());
        for (size_t i = 0; i < results.rows(); ++i) {
            const auto r = results.row(i);
            lines.push_back(textOf({r[0], r[1], r[2]}));
        }
        inputs_.clear();
        if (tableChanges_) tables_.clear();
        tableChanges_ = false;
        return lines;
    }

private:
    static Snippet snippet(const Brdf& brdf) {
        Snippet snippet;
        snippet.name = brdf.name + "_table";
        snippet.includes = {"brdf/" + brdf.name + ".glsl"};
        snippet.inputs = {{"vec3", "wi"}, {"vec3", "wo"}, {"vec3", "h"}};
        std::string parameters;
        for (const Parameter& parameter : brdf.parameters) {
            snippet.inputs.push_back({glslType(parameter.kind), parameter.glslName});
            parameters += (parameters.empty() ? "" : ", ") + parameter.glslName;
        }
        snippet.body = "    result[0].xyz = " + brdf.name + "_f_cos(Dirs(wi, wo, h), " +
                       glslParameterType(brdf) + "(" + parameters + "));";
        return snippet;
    }

    /// Rows that follow each other with one table share its place.
    void takeTable(const ModelColumns::Row& row) {
        if (row.table == table_ && !tables_.empty()) return;
        const std::span<const double> numbers = brdf_.tableOf(row.values);
        tableChanges_ = tableChanges_ || !tables_.empty();
        tablePlace_ = tables_.size() / 4;
        for (const double number : numbers)
            tables_.push_back(static_cast<float>(number));
        table_ = row.table;
        lastTableRows_ = numbers.size() / 4;
        if (tables_.size() / 4 > mostTableRows_)
            throw ContextError("a table of " + std::to_string(tables_.size() / 4) +
                               " rows; this context reads at most " + std::to_string(mostTableRows_));
    }

    bool tooManyTables() const { return tables_.size() / 4 + lastTableRows_ * 4 > mostTableRows_ / 2; }

    Evaluator evaluator_;
    size_t width_;
    size_t mostTableRows_ = 0;
    std::vector<float> inputs_, tables_;
    uint64_t table_ = 0;
    size_t tablePlace_ = 0, lastTableRows_ = 0;
    bool tableChanges_ = false;
};

}  // namespace

std::unique_ptr<TableEvaluation> modelEvaluation(const Brdf& brdf, const TableHeader& header,
                                                 const std::optional<TableRows>& table) {
    return std::make_unique<GlslTable>(brdf, header, table);
}

std::unique_ptr<TableEvaluation> twinEvaluation(const Brdf& brdf, const TableHeader& header,
                                                const std::optional<TableRows>& table) {
    return std::make_unique<TwinTable>(brdf, header, table);
}

}  // namespace lobe::harness
