/// The words and numbers of a directive, one after the other.
#pragma once

#include <cstdint>
#include <string>

namespace lobe::harness {

/// Where a directive stands, for messages: "numeric_test.glsl:12".
struct SourcePlace {
    std::string file;
    int line = 0;
    std::string text() const { return file + ":" + std::to_string(line); }
};

/// Every function skips spaces first, and throws InputError "FILE:LINE: @in x: ...; expected ..." when
/// something else stands there.
class DirectiveReader {
public:
    /// `text` is what follows the directive's name.
    DirectiveReader(std::string directive, std::string text, SourcePlace place)
        : directive_(std::move(directive)), text_(std::move(text)), place_(std::move(place)) {}

    bool atEnd();
    bool accept(char c);
    bool acceptWord(const std::string& word);
    void expect(char c);
    std::string word(const std::string& expectation);        ///< letters, digits, '_' and '.'
    std::string untilSpace(const std::string& expectation);  ///< anything but spaces
    std::string quoted(const std::string& expectation);
    std::string rest();
    bool nextIsNumber();
    /// Decimal, hexadecimal (0x1.8p+3), inf, nan, pi, true, false.
    double number();
    /// As number(), rounded once to float; also bits(0x7fc00000).
    float real();
    /// A whole number in range.
    int64_t whole(int64_t low, int64_t high);
    void expectEnd();

    const SourcePlace& place() const { return place_; }
    [[noreturn]] void fail(const std::string& problem) const;

private:
    void skipSpaces();
    std::string numberText();

    std::string directive_, text_;
    SourcePlace place_;
    size_t at_ = 0;
};

}  // namespace lobe::harness
