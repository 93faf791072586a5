/// The inputs of a test, row by row: lists in all combinations, random values anew for each row.
#pragma once

#include <optional>
#include <vector>

#include "harness/brdf_table.hpp"
#include "harness/unit/test_file.hpp"

namespace lobe::harness {

/// One row, with what expectations need beside it.
struct UnitRow {
    Words words;
    uint32_t partner = 0;  ///< of the input of a monotone expectation: the larger value
    size_t csvRow = 0;     ///< of the test's CSV file
};

/// Many, the words one after the other.
struct UnitRows {
    size_t width = 0;
    size_t count = 0;
    std::vector<uint32_t> words;
    std::vector<uint32_t> partners;  ///< empty without a monotone expectation
    std::vector<size_t> csvRows;     ///< empty without a CSV file

    UnitRow row(size_t i) const;
    void append(const UnitRow& row);
    /// The words with the partners in their places.
    std::vector<uint32_t> partnerWords(const TestCase& test) const;
};

inline constexpr int64_t kDefaultRows = 1 << 16;
inline constexpr uint64_t kDefaultSeed = 1;

/// Rows in an order that depends on the seed and the test's name only.
class RowSource {
public:
    /// `rows`: of tests with random inputs. Throws InputError when there are too many combinations.
    RowSource(const TestCase& test, int64_t rows, uint64_t seed);
    uint64_t count() const { return count_; }
    /// `first` must be a multiple of what was asked for before.
    UnitRows rows(uint64_t first, size_t n) const;

private:
    const TestCase& test_;
    uint64_t seed_;
    uint64_t count_ = 1;
};

/// A row of a model's inputs as the registry takes it.
BrdfRow brdfRowOf(const TestCase& test, std::span<const uint32_t> words);

/// Whether an input's value could have come from its generator, or is in range for the model's parameter.
bool inputAllows(const TestCase& test, const TestInput& input, std::span<const uint32_t> words);

}  // namespace lobe::harness
