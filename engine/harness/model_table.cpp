#include "harness/model_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "harness/column_names.hpp"

namespace lobe::harness {
namespace {

/// Where one parameter comes from.
struct ParameterSource {
    size_t parameter = 0;
    size_t offset = 0;  ///< in the values
    Channels columns;
};

/// An end of the range that was a float meanwhile is that end.
double withBounds(const Parameter& parameter, double value) {
    for (const double bound : {parameter.minimum, parameter.maximum})
        if (static_cast<float>(value) == static_cast<float>(bound)) return bound;
    return value;
}

std::string numbered(const std::string& name, size_t i) {
    return name + std::to_string(i);
}

}  // namespace

struct ModelColumns::State {
    const Brdf& brdf;
    std::string file;
    std::vector<std::string> columns;
    Channels l, v;
    std::vector<ParameterSource> sources;
    std::vector<std::vector<Channels>> elements;  ///< of the table: element, column
    std::optional<size_t> tableName;
    int fresnelChoice = -1;  ///< the parameter that follows from which of f0, eta, k are given
    bool scalesLengths = false;
    double lengthScale = 1.0;

    ParameterValues defaults;
    ParameterValues values;
    uint64_t table = 0;
    std::vector<double> elementNumbers, knownElements;
    std::string knownName;
    std::map<std::string, TableRows> namedTables;

    State(const Brdf& model, const std::vector<std::string>& names, std::string fileName)
        : brdf(model), file(std::move(fileName)), columns(names) {
        defaults = brdf.defaults();
        defaults.resize(static_cast<size_t>(brdf.valueCount()));
        values = defaults;
    }

    std::string place(const CsvRow& row, size_t column) const {
        return file + ":" + std::to_string(row.line) + ": " + columns[column];
    }

    double number(const CsvRow& row, size_t column) const {
        return requireNumber(row.cells[column], place(row, column));
    }

    glm::dvec3 rgb(const CsvRow& row, const Channels& channels) const {
        glm::dvec3 result;
        for (size_t c = 0; c < 3; ++c)
            result[static_cast<int>(c)] = number(row, channels.at[c]);
        return result;
    }

    bool isEmpty(const CsvRow& row, const Channels& channels, int components) const {
        const auto empty = [&](size_t column) { return row.cells[column].empty(); };
        return std::all_of(channels.at.begin(), channels.at.begin() + components, empty);
    }

    void setTable(const TableRows& rows) {
        values.resize(defaults.size());
        values.insert(values.end(), rows.begin(), rows.end());
        ++table;
    }

    glm::dvec3 direction(const CsvRow& row, const Channels& components, double& length) const {
        const glm::dvec3 w = rgb(row, components);
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(w[c]))
                throw InputError(place(row, components.at[static_cast<size_t>(c)]) + ": " + numberText(w[c]) +
                                 "; expected a finite number");
        const double largest = std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
        if (largest == 0.0)
            throw InputError(place(row, components.at[0]) +
                             ": a direction of length 0; expected one of length 1");
        // By a power of two, which rounds nothing; then squares neither overflow nor vanish.
        const int exponent = std::ilogb(largest);
        const glm::dvec3 scaled(std::ldexp(w.x, -exponent), std::ldexp(w.y, -exponent),
                                std::ldexp(w.z, -exponent));
        length = std::ldexp(glm::length(scaled), exponent);
        return glm::normalize(scaled);
    }

