/// Drawing by gnuplot, a program of its own (Debian: gnuplot-nox) that is started when a picture is asked
/// for.
#pragma once

#include <string>
#include <string_view>

namespace lobe::plot {

/// A text as a gnuplot string that means that text and nothing else: all but letters and spaces are
/// octal escapes, so that no quote, backquote, @, newline or control character is left for gnuplot to see.
/// What is not UTF-8, control characters included, becomes a question mark. Where a text is drawn, follow it
/// by "noenhanced".
std::string gnuplotText(std::string_view text);

/// What gnuplot writes to standard output for these commands, run without configuration files in the C
/// locale. Throws InputError if the program is missing, and Error (checkFailed) with its first complaint if
/// it ends with an error, complains or writes nothing.
std::string runGnuplot(const std::string& commands);

}  // namespace lobe::plot
