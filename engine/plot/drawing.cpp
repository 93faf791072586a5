#include "plot/drawing.hpp"

#include <algorithm>
#include <sstream>

#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

constexpr double kTextSize = 14.0;  // pixels on a canvas of the drawing's own size
constexpr double kTitleSize = 18.0;
constexpr double kCaptionSize = 12.0;
constexpr double kLineSpacing = 1.4;
constexpr double kMeanLetterWidth = 0.52;  // of the size, for sans-serif

/// Cairo's sizes are in points of 1/72 inch, at 96 pixels an inch.
constexpr double kPngTextScale = 0.75;

size_t letterCount(const std::string& utf8) {
    return static_cast<size_t>(
        std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// At spaces; a word that is longer than a line has one to itself.
std::vector<std::string> wrapped(const std::string& text, size_t letters) {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!lines.empty() && letterCount(lines.back()) + 1 + letterCount(word) <= letters)
            lines.back() += " " + word;
        else
            lines.push_back(word);
    }
    return lines;
}

std::string labelAt(double x, double y, const std::string& text, const char* place, double size,
                    const char* color) {
    return "set label " + gnuplotText(text) + " at screen " + numberText(x) + "," + numberText(y) + " " +
           place + " font \"," + numberText(size) + "\" textcolor rgb \"" + color + "\" noenhanced front\n";
}

std::string terminal(Format format, int width, int height, double scale) {
    const std::string size = std::to_string(width) + "," + std::to_string(height);
    const bool png = format == Format::png;
    return std::string("set terminal ") + (png ? "pngcairo" : "svg") + " size " + size +
           " enhanced font \"sans-serif," + numberText(kTextSize) + "\" fontscale " +
           numberText(scale * (png ? kPngTextScale : 1.0)) + " linewidth " + numberText(scale) +
           " butt background \"#ffffff\"\n";
}

}  // namespace

std::string render(const Drawing& drawing, Format format, int width, int height) {
    if (format == Format::csv) return drawing.table.csv();
    const double scale = std::min(double(width) / drawing.width, double(height) / drawing.height);
    const double unitHeight = height / scale;  // canvas height in pixels of the drawing's own
    const auto lettersOf = [&](double size) {
        return static_cast<size_t>(0.96 * width / scale / (kMeanLetterWidth * size));
    };

    std::string text = terminal(format, width, height, scale) + kStyleCommands;
    std::vector<std::string> caption;
    for (const std::string& paragraph : drawing.caption)
        for (std::string& line : wrapped(paragraph, lettersOf(kCaptionSize)))
            caption.push_back(std::move(line));
    const double lineHeight = kCaptionSize * kLineSpacing / unitHeight;
    for (size_t i = 0; i < caption.size(); ++i)
        text += labelAt(0.02, lineHeight * (double(caption.size() - i) - 0.3), caption[i], "left",
                        kCaptionSize, "#555555");
    const double titleHeight = kTitleSize * kLineSpacing / unitHeight;
    const std::vector<std::string> title = wrapped(drawing.title, lettersOf(kTitleSize));
    for (size_t i = 0; i < title.size(); ++i)
        text +=
            labelAt(0.5, 1.0 - titleHeight * (double(i) + 0.8), title[i], "center", kTitleSize, "#000000");
    text += "bottom = " + numberText(lineHeight * (double(caption.size()) + 0.5)) + "\n";
    text += "top = " + numberText(1.0 - titleHeight * (double(title.size()) + 0.3)) + "\n";
    text += "pixel = " + numberText(1.0 / unitHeight) + "\n";
    return runGnuplot(text + drawing.commands);
}

}  // namespace lobe::plot
