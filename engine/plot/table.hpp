/// The numbers behind a plot, as CSV.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace lobe::plot {

class Table {
public:
    using Cell = std::variant<double, std::string>;

    /// "angle [deg]": name and unit.
    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    /// As many cells as columns.
    void add(std::vector<Cell> row);

    size_t rowCount() const { return rows_.size(); }
    const std::vector<std::string>& columns() const { return columns_; }
    const std::vector<std::vector<Cell>>& rows() const { return rows_; }

    /// RFC 4180 with a header and bare line feeds; numbers with 9 significant digits.
    std::string csv() const;

private:
    std::vector<std::string> columns_;
    std::vector<std::vector<Cell>> rows_;
};

/// 9 significant digits, which tell any two floats apart; -0 is 0.
std::string numberText(double value);

}  // namespace lobe::plot
