/// Tables of directions and parameters for a reflectance model, as people write them: columns to the model's
/// values.
///
/// Columns: lx, ly, lz to the light and vx, vy, vz to the eye, in the tangent frame (z normal, x tangent), of
/// any length but 0: they are normalised in double. Then parameters by their names in scenes. A number: NAME.
/// An rgb one: NAME for all channels, or NAME_r, NAME_g, NAME_b. A choice: NAME, with the name of the choice.
/// Columns of a table: NAMEi for element i from 0 on, each an rgb one; or the table's parameter, with the
/// name of one that comes with Lobe. `fresnel` may be left out: f0 makes it schlick, eta and k conductor, eta
/// alone dielectric; cells of these may be empty where rows differ, and so may all cells of an element that a
/// row does not have. Columns left out have the registry's default.
///
/// An end of a parameter's range that has been rounded to a float counts as that end.
/// Lengths (unit m in the registry) are in any one unit where there is a column `wavelength`: only their
/// ratios count.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/csv.hpp"
#include "shading/brdf.hpp"

namespace lobe::harness {

/// Reads rows of a table whose columns are known.
class ModelColumns {
public:
    /// `table` is for all rows, where the model has one and rows do not say theirs; `name` of the file is for
    /// messages. Throws InputError: columns that are missing, not known (with the nearest name), or
    /// contradict each other.
    ModelColumns(const Brdf& brdf, const std::vector<std::string>& columns, std::string name,
                 const std::optional<TableRows>& table = {});
    ~ModelColumns();
    ModelColumns(const ModelColumns&) = delete;
    ModelColumns& operator=(const ModelColumns&) = delete;

    /// One row; valid until the next is read.
    struct Row {
        glm::dvec3 l, v;                 ///< unit
        double lengthL, lengthV;         ///< as they were written
        std::span<const double> values;  ///< valid for the model, its table behind them
        uint64_t table;  ///< the same number for the same table as in the row before, else another
    };
    /// Throws InputError: "FILE:LINE: COLUMN: VALUE; expected ...".
    Row read(const CsvRow& row);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A table for all rows: the name of one that comes with Lobe, or a file of the model's format. Throws
/// InputError, or UsageError where the model has none.
TableRows tableForAllRows(const Brdf& brdf, const std::string& nameOrFile);

}  // namespace lobe::harness
