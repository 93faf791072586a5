#include "harness/unit/csv_columns.hpp"

#include <optional>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "harness/csv.hpp"

namespace lobe::harness {

CsvColumns CsvColumns::parse(DirectiveReader& reader, const std::filesystem::path& folder) {
    CsvColumns result;
    reader.expect('(');
    result.file = folder / reader.quoted("the name of a CSV file");
    while (reader.accept(','))
        result.columns.push_back(reader.word("the name of a column"));
    reader.expect(')');
    if (result.columns.empty()) reader.fail("expected the name of a column");
    return result;
}

std::vector<std::vector<double>> CsvColumns::rows() const {
    const CsvTable table = readCsv(file);
    std::vector<size_t> places;
    for (const std::string& column : columns) {
        const std::optional<size_t> place = table.column(column);
        if (!place)
            throw InputError(file.string() + ": no column '" + column + "'" +
                             didYouMean(column, table.columns));
        places.push_back(*place);
    }
    std::vector<std::vector<double>> rows(table.rows.size());
    for (size_t row = 0; row < rows.size(); ++row)
        for (const size_t place : places)
            rows[row].push_back(table.number(row, place));
    return rows;
}

}  // namespace lobe::harness
