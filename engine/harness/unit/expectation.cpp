#include "harness/unit/expectation.hpp"

#include <cmath>
#include <map>

#include "base/closest_name.hpp"

namespace lobe::harness {
namespace {

std::string shortText(double value) {
    return decimalText(static_cast<float>(value));
}

void parseMonotone(DirectiveReader& reader, Expectation& result) {
    result.strict = reader.acceptWord("strictly");
    if (reader.acceptWord("decreasing"))
        result.increasing = false;
    else if (!reader.acceptWord("increasing"))
        reader.fail("expected increasing or decreasing");
    if (reader.acceptWord("in")) result.input = reader.word("the name of an input");
}

void parseEquals(DirectiveReader& reader, GlslType type, const std::filesystem::path& folder,
                 Expectation& result) {
    if (reader.acceptWord("csv")) {
        result.kind = Expectation::Kind::equalsCsv;
        result.csv = CsvColumns::parse(reader, folder);
        if (result.csv->columns.size() != static_cast<size_t>(type.components))
            reader.fail("a " + type.name() + " is compared with " + std::to_string(type.components) +
                        " columns");
        for (const std::vector<double>& row : result.csv->rows()) {
            Words words;
            for (const double number : row)
                words.push_back(type.isReal() ? wordOf(static_cast<float>(number))
                                              : static_cast<uint32_t>(static_cast<int64_t>(number)));
            result.csvRows.push_back(std::move(words));
        }
        return;
    }
    const bool bracketed = reader.accept('(');
    if (!bracketed && !reader.nextIsNumber()) {
        result.kind = Expectation::Kind::equalsFunction;
        result.function = reader.word("a function, csv(...), or a value");
        return;
    }
    result.kind = Expectation::Kind::equalsValue;
    if (bracketed != (type.components > 1))
        reader.fail("expected a " + type.name() + (type.components > 1 ? " in brackets: (0, 0, 1)" : ""));
    for (int c = 0; c < type.components; ++c) {
        if (c > 0) reader.expect(',');
        result.value.push_back(type.isReal() ? wordOf(reader.real())
                                             : static_cast<uint32_t>(static_cast<int64_t>(reader.number())));
    }
    if (bracketed) reader.expect(')');
}

}  // namespace

Allowance Allowance::parse(DirectiveReader& reader) {
    Allowance result;
    if (!reader.acceptWord("within")) return result;
    do {
        if (reader.acceptWord("rel"))
            result.relative = reader.number();
        else if (reader.acceptWord("abs"))
            result.absolute = reader.number();
        else {
            result.ulps = static_cast<uint64_t>(reader.whole(0, int64_t{1} << 32));
            if (!reader.acceptWord("ulp")) reader.fail("expected 'N ulp', 'rel R' or 'abs A' after within");
        }
        for (const auto& part : {result.relative, result.absolute})
            if (part && !(*part >= 0.0)) reader.fail("a tolerance can't be negative");
    } while (reader.acceptWord("or"));
    return result;
}

std::string Allowance::text() const {
    std::string all;
    const auto add = [&](const std::string& part) { all += (all.empty() ? " within " : " or ") + part; };
    if (ulps) add(std::to_string(*ulps) + " ulp");
    if (relative) add("rel " + shortText(*relative));
    if (absolute) add("abs " + shortText(*absolute));
    return all;
}

bool Allowance::covers(GlslType::Base base, uint32_t got, uint32_t expected) const {
    const uint64_t distance = wordDistance(base, got, expected);
    if (distance <= ulps.value_or(0)) return true;
    if (base == GlslType::Base::real && (!isFiniteWord(got) || !isFiniteWord(expected))) return false;
    const double difference = std::abs(numberOf(base, got) - numberOf(base, expected));
    return (relative && difference <= *relative * std::abs(numberOf(base, expected))) ||
           (absolute && difference <= *absolute);
}

Expectation Expectation::parse(DirectiveReader& reader, GlslType type, const std::filesystem::path& folder) {
    static const std::vector<std::string> names{"finite", "bounded", "monotone", "equals", "twin"};
    Expectation result;
    result.place = reader.place();
    result.text = DirectiveReader(reader).rest();
    const std::string name = reader.word("an expectation");
    if (name == "finite") {
        if (!type.isReal()) reader.fail("a " + type.name() + " is always finite");
    } else if (name == "bounded") {
        result.kind = Kind::bounded;
        reader.expect('(');
        result.low = reader.number();
        reader.expect(',');
        result.high = reader.number();
        reader.expect(')');
        if (!(result.low <= result.high)) reader.fail("expected the smaller bound first");
    } else if (name == "monotone") {
        result.kind = Kind::monotone;
        parseMonotone(reader, result);
        result.allowance = Allowance::parse(reader);
    } else if (name == "equals") {
        parseEquals(reader, type, folder, result);
        result.allowance = Allowance::parse(reader);
    } else if (name == "twin") {
        result.kind = Kind::twin;
        if (!reader.atEnd()) result.model = reader.word("the name of a model");
    } else {
        reader.fail("unknown expectation '" + name + "'" + didYouMean(name, names));
    }
    reader.expectEnd();
    return result;
}

std::optional<int> Expectation::firstFault(GlslType type, std::span<const uint32_t> got,
                                           std::span<const uint32_t> against) const {
    const bool isReal = type.isReal();
    for (int c = 0; c < type.components; ++c) {
        const auto at = static_cast<size_t>(c);
        bool fine = true;
        switch (kind) {
            case Kind::finite:
                fine = isFiniteWord(got[at]);
                break;
            case Kind::bounded: {
                const double number = numberOf(type.base, got[at]);
                fine = !(isReal && isNanWord(got[at])) && number >= low && number <= high;
                break;
            }
            case Kind::monotone: {
                if (isReal && (isNanWord(got[at]) || isNanWord(against[at]))) return c;
                const double step = (increasing ? 1.0 : -1.0) *
                                    (numberOf(type.base, against[at]) - numberOf(type.base, got[at]));
                const bool equal = got[at] == against[at];  // infinities too
                fine = strict ? step > 0.0
                              : equal || step >= 0.0 || allowance.covers(type.base, against[at], got[at]);
                break;
            }
            default:
                fine = allowance.covers(type.base, got[at], against[at]);
        }
        if (!fine) return c;
    }
    return std::nullopt;
}

}  // namespace lobe::harness
