/// Columns of a CSV file as tests name them: csv("file.csv", column, ...).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/unit/directive_reader.hpp"

namespace lobe::harness {

struct CsvColumns {
    std::filesystem::path file;
    std::vector<std::string> columns;

    /// Reads what stands after the word csv. `folder` is where relative names start. The file is not opened.
    static CsvColumns parse(DirectiveReader& reader, const std::filesystem::path& folder);

    /// The columns' numbers, row by row; decimal or hexadecimal, inf and nan too. Throws InputError naming
    /// file, line and column.
    std::vector<std::vector<double>> rows() const;
};

}  // namespace lobe::harness
