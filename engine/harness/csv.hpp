/// Tables as CSV files, read strictly (RFC 4180): a header, then rows with as many cells.
///
/// Commas separate, double quotes enclose cells that hold commas, quotes (doubled) or line ends. LF, CRLF and
/// a byte order mark at the start are taken; blank lines are skipped; spaces around a cell that is not quoted
/// are not part of it. There are no comments. Whatever else is found is refused, with file and line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lobe::harness {

/// One row and the line that it starts in, counted from 1.
struct CsvRow {
    std::vector<std::string> cells;
    size_t line = 0;
};

/// Reads row after row, in memory that does not grow with the file.
class CsvReader {
public:
    /// "-" is standard input. Throws InputError: a file that can't be read, no header, a column without name
    /// or twice.
    explicit CsvReader(const std::filesystem::path& path);
    /// `name` stands for the file in messages.
    CsvReader(std::istream& stream, std::string name);
    CsvReader(CsvReader&&) noexcept;
    CsvReader& operator=(CsvReader&&) noexcept;
    ~CsvReader();

    const std::string& name() const;
    const std::vector<std::string>& columns() const;
    /// False at the end. Throws InputError: a wrong number of cells, quotes that do not fit, a row above 1
    /// MiB.
    bool next(CsvRow& row);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A whole file.
struct CsvTable {
    std::string name;  ///< of the file, for messages
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    std::vector<size_t> lines;  ///< one a row: where it starts in the file

    std::optional<size_t> column(std::string_view columnName) const;
    /// Throws InputError: "FILE:LINE: COLUMN: 'CELL'; expected a number".
    double number(size_t row, size_t columnIndex) const;
};

/// Throws as CsvReader does.
CsvTable readCsv(const std::filesystem::path& path);
CsvTable readCsv(std::istream& stream, const std::string& name);

/// Decimal or hexadecimal (0x1.8p-3), with sign, or inf, infinity, nan in any case; nothing before or after.
/// Empty where the text is not a number; numbers beyond the range of double are none.
std::optional<double> parseNumber(std::string_view text);
std::optional<int64_t> parseInteger(std::string_view text);
/// Throws InputError: "WHERE: 'TEXT'; expected a number".
double requireNumber(std::string_view text, const std::string& where);

/// 9 significant digits, from which a float is read back as it was; "nan" (without sign), "inf", "-inf".
std::string numberText(double value);

/// Appends the cell, quoted where it must be.
void appendCell(std::string& line, std::string_view cell);
/// Appends the cells, commas between them, and a line end.
void appendRow(std::string& text, const std::vector<std::string>& cells);

}  // namespace lobe::harness
