#include "harness/unit/unit_report.hpp"

#include <array>
#include <sstream>

#include "harness/comparison.hpp"

namespace lobe::harness {
namespace {

/// How check.glsl numbers what failed.
constexpr std::array<const char*, 9> kCheckTexts{"",
                                                 "true",
                                                 "a == b",
                                                 "|a - b| <= rel max(|a|, |b|)",
                                                 "|a - b| <= absolute",
                                                 "a and b at most so many ulp apart",
                                                 "a < b",
                                                 "a <= b",
                                                 "a is finite"};

Words wordsOf(const TestInput& input, const Words& row) {
    const auto first = row.begin() + input.offset;
    return {first, first + input.type.components};
}

void describeCheck(const UnitProgram& program, const Fault& fault, const RowOutput& output,
                   UnitFailure& failure) {
    failure.place = program.placeOf(fault.place).text();
    failure.expected = program.lineText(fault.place);
    const GlslType::Base base = output.failedBase();
    const auto values = output.failedValues();
    const uint32_t kind = std::min<uint32_t>(output.failedKind(), kCheckTexts.size() - 1);
    failure.values.emplace_back("wanted", kCheckTexts.at(kind));
    if (kind == 1) return;
    failure.values.emplace_back("a", shownText(base, values[0]));
    if (kind == 8) return;
    failure.values.emplace_back("b", shownText(base, values[1]));
    if (base == GlslType::Base::real && !isNanWord(values[0]) && !isNanWord(values[1]))
        failure.values.emplace_back("apart",
                                    std::to_string(wordDistance(base, values[0], values[1])) + " ulp");
}

/// The twin's values, and how far off in the units of the tolerance.
std::string twinMessage(const TestCase& test, const Evaluation& evaluation) {
    const auto value = evaluation.result().value(3);
    const glm::vec3 got(realOf(value[0]), realOf(value[1]), realOf(value[2]));
    const BrdfRow row = brdfRowOf(test, evaluation.row.words);
    Comparison comparison(*test.model, Axes::local);
    if (comparison.check(row, directionsOf(row), got)) return "";
    const std::string& message = comparison.message();
    return message.substr(std::min(message.find("channel"), message.size()));
}

void describeExpectation(const TestCase& test, const Evaluation& evaluation, const Fault& fault,
                         UnitFailure& failure) {
    const Expectation& expectation = test.expectations[fault.place];
    failure.place = expectation.place.text();
    failure.expected = expectation.text;
    const GlslType type = *test.result;
    const auto at = static_cast<size_t>(fault.component);
    const auto got = evaluation.result().value(type.components);
    const std::string component = type.components > 1 ? std::string(".") + "xyzw"[at] : "";
    if (expectation.kind == Expectation::Kind::monotone) {
        const auto above = RowOutput{evaluation.partnerOutput}.value(type.components);
        const TestInput& input = test.monotoneInput();
        const uint32_t low = evaluation.row.words[static_cast<size_t>(input.offset)];
        failure.values.emplace_back("at " + input.name + " = " + literalText(input.type.base, low),
                                    shownText(type.base, got[at]));
        failure.values.emplace_back(
            "at " + input.name + " = " + literalText(input.type.base, evaluation.row.partner),
            shownText(type.base, above[at]));
        failure.values.emplace_back("apart",
                                    std::to_string(wordDistance(type.base, got[at], above[at])) + " ulp");
        return;
    }
    failure.values.emplace_back("got", shownText(type, got));
    if (expectation.kind == Expectation::Kind::twin) {
        failure.values.emplace_back("twin", twinMessage(test, evaluation));
        return;
    }
    const auto expected = expectedWords(test, fault.place, evaluation);
    if (!expected) {
        if (type.components > 1) failure.values.emplace_back("fault in", component);
        return;
    }
    failure.values.emplace_back("expected", shownText(type, *expected));
    const std::string unit = type.isReal() ? " ulp" : "";
    if (!type.isReal() || (isFiniteWord(got[at]) && isFiniteWord((*expected)[at])))
        failure.values.emplace_back("apart" + component,
                                    std::to_string(wordDistance(type.base, got[at], (*expected)[at])) + unit);
}

std::string expectationText(const TestCase& test, size_t index, const Evaluation& evaluation) {
    const Expectation& expectation = test.expectations[index];
    if (expectation.kind != Expectation::Kind::equalsCsv) return expectation.text;
    return "equals " + literalText(*test.result, *expectedWords(test, index, evaluation)) +
           expectation.allowance.text();
}

}  // namespace

UnitFailure describeFailure(const UnitProgram& program, const TestCase& test, const Evaluation& evaluation,
                            const Fault& fault) {
    UnitFailure failure;
    for (const TestInput& input : test.inputs) {
        const Words words = wordsOf(input, evaluation.row.words);
        failure.inputs.push_back(
            {input.name, input.type.name(), shownText(input.type, words), literalText(input.type, words)});
    }
    switch (fault.kind) {
        case Fault::Kind::check:
            describeCheck(program, fault, evaluation.result(), failure);
            break;
        case Fault::Kind::returnedFalse:
            failure.place = test.place.text();
            failure.expected = test.function + " returns true";
            failure.values.emplace_back(
                "got", shownText(*test.result, evaluation.result().value(test.result->components)));
            break;
        default:
            describeExpectation(test, evaluation, fault, failure);
    }
    failure.regression = regressionTest(test, evaluation);
    return failure;
}

std::string regressionTest(const TestCase& test, const Evaluation& evaluation) {
    std::ostringstream text;
    text << "/// @test " << test.name << "_regression\n";
    if (test.stage == Stage::vertex) text << "/// @stage vertex\n";
    std::string parameters;
    std::string arguments;
    const TestInput* const monotone = test.monotone() != nullptr ? &test.monotoneInput() : nullptr;
    for (const TestInput& input : test.inputs) {
        // The parameter would hide the function.
        const std::string name = input.name + (input.name == test.function ? "_in" : "");
        text << "/// @in " << name << ": values("
             << literalText(input.type, wordsOf(input, evaluation.row.words));
        if (&input == monotone) text << ", " << literalText(input.type.base, evaluation.row.partner);
        text << ")\n";
        parameters += (parameters.empty() ? "" : ", ") + input.type.name() + " " + name;
        arguments += (arguments.empty() ? "" : ", ") + name;
    }
    if (test.model != nullptr) {
        parameters = "Dirs d, " + glslParameterType(*test.model) + " p";
        arguments = "d, p";
    }
    for (size_t i = 0; i < test.expectations.size(); ++i)
        text << "/// @expect " << expectationText(test, i, evaluation) << "\n";
    text << (test.result ? test.result->name() : "void") << " " << test.function << "_regression("
         << parameters << ") { " << (test.result ? "return " : "") << test.function << "(" << arguments
         << "); }\n";
    return text.str();
}

}  // namespace lobe::harness
