/// Any GLSL function over a table.
#include <cfloat>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "harness/function_binding.hpp"

namespace lobe::harness {
namespace {

constexpr size_t kMostRows = 1 << 16;

class FunctionTable : public TableEvaluation {
public:
    FunctionTable(const gl::ShaderLibrary& library, const std::string& path, const std::string& file,
                  const std::string& function, TableHeader header)
        : header_(std::move(header)),
          binding_(library, path, file, function, header_),
          evaluator_(library, binding_.snippet) {}

    std::vector<std::string> resultColumns() const override {
        std::vector<std::string> names;
        for (const FunctionBinding::Output& output : binding_.outputs)
            names.push_back(output.leaf.path);
        return names;
    }

    void add(const CsvRow& row) override {
        for (const FunctionBinding::Input& input : binding_.inputs)
            append(input.leaf.scalar, row.cells[input.column],
                   header_.name + ":" + std::to_string(row.line) + ": " + header_.columns[input.column]);
        if (binding_.inputs.empty()) inputs_.push_back(0.0f);
        ++rows_;
    }

    bool isFull() const override { return rows_ >= kMostRows; }

    std::vector<std::string> finish() override {
        const ResultTable results = evaluator_.evaluate(inputs_);
        std::vector<std::string> lines;
        lines.reserve(results.rows());
        for (size_t i = 0; i < results.rows(); ++i)
            lines.push_back(line(results.row(i)));
        inputs_.clear();
        rows_ = 0;
        return lines;
    }

private:
    void append(GlslScalar scalar, const std::string& cell, const std::string& where) {
        if (scalar == GlslScalar::floating) {
            const double number = requireNumber(cell, where);
            if (std::isfinite(number) && std::abs(number) > double{FLT_MAX})
                throw InputError(where + ": " + cell + "; expected a float, at most 3.40282347e+38");
            inputs_.push_back(static_cast<float>(number));
        } else if (scalar == GlslScalar::boolean) {
            const bool yes = cell == "1" || cell == "true";
            if (!yes && cell != "0" && cell != "false")
                throw InputError(where + ": '" + cell + "'; expected true, false, 1 or 0");
            inputs_.push_back(yes ? 1.0f : 0.0f);
        } else {
            const bool isSigned = scalar == GlslScalar::integer;
            const int64_t low = isSigned ? std::numeric_limits<int32_t>::min() : 0;
            const int64_t high =
                isSigned ? std::numeric_limits<int32_t>::max() : std::numeric_limits<uint32_t>::max();
            const std::optional<int64_t> number = parseInteger(cell);
            if (!number || *number < low || *number > high)
                throw InputError(where + ": '" + cell + "'; expected a whole number, " + std::to_string(low) +
                                 ".." + std::to_string(high));
            inputs_.push_back(static_cast<float>(*number >> 16));
            inputs_.push_back(static_cast<float>(*number & 0xffff));
        }
    }

    std::string line(std::span<const float> results) const {
        std::string text;
        size_t at = 0;
        for (const FunctionBinding::Output& output : binding_.outputs) {
            if (!text.empty()) text += ',';
            if (output.leaf.scalar == GlslScalar::floating)
                text += numberText(double{results[at]});
            else if (output.leaf.scalar == GlslScalar::boolean)
                text += results[at] != 0.0f ? "1" : "0";
            else
                text += std::to_string(static_cast<int64_t>(results[at]) * 65536 +
                                       static_cast<int64_t>(results[at + 1]));
            at += static_cast<size_t>(floatsOf(output.leaf.scalar));
        }
        return text;
    }

    TableHeader header_;
    FunctionBinding binding_;
    Evaluator evaluator_;
    std::vector<float> inputs_;
    size_t rows_ = 0;
};

}  // namespace

std::unique_ptr<TableEvaluation> functionEvaluation(const std::filesystem::path& file,
                                                    const std::string& function, const TableHeader& header) {
    std::error_code failed;
    const std::filesystem::path path = std::filesystem::canonical(file, failed);
    if (failed) throw InputError(file.string() + ": can't be read: " + failed.message());
    if (std::filesystem::is_directory(path))
        throw InputError(file.string() + ": is a folder; expected a GLSL file");
    const auto library = gl::ShaderLibrary::ofFiles({path.parent_path(), shaderDirectory()});
    return std::make_unique<FunctionTable>(library, path.string(), file.string(), function, header);
}

}  // namespace lobe::harness
