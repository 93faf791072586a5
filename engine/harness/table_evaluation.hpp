/// A table's rows evaluated, some thousands at a time: by any GLSL function, by a registered model's GLSL, or
/// by its twin.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/csv.hpp"
#include "harness/model_table.hpp"
#include "harness/signature.hpp"

namespace lobe::harness {

class TableEvaluation {
public:
    virtual ~TableEvaluation() = default;
    virtual std::vector<std::string> resultColumns() const = 0;
    /// Throws InputError that names file, line and column.
    virtual void add(const CsvRow& row) = 0;
    /// No more may be added before finish().
    virtual bool isFull() const = 0;
    /// The results of the rows that were added, in order, each as the cells of a line, and forgets them.
    virtual std::vector<std::string> finish() = 0;
    /// What people should know of the rows so far, one line each.
    const std::vector<std::string>& warnings() const { return warnings_; }

protected:
    std::vector<std::string> warnings_;
};

/// Of a table that is evaluated.
struct TableHeader {
    std::string name;  ///< of its file, for messages
    std::vector<std::string> columns;
};

/// f_r cos of a registered model, columns f_cos_r, f_cos_g, f_cos_b, by its GLSL. Directions and their sum h
/// are rounded to floats once each, from double. The context must be current.
std::unique_ptr<TableEvaluation> modelEvaluation(const Brdf& brdf, const TableHeader& header,
                                                 const std::optional<TableRows>& table);
/// The same by the twin, on the numbers as written, in double.
std::unique_ptr<TableEvaluation> twinEvaluation(const Brdf& brdf, const TableHeader& header,
                                                const std::optional<TableRows>& table);

/// Any function of a GLSL file, whose includes are looked for beside it and in Lobe's library. Columns are
/// named as the function's parameters: `x`, `v.x` or `v_x` (xyzw or rgba), `p.alpha` or `p_alpha` for fields
/// of structs; results are `result` and the names of `out` parameters. Of several functions of that name the
/// one is taken whose parameters the columns fit. int and uint are exact, bool is true, false, 1 or 0. The
/// context must be current. Throws ShaderError with file and line, UsageError for an unknown name (with the
/// nearest), InputError for columns that do not fit.
std::unique_ptr<TableEvaluation> functionEvaluation(const std::filesystem::path& file,
                                                    const std::string& function, const TableHeader& header);

}  // namespace lobe::harness
