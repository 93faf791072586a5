#include "harness/unit/shrink.hpp"

#include <algorithm>
#include <array>

#include "harness/unit/simplify.hpp"

namespace lobe::harness {
namespace {

constexpr int kMostRounds = 100;

Words valueOf(const TestInput& input, const UnitRow& row) {
    const auto first = row.words.begin() + input.offset;
    return {first, first + input.type.components};
}

UnitRow with(const TestInput& input, UnitRow row, const Words& value) {
    std::copy(value.begin(), value.end(), row.words.begin() + input.offset);
    return row;
}

/// For monotone expectations: the value must stay below its partner.
bool isOrdered(const TestCase& test, const UnitRow& row) {
    if (test.monotone() == nullptr) return true;
    const TestInput& input = test.monotoneInput();
    return numberOf(input.type.base, row.words[static_cast<size_t>(input.offset)]) <
           numberOf(input.type.base, row.partner);
}

std::vector<UnitRow> candidatesFor(const TestCase& test, const UnitRow& row) {
    std::vector<UnitRow> candidates;
    UnitRow allFirst = row;  // every input as simple as it gets
    for (const TestInput& input : test.inputs) {
        // Rows of a file stay together.
        if (input.generator && !input.generator->csvFile().empty()) continue;
        const std::vector<Words> values = simplerValues(test, input, valueOf(input, row));
        for (const Words& value : values)
            candidates.push_back(with(input, row, value));
        if (!values.empty()) allFirst = with(input, allFirst, values.front());
        // The same value in several inputs at once: directions that must be equal, say.
        for (const TestInput& other : test.inputs) {
            if (&other <= &input || !(other.type == input.type)) continue;
            for (const Words& value : values)
                if (inputAllows(test, other, value))
                    candidates.push_back(with(other, with(input, row, value), value));
            if (inputAllows(test, other, valueOf(input, row)))
                candidates.push_back(with(other, row, valueOf(input, row)));
        }
    }
    candidates.push_back(allFirst);
    if (test.monotone() != nullptr) {
        const TestInput& input = test.monotoneInput();
        for (const Words& value : simplerValues(test, input, {row.partner})) {
            UnitRow changed = row;
            changed.partner = value[0];
            candidates.push_back(changed);
            for (const Words& lower : simplerValues(test, input, valueOf(input, row)))
                candidates.push_back(with(input, changed, lower));
        }
    }
    return candidates;
}

}  // namespace

double complexityOfRow(const TestCase& test, const UnitRow& row) {
    double sum = 0.0;
    for (const TestInput& input : test.inputs)
        sum += complexity(input.type, valueOf(input, row));
    if (test.monotone() != nullptr) {
        const std::array<uint32_t, 1> partner{row.partner};
        sum += complexity(test.monotoneInput().type, partner);
    }
    return sum;
}

UnitRow shrunk(UnitJudge& judge, const TestCase& test, UnitRow row, const Fault& fault) {
    for (int round = 0; round < kMostRounds; ++round) {
        const double limit = complexityOfRow(test, row);
        std::vector<std::pair<double, UnitRow>> candidates;
        for (UnitRow& candidate : candidatesFor(test, row)) {
            const double score = complexityOfRow(test, candidate);
            if (score < limit && isOrdered(test, candidate))
                candidates.emplace_back(score, std::move(candidate));
        }
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        if (candidates.size() > UnitProgram::kMostRows) candidates.resize(UnitProgram::kMostRows);
        UnitRows rows;
        for (const auto& [score, candidate] : candidates)
            rows.append(candidate);
        if (rows.count == 0) break;
        const Verdicts verdicts = judge.judge(rows);
        const auto simplest = std::find_if(verdicts.faults.begin(), verdicts.faults.end(),
                                           [&](const auto& found) { return found.second.isAlike(fault); });
        if (simplest == verdicts.faults.end()) break;
        row = candidates[simplest->first].second;
    }
    return row;
}

}  // namespace lobe::harness
