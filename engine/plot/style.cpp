#include "plot/style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "plot/geometry.hpp"
#include "plot/gnuplot.hpp"
#include "plot/table.hpp"

namespace lobe::plot {
namespace {

using Rgb = std::array<int, 3>;

constexpr std::array<Rgb, 9> kViridis{{{68, 1, 84},
                                       {71, 44, 122},
                                       {59, 81, 139},
                                       {44, 113, 142},
                                       {33, 144, 141},
                                       {39, 173, 129},
                                       {92, 200, 99},
                                       {170, 220, 50},
                                       {253, 231, 37}}};

std::string hex(const Rgb& rgb) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(rgb[0]),
                  static_cast<unsigned>(rgb[1]), static_cast<unsigned>(rgb[2]));
    return text.data();
}

/// Cells are repeated so that viewers that smooth images leave edges where they are.
constexpr int kRepeat = 6;

/// Places on an axis that counts cells; values are in equal steps, or in equal ratios if `wide`.
std::string ticksOf(const std::vector<double>& values, const std::vector<double>& shown, bool wide) {
    const auto scaled = [&](double value) { return wide ? std::log10(value) : value; };
    const double low = scaled(values.front()), high = scaled(values.back());
    Ticks ticks;
    for (double value : shown) {
        const double at = values.size() == 1 ? 0.0 : (scaled(value) - low) / (high - low);
        if (at >= -1e-9 && at <= 1.0 + 1e-9)
            ticks.emplace_back(at * (double(values.size()) - 1.0), shortNumber(value));
    }
    return ticksText(ticks);
}

}  // namespace

const char* const kStyleCommands =
    "set encoding utf8\n"
    "set key noenhanced\n"
    "set palette defined (0 \"#440154\", 1 \"#472c7a\", 2 \"#3b518b\", 3 \"#2c718e\", 4 \"#21908d\", "
    "5 \"#27ad81\", 6 \"#5cc863\", 7 \"#aadc32\", 8 \"#fde725\")\n"
    "set border linewidth 1 linecolor rgb \"#444444\"\n"
    "set tics nomirror\n"
    "set bmargin at screen 0\nset tmargin at screen 1\n";

std::string seriesColor(size_t index) {
    constexpr std::array<const char*, 7> kOkabeIto{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000"};
    return kOkabeIto[index % kOkabeIto.size()];
}

std::string sequentialColor(double share) {
    const double at = std::clamp(share, 0.0, 1.0) * double(kViridis.size() - 1);
    const auto lower = std::min(static_cast<size_t>(at), kViridis.size() - 2);
    Rgb rgb{};
    for (size_t c = 0; c < 3; ++c)
        rgb[c] = static_cast<int>(std::lround(
            kViridis[lower][c] + (at - double(lower)) * (kViridis[lower + 1][c] - kViridis[lower][c])));
    return hex(rgb);
}

std::string dataBlock(const std::string& name, const std::vector<std::string>& lines) {
    std::string text = "$" + name + " << EOD\n";
    for (const std::string& line : lines)
        text += line + "\n";
    return text + "EOD\n";
}

std::string quantityText(Quantity quantity) {
    switch (quantity) {
        case Quantity::f:
            return "f_r [1/sr]";
        case Quantity::fCosOut:
            return "f_r cos θ_o [1/sr]";
        case Quantity::fCos:
            break;
    }
    return "f_r cos θ_i [1/sr]";
}

std::string channelText(Channel channel) {
    switch (channel) {
        case Channel::red:
            return "red channel";
        case Channel::green:
            return "green channel";
        case Channel::blue:
            return "blue channel";
        case Channel::luminance:
            break;
    }
    return "luminance of the three channels";
}

std::string ticksText(const Ticks& ticks) {
    std::string text = "(";
    for (const auto& [place, label] : ticks)
        text += (text.size() > 1 ? ", " : "") + gnuplotText(label) + " " + numberText(place);
    return text + ")";
}

double roundBelow(double maximum) {
    const double power = std::pow(10.0, std::floor(std::log10(maximum)));
    for (double factor : {5.0, 2.0})
        if (factor * power <= maximum) return factor * power;
    return power;
}

std::vector<double> roundSteps(double maximum, int count) {
    if (!(maximum > 0.0)) return {0.0};
    const double rough = maximum / count;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (double factor : {1.0, 2.0, 5.0})
        if (factor * power >= rough * 0.999) {
            step = factor * power;
            break;
        }
    std::vector<double> steps;
    for (int i = 0; i * step <= maximum * 1.0001; ++i)
        steps.push_back(i * step);
    return steps;
}

std::vector<double> roundPowers(double minimum, double maximum) {
    std::vector<double> steps;
    const bool many = maximum / minimum > 300.0;
    const int last = static_cast<int>(std::ceil(std::log10(maximum)));
    for (int power = static_cast<int>(std::floor(std::log10(minimum))); power <= last; ++power)
        for (double factor : many ? std::vector<double>{1.0} : std::vector<double>{1.0, 2.0, 5.0}) {
            const double value = factor * std::pow(10.0, power);
            if (value >= minimum * 0.9999 && value <= maximum * 1.0001) steps.push_back(value);
        }
    return steps;
}

std::string axisName(const Model& model, const std::string& parameter) {
    if (parameter.empty()) return "";
    const std::string& unit = scalarParameterOf(*model.brdf, parameter).unit;
    return unit == "1" ? parameter : parameter + " [" + unit + "]";
}

std::string heatMapCommands(const HeatMap& map) {
    const auto last = [](const std::vector<double>& v) { return double(v.size()) - 0.5; };
    const bool wide = isWide(map.y.front(), map.y.back());
    // A single row has no value to name.
    const std::string yTicks = map.y.size() == 1
                                   ? "unset ytics"
                                   : "set ytics " + ticksOf(map.y,
                                                            wide ? roundPowers(map.y.front(), map.y.back())
                                                                 : roundSteps(map.y.back(), 6),
                                                            wide);
    std::vector<double> xTicks;
    for (double x = map.x.front(); x <= map.x.back(); x += map.xStep)
        xTicks.push_back(x);
    std::vector<std::string> lines;
    const double step = 1.0 / kRepeat;
    for (size_t y = 0; y < map.y.size() * kRepeat; ++y)
        for (size_t x = 0; x < map.x.size() * kRepeat; ++x) {
            const double z = map.z[x / kRepeat][y / kRepeat];
            lines.push_back(numberText((double(x) + 0.5) * step - 0.5) + " " +
                            numberText((double(y) + 0.5) * step - 0.5) + " " +
                            numberText(std::max(z, map.zMinimum)));
        }
    return dataBlock("map", lines) +
           "set lmargin at screen 0.11\nset rmargin at screen 0.86\n"
           "set bmargin at screen bottom + 70 * pixel\nset tmargin at screen top - 10 * pixel\n"
           "unset key\nset tics out\nset xrange [-0.5:" +
           numberText(last(map.x)) + "]\nset yrange [-0.5:" + numberText(last(map.y)) + "]\nset xtics " +
           ticksOf(map.x, xTicks, false) + "\n" + yTicks + "\nset xlabel " + gnuplotText(map.xName) +
           " noenhanced\nset ylabel " + gnuplotText(map.yName) + " noenhanced\nset cblabel " +
           gnuplotText(map.zName) + " noenhanced\nset cbrange [" + numberText(map.zMinimum) + ":" +
           numberText(map.zMaximum) + "]\n" + (map.zIsLog ? "set logscale cb\n" : "") +
           "plot $map using 1:2:3 with image\n";
}

}  // namespace lobe::plot
