#include "harness/unit/directive_reader.hpp"

#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>

#include "base/error.hpp"

namespace lobe::harness {
namespace {

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

const std::map<std::string, double>& namedNumbers() {
    static const std::map<std::string, double> names{{"inf", std::numeric_limits<double>::infinity()},
                                                     {"nan", std::numeric_limits<double>::quiet_NaN()},
                                                     {"pi", 3.14159265358979323846},
                                                     {"true", 1.0},
                                                     {"false", 0.0}};
    return names;
}

}  // namespace

void DirectiveReader::skipSpaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
        ++at_;
}

void DirectiveReader::fail(const std::string& problem) const {
    throw InputError(place_.text() + ": @" + directive_ + (text_.empty() ? "" : " " + text_) + ": " +
                     problem);
}

bool DirectiveReader::atEnd() {
    skipSpaces();
    return at_ == text_.size();
}

bool DirectiveReader::accept(char c) {
    skipSpaces();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
}

bool DirectiveReader::acceptWord(const std::string& word) {
    skipSpaces();
    const size_t end = at_ + word.size();
    if (text_.compare(at_, word.size(), word) != 0 || (end < text_.size() && isWordCharacter(text_[end])))
        return false;
    at_ = end;
    return true;
}

void DirectiveReader::expect(char c) {
    if (!accept(c))
        fail(std::string("expected '") + c + "' " +
             (atEnd() ? "at the end" : "before '" + text_.substr(at_) + "'"));
}

std::string DirectiveReader::word(const std::string& expectation) {
    skipSpaces();
    const size_t start = at_;
    while (at_ < text_.size() && isWordCharacter(text_[at_]))
        ++at_;
    if (at_ == start) fail("expected " + expectation);
    return text_.substr(start, at_ - start);
}

std::string DirectiveReader::untilSpace(const std::string& expectation) {
    skipSpaces();
    const size_t start = at_;
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
        ++at_;
    if (at_ == start) fail("expected " + expectation);
    return text_.substr(start, at_ - start);
}

std::string DirectiveReader::quoted(const std::string& expectation) {
    skipSpaces();
    const size_t close =
        at_ < text_.size() && text_[at_] == '"' ? text_.find('"', at_ + 1) : std::string::npos;
    if (close == std::string::npos) fail("expected " + expectation + " in double quotes");
    std::string result = text_.substr(at_ + 1, close - at_ - 1);
    at_ = close + 1;
    return result;
}

std::string DirectiveReader::rest() {
    skipSpaces();
    std::string result = text_.substr(at_);
    at_ = text_.size();
    while (!result.empty() && std::isspace(static_cast<unsigned char>(result.back())) != 0)
        result.pop_back();
    return result;
}

std::string DirectiveReader::numberText() {
    skipSpaces();
    const size_t start = at_;
    while (at_ < text_.size() &&
           (isWordCharacter(text_[at_]) ||
            ((text_[at_] == '-' || text_[at_] == '+') &&
             (at_ == start || std::string("eEpP").find(text_[at_ - 1]) != std::string::npos))))
        ++at_;
    std::string text = text_.substr(start, at_ - start);
    if (text.empty())
        fail("expected a number" + (at_ < text_.size() ? " before '" + text_.substr(at_) + "'" : ""));
    return text;
}

bool DirectiveReader::nextIsNumber() {
    skipSpaces();
    if (at_ == text_.size()) return false;
    const size_t digit = text_[at_] == '-' || text_[at_] == '+' ? at_ + 1 : at_;
    if (digit < text_.size() &&
        (std::isdigit(static_cast<unsigned char>(text_[digit])) != 0 || text_[digit] == '.'))
        return true;
    for (const auto& [name, value] : namedNumbers())
        if (text_.compare(digit, name.size(), name) == 0 &&
            (digit + name.size() == text_.size() || !isWordCharacter(text_[digit + name.size()])))
            return true;
    return text_.compare(at_, 5, "bits(") == 0;
}

double DirectiveReader::number() {
    const std::string text = numberText();
    const bool negative = text[0] == '-';
    const std::string bare = text.substr(negative || text[0] == '+' ? 1 : 0);
    if (const auto named = namedNumbers().find(bare); named != namedNumbers().end())
        return negative ? -named->second : named->second;
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() + text.size()) fail("'" + text + "' is not a number");
    if (!std::isfinite(value)) fail("'" + text + "' is beyond all numbers; infinity is written inf");
    return value;
}

float DirectiveReader::real() {
    if (acceptWord("bits")) {
        expect('(');
        const std::string text = numberText();
        char* end = nullptr;
        const unsigned long bits = std::strtoul(text.c_str(), &end, 16);
        if (end != text.c_str() + text.size() || bits > 0xffffffffUL)
            fail("'" + text + "' is not the bits of a float");
        expect(')');
        return std::bit_cast<float>(static_cast<uint32_t>(bits));
    }
    const size_t start = at_;
    const double value = number();
    if (!std::isfinite(value)) return static_cast<float>(value);
    size_t first = start;
    while (std::isspace(static_cast<unsigned char>(text_[first])) != 0)
        ++first;
    char* end = nullptr;
    const float direct = std::strtof(text_.c_str() + first, &end);  // rounded once
    return end == text_.c_str() + at_ ? direct : static_cast<float>(value);
}

int64_t DirectiveReader::whole(int64_t low, int64_t high) {
    const double value = number();
    if (!(value >= double(low) && value <= double(high)) || value != std::floor(value))
        fail("expected a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    return static_cast<int64_t>(value);
}

void DirectiveReader::expectEnd() {
    if (!atEnd()) fail("'" + text_.substr(at_) + "' was not expected");
}

}  // namespace lobe::harness
