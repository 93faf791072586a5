#include "harness/unit/unit_judge.hpp"

#include "harness/model_check.hpp"

namespace lobe::harness {
namespace {

std::span<const uint32_t> csvWords(const Expectation& expectation, const UnitRows& rows, size_t i) {
    return expectation.csvRows.at(rows.csvRows.at(i));
}

/// Which rows differ from the model's twin; empty where the test expects no twin.
std::vector<bool> twinFaultsOf(const TestCase& test, const UnitRows& rows, const RowOutputs& outputs) {
    bool expected = false;
    for (const Expectation& expectation : test.expectations)
        expected |= expectation.kind == Expectation::Kind::twin;
    if (!expected) return {};
    std::vector<BrdfRow> table;
    std::vector<glm::vec3> got;
    for (size_t i = 0; i < rows.count; ++i) {
        table.push_back(brdfRowOf(test, std::span(rows.words).subspan(i * rows.width, rows.width)));
        const auto value = outputs.row(i).value(3);
        got.emplace_back(realOf(value[0]), realOf(value[1]), realOf(value[2]));
    }
    std::vector<bool> faults(rows.count, false);
    ModelCheck check(*test.model);
    check.add(table, got);
    for (const ModelFault& fault : check.faults())
        faults[fault.row] = true;
    return faults;
}

}  // namespace

size_t referenceIndex(const TestCase& test, size_t expectation) {
    size_t index = 0;
    for (size_t i = 0; i < expectation; ++i)
        index += test.expectations[i].kind == Expectation::Kind::equalsFunction ? 1U : 0U;
    return index;
}

std::optional<Words> expectedWords(const TestCase& test, size_t index, const Evaluation& evaluation) {
    const Expectation& expectation = test.expectations[index];
    switch (expectation.kind) {
        case Expectation::Kind::equalsFunction: {
            const auto words = evaluation.result().reference(referenceIndex(test, index));
            return Words(words.begin(), words.begin() + test.result->components);
        }
        case Expectation::Kind::equalsValue:
            return expectation.value;
        case Expectation::Kind::equalsCsv:
            return expectation.csvRows.at(evaluation.row.csvRow);
        default:
            return std::nullopt;
    }
}

std::optional<Fault> UnitJudge::faultOf(const UnitRows& rows, size_t i, const RowOutput& output,
                                        const RowOutput& partner, const std::vector<bool>& twinFaults) const {
    if (output.failedLine() != 0) return Fault{Fault::Kind::check, output.failedLine(), 0};
    if (!test_.result) return std::nullopt;
    const auto value = output.value(test_.result->components);
    if (test_.result->base == GlslType::Base::boolean) {
        for (size_t c = 0; c < value.size(); ++c)
            if (value[c] == 0) return Fault{Fault::Kind::returnedFalse, 0, static_cast<int>(c)};
        return std::nullopt;
    }
    size_t reference = 0;
    for (size_t e = 0; e < test_.expectations.size(); ++e) {
        const Expectation& expectation = test_.expectations[e];
        std::span<const uint32_t> against;
        switch (expectation.kind) {
            case Expectation::Kind::twin:
                if (twinFaults[i]) return Fault{Fault::Kind::expectation, e, 0};
                continue;
            case Expectation::Kind::monotone:
                against = partner.value(test_.result->components);
                break;
            case Expectation::Kind::equalsFunction:
                against = output.reference(reference++);
                break;
            case Expectation::Kind::equalsValue:
                against = expectation.value;
                break;
            case Expectation::Kind::equalsCsv:
                against = csvWords(expectation, rows, i);
                break;
            default:
                break;
        }
        if (const auto component = expectation.firstFault(*test_.result, value, against))
            return Fault{Fault::Kind::expectation, e, *component};
    }
    return std::nullopt;
}

Verdicts UnitJudge::judge(const UnitRows& rows) {
    const RowOutputs outputs = program_.evaluate(rows.words);
    const bool pairs = test_.monotone() != nullptr;
    const RowOutputs partners = pairs ? program_.evaluate(rows.partnerWords(test_)) : RowOutputs{};
    const std::vector<bool> twinFaults = twinFaultsOf(test_, rows, outputs);
    Verdicts verdicts;
    for (size_t i = 0; i < rows.count; ++i) {
        const RowOutput output = outputs.row(i);
        const RowOutput partner = pairs ? partners.row(i) : output;
        if (output.skipped() || partner.skipped()) {
            ++verdicts.skipped;
            continue;
        }
        if (const auto fault = faultOf(rows, i, output, partner, twinFaults))
            verdicts.faults.emplace_back(i, *fault);
    }
    return verdicts;
}

Evaluation UnitJudge::evaluate(const UnitRow& row) const {
    UnitRows one;
    one.append(row);
    Evaluation result{row, program_.evaluate(one.words).words, {}};
    if (test_.monotone() != nullptr) result.partnerOutput = program_.evaluate(one.partnerWords(test_)).words;
    return result;
}

}  // namespace lobe::harness
