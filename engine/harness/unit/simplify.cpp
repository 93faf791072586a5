#include "harness/unit/simplify.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/glm.hpp>

#include "harness/unit/unit_rows.hpp"

namespace lobe::harness {
namespace {

using Base = GlslType::Base;

constexpr size_t kMostListItems = 256;

/// Digits and exponent of the shortest decimal form: "-1.25e+07" has three and seven.
std::pair<int, int> digitsAndExponent(float value) {
    std::array<char, 64> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr;
    const std::string all(text.data(), end);
    const size_t e = all.find('e');
    const auto digits = std::count_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(e),
                                      [](char c) { return c >= '0' && c <= '9'; });
    return {static_cast<int>(digits), std::stoi(all.substr(e + 1))};
}

double complexityOf(Base base, uint32_t word) {
    if (base != Base::real) {
        const double value = numberOf(base, word);
        return value == 0.0 ? 0.0 : std::log2(std::abs(value)) + (value < 0.0 ? 2.0 : 1.0);
    }
    const float value = realOf(word);
    if (word == 0) return 0.0;
    if (!isFiniteWord(word)) return 3.0;
    if (value == 0.0f) return 1.5;  // -0
    if (value == 1.0f) return 1.0;
    const auto [digits, exponent] = digitsAndExponent(value);
    return 2.0 * digits + std::abs(exponent) + (value < 0.0f ? 1.0 : 0.0);
}

float roundedTo(float value, int digits) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::scientific, digits - 1)
                         .ptr;
    float result = value;
    std::from_chars(text.data(), end, result);
    return result;
}

Words directionWords(const glm::dvec3& w) {
    const glm::vec3 v(glm::normalize(w));
    return {wordOf(v.x), wordOf(v.y), wordOf(v.z)};
}

std::vector<Words> simplerDirections(const Words& value) {
    const glm::dvec3 w(double(realOf(value[0])), double(realOf(value[1])), double(realOf(value[2])));
    std::vector<Words> results;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 unit(0.0);
            unit[axis] = sign;
            results.push_back(directionWords(unit));
        }
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 flat = w;
        flat[c] = 0.0;
        if (glm::length(flat) > 0.0) results.push_back(directionWords(flat));
        glm::dvec3 turned = w;
        turned[c] = std::abs(w[c]);
        results.push_back(directionWords(turned));
    }
    for (const double scale : {1.0, 2.0, 5.0, 10.0, 100.0, 1000.0}) {
        const glm::dvec3 rounded = glm::round(w * scale);
        if (glm::length(rounded) > 0.0) results.push_back(directionWords(rounded));
    }
    // Grazing: the plane's part along an axis, the rest a power of ten.
    for (const double elevation : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7})
        for (const double sign : {1.0, -1.0}) {
            results.push_back(directionWords({sign, 0.0, elevation}));
            results.push_back(directionWords({0.0, sign, elevation}));
        }
    return results;
}

}  // namespace

double complexity(GlslType type, std::span<const uint32_t> words) {
    double sum = 0.0;
    for (const uint32_t word : words)
        sum += complexityOf(type.base, word);
    return sum;
}

std::vector<uint32_t> simplerNumbers(Base base, uint32_t word) {
    std::vector<uint32_t> results{0U};
    if (base == Base::boolean) return results;
    if (base != Base::real) {
        const auto value = static_cast<int64_t>(numberOf(base, word));
        for (const int64_t simpler :
             {int64_t{1}, int64_t{-1}, -value, value / 2, value / 10 * 10, value - 1, value + 1})
            if (simpler >= 0 || base == Base::integer) results.push_back(static_cast<uint32_t>(simpler));
        return results;
    }
    const float value = realOf(word);
    for (const float simpler : {1.0f, -1.0f, 0.5f, 2.0f, -0.0f, 10.0f, 100.0f, 1000.0f, 0.1f, 0.01f})
        results.push_back(wordOf(simpler));
    if (!isFiniteWord(word)) return results;
    for (const float simpler : {-value, value / 2.0f, value * 2.0f, value / 10.0f, value * 10.0f,
                                std::round(value), std::sqrt(std::abs(value))})
        results.push_back(wordOf(simpler));
    for (int digits = 1; digits <= 8; ++digits) {
        results.push_back(wordOf(roundedTo(value, digits)));
        // Away from zero, where rounding went towards it.
        const double step = std::pow(10.0, std::floor(std::log10(std::abs(double(value)))) - digits + 1);
        for (const double direction : {std::floor(double(value) / step), std::ceil(double(value) / step)})
            results.push_back(wordOf(roundedTo(static_cast<float>(direction * step), digits)));
    }
    for (int bits = 1; bits <= 22; ++bits)
        results.push_back(word & ~((1U << (23 - bits)) - 1U));
    return results;
}

std::vector<Words> simplerValues(const TestCase& test, const TestInput& input, const Words& value) {
    std::vector<Words> all;
    const auto index = static_cast<size_t>(&input - test.inputs.data());
    const bool isDirection = input.generator ? input.generator->isDirection() : index < 2;
    if (input.generator && input.generator->isList()) {
        const auto& list = input.generator->list();
        all.assign(list.begin(),
                   list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), kMostListItems)));
    } else if (isDirection) {
        all = simplerDirections(value);
    } else {
        for (size_t c = 0; c < value.size(); ++c)
            for (const uint32_t word : simplerNumbers(input.type.base, value[c])) {
                Words one = value;
                one[c] = word;
                all.push_back(std::move(one));
                if (value.size() > 1) all.emplace_back(value.size(), word);
            }
    }
    const double limit = complexity(input.type, value);
    std::vector<Words> simpler;
    for (Words& words : all)
        if (complexity(input.type, words) < limit && inputAllows(test, input, words))
            simpler.push_back(std::move(words));
    return simpler;
}

}  // namespace lobe::harness