    void readParameter(const CsvRow& row, const ParameterSource& source) {
        const Parameter& parameter = brdf.parameters[source.parameter];
        double* out = values.data() + source.offset;
        const double* standard = defaults.data() + source.offset;
        if (!parameter.group.empty() && isEmpty(row, source.columns, parameter.components())) {
            std::copy_n(standard, parameter.components(), out);
        } else if (parameter.kind == ParameterKind::choice) {
            const std::string& name = row.cells[source.columns.at[0]];
            const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), name);
            if (found == parameter.choices.end())
                throw InputError(place(row, source.columns.at[0]) + ": '" + name + "'; expected " +
                                 joined(parameter.choices) + didYouMean(name, parameter.choices));
            *out = static_cast<double>(found - parameter.choices.begin());
        } else {
            for (int c = 0; c < parameter.components(); ++c)
                out[c] = withBounds(parameter, number(row, source.columns.at[static_cast<size_t>(c)]));
        }
    }

    static std::string joined(const std::vector<std::string>& names) {
        std::string all;
        for (const std::string& name : names)
            all += (all.empty() ? "" : " or ") + name;
        return all;
    }

    bool given(const CsvRow& row, const char* name) const {
        return std::any_of(sources.begin(), sources.end(), [&](const ParameterSource& source) {
            const Parameter& parameter = brdf.parameters[source.parameter];
            return parameter.name == name && !isEmpty(row, source.columns, parameter.components());
        });
    }

    /// The type of Fresnel's equations, from the cells that are there.
    void chooseFresnel(const CsvRow& row) {
        const bool f0 = given(row, "f0");
        const bool eta = given(row, "eta");
        const bool k = given(row, "k");
        const std::string where = file + ":" + std::to_string(row.line) + ": ";
        if (f0 && (eta || k))
            throw InputError(where + "both f0 and eta or k; expected one of them, or a column fresnel");
        if (k && !eta) throw InputError(where + "k without eta; expected both for a conductor");
        const Parameter& parameter = brdf.parameters[static_cast<size_t>(fresnelChoice)];
        const auto offset = static_cast<size_t>(brdf.valueOffset(fresnelChoice));
        const std::string type = k ? "conductor" : eta ? "dielectric" : f0 ? "schlick" : "";
        const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), type);
        values[offset] = found == parameter.choices.end()
                             ? defaults[offset]
                             : static_cast<double>(found - parameter.choices.begin());
    }

    template<typename Function>
    void forEachLength(const Function& function) {
        for (const ParameterSource& source : sources) {
            const Parameter& parameter = brdf.parameters[source.parameter];
            for (int c = 0; parameter.unit == "m" && c < parameter.components(); ++c)
                function(parameter, values[source.offset + static_cast<size_t>(c)]);
        }
    }

    /// Only ratios of lengths count. Those outside the registry's range, as nanometres are, become metres of
    /// visible light; a power of two keeps them to the last bit.
    void scaleLengths(const CsvRow& row) {
        lengthScale = 1.0;
        bool asTheyAre = true;
        forEachLength([&](const Parameter& parameter, double value) {
            asTheyAre = asTheyAre && value >= parameter.minimum && value <= parameter.maximum;
        });
        if (asTheyAre) return;
        const auto at = static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex("wavelength")));
        const double longest = std::max({values[at], values[at + 1], values[at + 2]});
        if (!(longest > 0.0 && std::isfinite(longest)))
            throw InputError(file + ":" + std::to_string(row.line) + ": wavelength: " + numberText(longest) +
                             "; expected above 0");
        constexpr double kVisible = 5e-7;
        lengthScale = std::exp2(std::round(std::log2(kVisible / longest)));
        forEachLength([&](const Parameter&, double& value) { value *= lengthScale; });
    }

    void validate(const CsvRow& row) const {
        try {
            validateParameters(brdf, values, file + ":" + std::to_string(row.line));
        } catch (const InputError& error) {
            if (lengthScale == 1.0) throw;
            throw InputError(std::string(error.what()) + "; lengths were multiplied by " +
                             numberText(lengthScale) + " for a wavelength near 5e-7");
        }
    }

    void readTable(const CsvRow& row) {
        if (tableName) {
            const std::string& name = row.cells[*tableName];
            if (table > 0 && name == knownName) return;
            setTable(named(name, place(row, *tableName)));
            knownName = name;
        }
        if (elements.empty()) return;
        elementNumbers.clear();
        bool ended = false;
        for (size_t i = 0; i < elements.size(); ++i) {
            const bool empty = std::all_of(elements[i].begin(), elements[i].end(),
                                           [&](const Channels& c) { return isEmpty(row, c, 3); });
            if (ended && !empty)
                throw InputError(place(row, elements[i][0].at[0]) + ": an element after an empty one");
            ended = empty;
            for (size_t c = 0; !empty && c < elements[i].size(); ++c) {
                const glm::dvec3 numbers = rgb(row, elements[i][c]);
                for (int channel = 0; channel < 3; ++channel)
                    if (!std::isfinite(numbers[channel]))
                        throw InputError(place(row, elements[i][c].at[static_cast<size_t>(channel)]) + ": " +
                                         numberText(numbers[channel]) + "; expected a finite number");
                elementNumbers.insert(elementNumbers.end(), {numbers.r, numbers.g, numbers.b});
            }
        }
        if (table > 0 && elementNumbers == knownElements) return;
        try {
            setTable(brdf.table->fromColumns(elementNumbers));
        } catch (const InputError& error) {
            throw InputError(file + ":" + std::to_string(row.line) + ": " + error.what());
        }
        knownElements = elementNumbers;
    }

    const TableRows& named(const std::string& name, const std::string& where) {
        if (namedTables.empty())
            for (auto& [known, rows] : brdf.table->examples())
                namedTables.emplace(known, std::move(rows));
        const auto found = namedTables.find(name);
        if (found != namedTables.end()) return found->second;
        std::vector<std::string> names;
        for (const auto& [known, rows] : namedTables)
            names.push_back(known);
        throw InputError(where + ": '" + name + "'; expected " + joined(names) + didYouMean(name, names));
    }

    void findTable(ColumnNames& names, const std::optional<TableRows>& forAll) {
        const std::string& parameter = brdf.parameters[static_cast<size_t>(brdf.tableParameter())].name;
        tableName = names.find(parameter);
        constexpr size_t kMostElements = 64;
        for (size_t i = 0; i < kMostElements && !brdf.table->columns.empty(); ++i) {
            std::vector<Channels> element;
            std::string missing;
            for (const std::string& column : brdf.table->columns) {
                const auto found = names.findRgb(numbered(column, i));
                if (found)
                    element.push_back(*found);
                else
                    missing = numbered(column, i);
            }
            if (element.empty()) break;
            if (!missing.empty()) names.fail("no column " + missing);
            elements.push_back(std::move(element));
        }
        const int ways = (tableName ? 1 : 0) + (elements.empty() ? 0 : 1) + (forAll ? 1 : 0);
        if (ways == 1) return;
        std::string expected = "a column " + parameter + ", or --table for all rows";
        if (!brdf.table->columns.empty()) {
            std::string list;
            for (const std::string& column : brdf.table->columns)
                list += column + "0, ";
            expected = "columns " + list + "..., " + expected;
        }
        names.fail(brdf.name + ": " + (ways == 0 ? "no " : "more than one source of ") + parameter +
                   "; expected " + expected);
    }
};

