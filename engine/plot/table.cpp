#include "plot/table.hpp"

#include <array>
#include <cassert>
#include <charconv>

namespace lobe::plot {
namespace {

constexpr int kSignificantDigits = 9;

std::string fieldText(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

}  // namespace

std::string numberText(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0,
                                   std::chars_format::general, kSignificantDigits);
    return {text.data(), end.ptr};
}

void Table::add(std::vector<Cell> row) {
    assert(row.size() == columns_.size());
    rows_.push_back(std::move(row));
}

std::string Table::csv() const {
    std::string text;
    for (const std::string& column : columns_)
        text += (text.empty() ? "" : ",") + fieldText(column);
    text += '\n';
    for (const std::vector<Cell>& row : rows_) {
        for (size_t i = 0; i < row.size(); ++i) {
            if (i > 0) text += ',';
            const double* number = std::get_if<double>(&row[i]);
            text += number != nullptr ? numberText(*number) : fieldText(std::get<std::string>(row[i]));
        }
        text += '\n';
    }
    return text;
}

}  // namespace lobe::plot
