#include "harness/unit/unit_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace lobe::harness {
namespace {

constexpr uint64_t kMostCombinations = uint64_t{1} << 32;

bool isCsv(const TestInput& input) {
    return input.generator && !input.generator->csvFile().empty();
}

uint64_t hashOf(const std::string& text) {
    uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

/// The value that follows in order, `steps` on; the same at the end of the type.
uint32_t advanced(GlslType::Base base, uint32_t word, uint32_t steps) {
    if (base != GlslType::Base::real) {
        const double largest = base == GlslType::Base::integer ? 2147483647.0 : 4294967295.0;
        const double value = std::min(numberOf(base, word) + double(steps), largest);
        return static_cast<uint32_t>(static_cast<int64_t>(value));
    }
    if (!isFiniteWord(word)) return word;
    int64_t order =
        (word >> 31) != 0 ? -static_cast<int64_t>(word & 0x7fffffffU) : static_cast<int64_t>(word);
    order = std::min<int64_t>(order + steps, 0x7f7fffff);
    return order < 0 ? 0x80000000U | static_cast<uint32_t>(-order) : static_cast<uint32_t>(order);
}

/// Two values of a monotone input, the smaller first.
std::pair<uint32_t, uint32_t> ordered(const TestInput& input, uint32_t value, Pcg32& random) {
    const GlslType::Base base = input.type.base;
    const auto less = [&](uint32_t a, uint32_t b) { return numberOf(base, a) < numberOf(base, b); };
    const Generator& generator = *input.generator;
    if (generator.isList()) {  // neighbours in the list
        std::optional<uint32_t> above;
        std::optional<uint32_t> below;
        for (const Words& item : generator.list()) {
            if (less(value, item[0]) && (!above || less(item[0], *above))) above = item[0];
            if (less(item[0], value) && (!below || less(*below, item[0]))) below = item[0];
        }
        if (above) return {value, *above};
        return {below.value_or(value), value};
    }
    // A few floats on, anywhere, and at all distances between: steps hide between far pairs, slopes between
    // near ones.
    const uint32_t anywhere = generator.draw(random)[0];
    uint32_t other = anywhere;
    switch (random.below(3)) {
        case 0:
            other = advanced(base, value, static_cast<uint32_t>(random.logUniform(1.0, 4096.0)));
            break;
        case 1:
            if (input.type.isReal()) {
                const double from = numberOf(base, value);
                const double to = numberOf(base, anywhere);
                other = wordOf(static_cast<float>(from + (to - from) * random.logUniform(1e-6, 1.0)));
            }
            break;
        default:
            break;
    }
    const std::array<uint32_t, 1> alone{other};
    if (!generator.allows(alone)) other = generator.draw(random)[0];
    if (less(other, value)) std::swap(other, value);
    if (!less(value, other)) other = advanced(base, value, 1);
    return {value, other};
}

/// Where the monotone input is the only one: three quarters of the rows in order, each with the next.
void chain(const TestInput& input, UnitRows& rows) {
    const auto value = [&](uint32_t word) { return numberOf(input.type.base, word); };
    const auto isChained = [](size_t i) { return i % 4 != 3; };
    std::vector<uint32_t> sorted;
    for (size_t i = 0; i < rows.count; ++i)
        if (isChained(i)) sorted.push_back(rows.words[i]);
    std::sort(sorted.begin(), sorted.end(), [&](uint32_t a, uint32_t b) { return value(a) < value(b); });
    sorted.erase(std::unique(sorted.begin(), sorted.end(),
                             [&](uint32_t a, uint32_t b) { return value(a) == value(b); }),
                 sorted.end());
    size_t link = 0;
    for (size_t i = 0; i < rows.count && link + 1 < sorted.size(); ++i)
        if (isChained(i)) {
            rows.words[i] = sorted[link];
            rows.partners[i] = sorted[++link];
        }
}

void storeBrdfRow(const TestCase& test, const BrdfRow& row, uint32_t* words) {
    for (int c = 0; c < 3; ++c) {
        words[c] = wordOf(row.wi[c]);
        words[3 + c] = wordOf(row.wo[c]);
    }
    for (size_t i = 2; i < test.inputs.size(); ++i) {
        const Parameter& parameter = test.model->parameters[i - 2];
        for (int c = 0; c < parameter.components(); ++c) {
            const auto at = static_cast<size_t>(test.inputs[i].offset) + static_cast<size_t>(c);
            words[at] = parameter.kind == ParameterKind::table    ? static_cast<uint32_t>(row.table)
                        : parameter.kind == ParameterKind::choice ? static_cast<uint32_t>(row.values[at - 6])
                                                                  : wordOf(row.values[at - 6]);
        }
    }
}

}  // namespace

UnitRow UnitRows::row(size_t i) const {
    UnitRow result;
    const auto first = words.begin() + static_cast<std::ptrdiff_t>(i * width);
    result.words.assign(first, first + static_cast<std::ptrdiff_t>(width));
    if (!partners.empty()) result.partner = partners[i];
    if (!csvRows.empty()) result.csvRow = csvRows[i];
    return result;
}

void UnitRows::append(const UnitRow& row) {
    width = row.words.size();
    ++count;
    words.insert(words.end(), row.words.begin(), row.words.end());
    partners.push_back(row.partner);
    csvRows.push_back(row.csvRow);
}

std::vector<uint32_t> UnitRows::partnerWords(const TestCase& test) const {
    std::vector<uint32_t> result = words;
    const auto offset = static_cast<size_t>(test.monotoneInput().offset);
    for (size_t i = 0; i < count; ++i)
        result[i * width + offset] = partners[i];
    return result;
}

RowSource::RowSource(const TestCase& test, int64_t rows, uint64_t seed)
    : test_(test), seed_(seed ^ hashOf(test.name)) {
    bool random = false;
    bool csvCounted = false;
    for (const TestInput& input : test.inputs) {
        if (!input.generator || !input.generator->isList()) {
            random = true;
            continue;
        }
        if (isCsv(input) && std::exchange(csvCounted, true)) continue;
        count_ *= input.generator->list().size();
        if (count_ > kMostCombinations)
            throw InputError(test.place.text() + ": " + test.name +
                             ": the lists have more than 2^32 combinations");
    }
    if (random) count_ = std::max(count_, static_cast<uint64_t>(rows));
}

UnitRows RowSource::rows(uint64_t first, size_t n) const {
    Pcg32 random(seed_, first);
    UnitRows rows;
    rows.width = static_cast<size_t>(test_.width());
    rows.count = n;
    rows.words.resize(n * rows.width);
    const bool hasMonotone = test_.monotone() != nullptr;
    const bool hasCsv = std::any_of(test_.inputs.begin(), test_.inputs.end(), isCsv);
    std::vector<BrdfRow> table;
    const bool needsTable =
        test_.model != nullptr && std::any_of(test_.inputs.begin(), test_.inputs.end(),
                                              [](const TestInput& input) { return !input.generator; });
    if (needsTable) table = brdfRows(*test_.model, static_cast<int>((n + 7) / 8), seed_ + first);
    for (size_t i = 0; i < n; ++i) {
        uint32_t* const words = rows.words.data() + i * rows.width;
        if (needsTable) storeBrdfRow(test_, table[i * table.size() / n], words);
        uint64_t combination = first + i;
        std::optional<size_t> csvRow;
        for (const TestInput& input : test_.inputs) {
            if (!input.generator) continue;
            const Generator& generator = *input.generator;
            Words value;
            if (!generator.isList()) {
                value = generator.draw(random);
            } else {
                const size_t size = generator.list().size();
                const bool follows = isCsv(input) && csvRow;  // another column of the same row
                const size_t index = follows ? *csvRow : combination % size;
                if (!follows) combination /= size;
                if (isCsv(input)) csvRow = index;
                value = generator.list()[index];
            }
            std::copy(value.begin(), value.end(), words + input.offset);
        }
        if (hasCsv) rows.csvRows.push_back(csvRow.value_or(0));
        if (hasMonotone) {
            const TestInput& input = test_.monotoneInput();
            const auto [low, high] = ordered(input, words[input.offset], random);
            words[input.offset] = low;
            rows.partners.push_back(high);
        }
    }
    if (hasMonotone && test_.inputs.size() == 1 && !test_.inputs[0].generator->isList())
        chain(test_.inputs[0], rows);
    return rows;
}

BrdfRow brdfRowOf(const TestCase& test, std::span<const uint32_t> words) {
    BrdfRow row{"test", {}, {}, {}, -1};
    for (int c = 0; c < 3; ++c) {
        row.wi[c] = realOf(words[static_cast<size_t>(c)]);
        row.wo[c] = realOf(words[static_cast<size_t>(c) + 3]);
    }
    for (size_t i = 2; i < test.inputs.size(); ++i) {
        const Parameter& parameter = test.model->parameters[i - 2];
        for (int c = 0; c < parameter.components(); ++c) {
            const uint32_t word = words[static_cast<size_t>(test.inputs[i].offset) + static_cast<size_t>(c)];
            const bool isTable = parameter.kind == ParameterKind::table;
            if (isTable) row.table = static_cast<int>(word);
            row.values.push_back(isTable                                   ? 0.0f
                                 : parameter.kind == ParameterKind::choice ? static_cast<float>(word)
                                                                           : realOf(word));
        }
    }
    return row;
}

bool inputAllows(const TestCase& test, const TestInput& input, std::span<const uint32_t> words) {
    if (input.generator) return input.generator->allows(words);
    const auto index = static_cast<size_t>(&input - test.inputs.data());
    if (index < 2) {
        const glm::dvec3 w(double(realOf(words[0])), double(realOf(words[1])), double(realOf(words[2])));
        return w.z > 0.0 && std::abs(glm::length(w) - 1.0) < 3e-7;
    }
    const Parameter& parameter = test.model->parameters[index - 2];
    if (parameter.kind == ParameterKind::table) return words[0] < packTables(*test.model).firstRow.size();
    const double high = parameter.kind == ParameterKind::choice
                            ? double(parameter.choices.size()) - 1.0
                            : double(static_cast<float>(parameter.maximum));
    const double low =
        parameter.kind == ParameterKind::choice ? 0.0 : double(static_cast<float>(parameter.minimum));
    return std::all_of(words.begin(), words.end(), [&](uint32_t word) {
        const double value = numberOf(input.type.base, word);
        return value >= low && value <= high;
    });
}

}  // namespace lobe::harness