ModelColumns::ModelColumns(const Brdf& brdf, const std::vector<std::string>& columns, std::string name,
                           const std::optional<TableRows>& table)
    : state_(std::make_unique<State>(brdf, columns, std::move(name))) {
    State& s = *state_;
    ColumnNames names(s.columns, s.file);
    names.find("id");
    const char* axes[3] = {"x", "y", "z"};
    for (size_t c = 0; c < 3; ++c)
        s.l.at[c] = names.require(std::string("l") + axes[c]);
    for (size_t c = 0; c < 3; ++c)
        s.v.at[c] = names.require(std::string("v") + axes[c]);
    for (size_t i = 0; i < brdf.parameters.size(); ++i) {
        const Parameter& parameter = brdf.parameters[i];
        if (parameter.kind == ParameterKind::table) continue;
        ParameterSource source{i, static_cast<size_t>(brdf.valueOffset(static_cast<int>(i))), {}};
        bool found = false;
        if (parameter.kind == ParameterKind::rgb) {
            const auto channels = names.findRgb(parameter.name);
            found = channels.has_value();
            if (found) source.columns = *channels;
        } else if (const auto column = names.find(parameter.name)) {
            found = true;
            source.columns.at = {*column, *column, *column};
        }
        if (found) s.sources.push_back(source);
        if (found && parameter.name == "wavelength") s.scalesLengths = true;
        if (!found && parameter.name == "fresnel" && parameter.kind == ParameterKind::choice)
            s.fresnelChoice = static_cast<int>(i);
    }
    if (brdf.table) s.findTable(names, table);
    if (table) s.setTable(*table);
    names.refuseOthers(brdf.name);
}

ModelColumns::~ModelColumns() = default;

ModelColumns::Row ModelColumns::read(const CsvRow& row) {
    State& s = *state_;
    Row result{};
    result.l = s.direction(row, s.l, result.lengthL);
    result.v = s.direction(row, s.v, result.lengthV);
    for (const ParameterSource& source : s.sources)
        s.readParameter(row, source);
    if (s.fresnelChoice >= 0) s.chooseFresnel(row);
    if (s.scalesLengths) s.scaleLengths(row);
    s.readTable(row);
    s.validate(row);
    result.values = s.values;
    result.table = s.table;
    return result;
}

}  // namespace lobe::harness
