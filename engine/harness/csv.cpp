#include "harness/csv.hpp"

#include <csv.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <iostream>
#include <set>

#include "base/error.hpp"

namespace lobe::harness {
namespace {

constexpr size_t kLongestRow = 1 << 20;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string countOf(size_t n, const std::string& noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

std::string shortened(std::string_view text) {
    constexpr size_t kLongest = 60;
    return text.size() <= kLongest ? std::string(text) : std::string(text.substr(0, kLongest)) + "...";
}

std::unique_ptr<std::istream> openFile(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(path.string() + ": is a folder; expected a CSV file");
    auto stream = std::make_unique<std::ifstream>(path, std::ios::binary);
    if (!*stream) throw InputError(path.string() + ": can't be read: " + std::strerror(errno));
    return stream;
}

}  // namespace

/// libcsv, fed line by line so that the lines are known.
struct CsvReader::State {
    std::unique_ptr<std::istream> file;
    std::istream* stream = nullptr;
    std::string name;
    std::vector<std::string> columns;
    csv_parser parser{};
    std::deque<CsvRow> complete;
    CsvRow open;
    size_t line = 0;
    size_t rowBytes = 0;
    bool ended = false;

    State(std::unique_ptr<std::istream> owned, std::istream& from, std::string fileName)
        : file(std::move(owned)), stream(&from), name(std::move(fileName)) {
        if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
    }
    ~State() { csv_free(&parser); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    [[noreturn]] void fail(size_t where, const std::string& what) const {
        throw InputError(name + ":" + std::to_string(where) + ": " + what);
    }

    static void onCell(void* text, size_t size, void* self) {
        auto& state = *static_cast<State*>(self);
        state.open.cells.emplace_back(static_cast<const char*>(text), size);
    }

    static void onRow(int, void* self) {
        auto& state = *static_cast<State*>(self);
        state.complete.push_back(std::move(state.open));
        state.open = {};
        state.open.line = state.line;
        state.rowBytes = 0;
    }

    void checkParsed(bool whole) {
        if (whole) return;
        const int error = csv_error(&parser);
        if (error == CSV_ENOMEM) throw std::bad_alloc();
        fail(open.line, error == CSV_EPARSE ? "a quote that is not closed, or not doubled within a cell"
                                            : csv_strerror(error));
    }

    /// Rows until one is complete or the file ends.
    void read() {
        std::string text;
        while (complete.empty() && !ended) {
            if (!std::getline(*stream, text)) {
                if (stream->bad()) fail(line, "can't be read further");
                ended = true;
                checkParsed(csv_fini(&parser, onCell, onRow, this) == 0);
                return;
            }
            ++line;
            if (open.cells.empty() && rowBytes == 0) open.line = line;
            if (line == 1 && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
            text += '\n';
            rowBytes += text.size();
            if (rowBytes > kLongestRow) fail(open.line, "more than 1 MiB in a row; is a quote not closed?");
            checkParsed(csv_parse(&parser, text.data(), text.size(), onCell, onRow, this) == text.size());
            if (text.find_first_not_of(" \t\r\n") == std::string::npos && open.cells.empty()) rowBytes = 0;
        }
    }

    void readHeader() {
        read();
        if (complete.empty())
            throw InputError(name + ": empty; expected a line with the names of the columns");
        columns = std::move(complete.front().cells);
        const size_t where = complete.front().line;
        complete.pop_front();
        std::set<std::string> seen;
        for (size_t i = 0; i < columns.size(); ++i) {
            if (columns[i].empty()) fail(where, "column " + std::to_string(i + 1) + " has no name");
            if (!seen.insert(columns[i]).second)
                fail(where, "column '" + shortened(columns[i]) + "' is there twice");
        }
    }
};

CsvReader::CsvReader(const std::filesystem::path& path) {
    if (path == "-") {
        state_ = std::make_unique<State>(nullptr, std::cin, "standard input");
    } else {
        auto stream = openFile(path);
        std::istream& from = *stream;
        state_ = std::make_unique<State>(std::move(stream), from, path.string());
    }
    state_->readHeader();
}

CsvReader::CsvReader(std::istream& stream, std::string name)
    : state_(std::make_unique<State>(nullptr, stream, std::move(name))) {
    state_->readHeader();
}

CsvReader::CsvReader(CsvReader&&) noexcept = default;
CsvReader& CsvReader::operator=(CsvReader&&) noexcept = default;
CsvReader::~CsvReader() = default;

const std::string& CsvReader::name() const {
    return state_->name;
}

const std::vector<std::string>& CsvReader::columns() const {
    return state_->columns;
}

bool CsvReader::next(CsvRow& row) {
    state_->read();
    if (state_->complete.empty()) return false;
    row = std::move(state_->complete.front());
    state_->complete.pop_front();
    if (row.cells.size() != state_->columns.size())
        state_->fail(row.line, countOf(row.cells.size(), "cell") + "; expected " +
                                   std::to_string(state_->columns.size()) + ", one a column");
    return true;
}

std::optional<size_t> CsvTable::column(std::string_view columnName) const {
    const auto found = std::find(columns.begin(), columns.end(), columnName);
    if (found == columns.end()) return {};
    return static_cast<size_t>(found - columns.begin());
}

double CsvTable::number(size_t row, size_t columnIndex) const {
    return requireNumber(rows[row][columnIndex],
                         name + ":" + std::to_string(lines[row]) + ": " + columns[columnIndex]);
}

namespace {

CsvTable readAll(CsvReader reader) {
    CsvTable table{reader.name(), reader.columns(), {}, {}};
    for (CsvRow row; reader.next(row);) {
        table.rows.push_back(std::move(row.cells));
        table.lines.push_back(row.line);
    }
    return table;
}

}  // namespace

CsvTable readCsv(const std::filesystem::path& path) {
    return readAll(CsvReader(path));
}

CsvTable readCsv(std::istream& stream, const std::string& name) {
    return readAll(CsvReader(stream, name));
}

std::optional<double> parseNumber(std::string_view text) {
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    if (text.starts_with('-')) return {};
    auto format = std::chars_format::general;
    if (text.starts_with("0x") || text.starts_with("0X")) {
        text.remove_prefix(2);
        // The standard takes "inf" after "0x" as well, and a second sign.
        if (text.empty() || (std::isxdigit(static_cast<unsigned char>(text[0])) == 0 && text[0] != '.'))
            return {};
        format = std::chars_format::hex;
    }
    double value = 0.0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value, format);
    if (failed != std::errc() || end != text.data() + text.size()) return {};
    return negative ? -value : value;
}

std::optional<int64_t> parseInteger(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    int64_t value = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

double requireNumber(std::string_view text, const std::string& where) {
    if (const std::optional<double> value = parseNumber(text)) return *value;
    throw InputError(where + ": '" + shortened(text) + "'; expected a number");
}

std::string numberText(double value) {
    if (std::isnan(value)) return "nan";
    constexpr int kDigits = 9;
    char text[32];
    const auto result = std::to_chars(text, text + sizeof text, value, std::chars_format::general, kDigits);
    return {text, result.ptr};
}

void appendCell(std::string& line, std::string_view cell) {
    const bool spaced = !cell.empty() && (std::isspace(static_cast<unsigned char>(cell.front())) != 0 ||
                                          std::isspace(static_cast<unsigned char>(cell.back())) != 0);
    if (!spaced && cell.find_first_of(",\"\r\n") == std::string_view::npos) {
        line += cell;
        return;
    }
    line += '"';
    for (const char c : cell) {
        if (c == '"') line += '"';
        line += c;
    }
    line += '"';
}

void appendRow(std::string& text, const std::vector<std::string>& cells) {
    for (size_t i = 0; i < cells.size(); ++i) {
        if (i > 0) text += ',';
        appendCell(text, cells[i]);
    }
    text += '\n';
}

}  // namespace lobe::harness
