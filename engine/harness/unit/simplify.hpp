/// Simpler values near a given one, for shrinking failing inputs.
#pragma once

#include <vector>

#include "harness/unit/test_file.hpp"

namespace lobe::harness {

/// How hard a value is to read: fewer digits, smaller exponents, 0 and 1 come first.
double complexity(GlslType type, std::span<const uint32_t> words);

/// Values of single numbers that are simpler: 0, 1, rounded to fewer digits, to fewer bits, halves.
std::vector<uint32_t> simplerNumbers(GlslType::Base base, uint32_t word);

/// Values of an input that are simpler and that it allows.
std::vector<Words> simplerValues(const TestCase& test, const TestInput& input, const Words& value);

}  // namespace lobe::harness
