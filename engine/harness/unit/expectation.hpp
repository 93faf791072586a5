/// What a test expects of its function's value: "@expect equals reference within 4 ulp".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/unit/csv_columns.hpp"
#include "harness/unit/generator.hpp"

namespace lobe::harness {

/// How far two values may be apart; any one that is given is enough. None: they must be equal.
struct Allowance {
    std::optional<uint64_t> ulps;
    std::optional<double> relative;  ///< of the expected value
    std::optional<double> absolute;

    /// Reads "within 4 ulp or abs 1e-9", or nothing.
    static Allowance parse(DirectiveReader& reader);
    std::string text() const;  ///< "", " within 4 ulp or abs 1e-09"
    bool covers(GlslType::Base base, uint32_t got, uint32_t expected) const;
};

struct Expectation {
    enum class Kind : uint8_t { finite, bounded, monotone, equalsFunction, equalsValue, equalsCsv, twin };

    Kind kind = Kind::finite;
    SourcePlace place;
    std::string text;  ///< as it was written
    Allowance allowance;
    double low = 0.0, high = 0.0;            ///< bounded
    bool increasing = true, strict = false;  ///< monotone
    std::string input;                       ///< monotone: in which input, empty for the only one
    std::string function;                    ///< equalsFunction
    Words value;                             ///< equalsValue
    std::optional<CsvColumns> csv;           ///< equalsCsv
    std::vector<Words> csvRows;              ///< equalsCsv, rounded to the type of the result
    std::string model;                       ///< twin; may be empty

    /// `result`: what the function returns.
    static Expectation parse(DirectiveReader& reader, GlslType result, const std::filesystem::path& folder);

    /// The first component that is not as expected, or nothing. `against`: the value of the reference, or for
    /// monotone the value where the input is larger; unused otherwise. Not for twin.
    std::optional<int> firstFault(GlslType type, std::span<const uint32_t> got,
                                  std::span<const uint32_t> against) const;
};

}  // namespace lobe::harness
