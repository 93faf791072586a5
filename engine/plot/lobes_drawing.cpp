#include <algorithm>
#include <cmath>
#include <set>

#include "plot/drawing.hpp"
#include "plot/geometry.hpp"
#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

constexpr double kDecades = 5.0;       ///< that a logarithmic radius shows
constexpr double kLeastMirror = 1e-4;  ///< reflectance of a mirrored part that is shown

/// From a value to a radius of 0..1.
struct Radius {
    RadiusScale scale;
    double maximum;

    double minimum() const { return maximum * std::pow(10.0, -kDecades); }
    double of(double value) const {
        if (scale == RadiusScale::sqrt) return std::sqrt(std::max(value, 0.0) / maximum);
        if (scale == RadiusScale::log)
            return value <= minimum() ? 0.0 : 1.0 + std::log10(value / maximum) / kDecades;
        return value / maximum;
    }
    /// The outermost is the maximum.
    Ticks ticks() const {
        constexpr double kApart = 0.12;
        std::vector<double> values = roundSteps(maximum, 5);
        if (scale == RadiusScale::log) values = roundPowers(1.01 * minimum(), maximum);
        if (scale == RadiusScale::sqrt) values = roundPowers(1e-2 * maximum, maximum);
        Ticks ticks{{0.0, scale == RadiusScale::log ? shortNumber(minimum()) : "0"}};
        for (double value : values)
            if (of(value) - ticks.back().first > kApart && of(value) < 1.0 - kApart)
                ticks.emplace_back(of(value), shortNumber(value));
        ticks.emplace_back(1.0, shortNumber(maximum));
        return ticks;
    }
    std::string text() const {
        return scale == RadiusScale::sqrt  ? ", square-root radius"
               : scale == RadiusScale::log ? ", logarithmic radius of " + shortNumber(kDecades) + " decades"
                                           : "";
    }
};

/// The next number with at most two digits, the second of them even or 5.
double roundAbove(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (double digits : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0})
        if (digits * power >= value) return digits * power;
    return 10.0 * power;
}

Radius radiusFor(const Lobes& lobes, RadiusScale asked) {
    double highest = 0.0, lowest = 0.0;
    for (const Lobe& lobe : lobes.lobes) {
        const double peak = peakOf(lobe.points);
        highest = std::max(highest, peak);
        if (peak > 0.0) lowest = lowest == 0.0 ? peak : std::min(lowest, peak);
    }
    const double ratio = lowest > 0.0 ? highest / lowest : 1.0;
    const RadiusScale scale = asked != RadiusScale::automatic ? asked
                              : ratio > 200.0                 ? RadiusScale::log
                              : ratio > 8.0                   ? RadiusScale::sqrt
                                                              : RadiusScale::linear;
    return {scale, highest > 0.0 ? roundAbove(1.02 * highest) : 1.0};
}

bool isZero(const Lobes& lobes) {
    return std::all_of(lobes.lobes.begin(), lobes.lobes.end(),
                       [](const Lobe& lobe) { return peakOf(lobe.points) == 0.0; });
}

bool hasMirror(const Lobes& lobes) {
    return std::any_of(lobes.lobes.begin(), lobes.lobes.end(),
                       [](const Lobe& lobe) { return lobe.mirror > 0.0; });
}

/// Colours tell models apart, dashes incidences; for a single model colours tell incidences apart.
struct Look {
    size_t color, dash;
};

Look lookOf(const Lobes& lobes, const Lobe& lobe) {
    const auto& incidences = lobes.request.incidences;
    const auto incidence = static_cast<size_t>(
        std::find(incidences.begin(), incidences.end(), lobe.incidence) - incidences.begin());
    return lobes.request.models.size() == 1 ? Look{incidence, 0} : Look{lobe.model, incidence};
}

/// Solid, dashed, dotted, dash-dotted, ...
std::string dashText(size_t dash) {
    constexpr std::array<const char*, 5> kDashes{"solid", "(12,5)", "(3,3)", "(12,4,3,4)", "(12,4,3,4,3,4)"};
    return std::string(" dashtype ") + kDashes[dash % kDashes.size()];
}

std::string lineText(const Look& look) {
    return "linewidth 2 linecolor rgb \"" + seriesColor(look.color) + "\"" + dashText(look.dash);
}

std::string incidenceText(double incidence) {
    return "incidence " + shortNumber(incidence) + "°";
}

/// Rows of the legend that the corner beside the arc has no room for.
int excessEntries(const Lobes& lobes) {
    constexpr size_t kRoom = 2;
    const size_t models = lobes.request.models.size(), incidences = lobes.request.incidences.size();
    const size_t entries = models == 1 ? incidences : models + (incidences > 1 ? incidences : 0);
    return entries > kRoom ? static_cast<int>(entries - kRoom) : 0;
}

/// Entries that have no line of their own in the plot.
std::string keyEntries(const Lobes& lobes) {
    const bool one = lobes.request.models.size() == 1;
    std::string text;
    const auto entry = [&](const std::string& title, const std::string& line) {
        text += (text.empty() ? "" : ", ") + std::string("keyentry with lines ") + line + " title " +
                gnuplotText(title);
    };
    if (!one)
        for (size_t m = 0; m < lobes.request.models.size(); ++m)
            entry(lobes.request.models[m].brdf->title, lineText({m, 0}));
    const auto& incidences = lobes.request.incidences;
    for (size_t i = 0; i < incidences.size(); ++i)
        if (one)
            entry(incidenceText(incidences[i]), lineText({i, 0}));
        else if (incidences.size() > 1)
            entry(incidenceText(incidences[i]), "linewidth 2 linecolor rgb \"#444444\"" + dashText(i));
    return text;
}

std::string arrow(double fromRadius, double toRadius, double angle, const std::string& look) {
    const double x = std::sin(glm::radians(angle)), y = std::cos(glm::radians(angle));
    return "set arrow from " + numberText(fromRadius * x) + "," + numberText(fromRadius * y) + " to " +
           numberText(toRadius * x) + "," + numberText(toRadius * y) + " " + look + "\n";
}

/// Light that comes in from the left, and what leaves in the mirrored direction alone.
std::string arrows(const Lobes& lobes) {
    std::string text;
    for (double incidence :
         std::set<double>(lobes.request.incidences.begin(), lobes.request.incidences.end()))
        text += arrow(1.0, 0.86, -incidence,
                      "head filled size 0.035,18 linewidth 1.5 linecolor rgb \"#777777\" front");
    for (const Lobe& lobe : lobes.lobes) {
        if (lobe.mirror < kLeastMirror) continue;
        text +=
            arrow(0.0, 0.97, lobe.incidence, "head filled size 0.035,18 " + lineText(lookOf(lobes, lobe)));
        const double at = glm::radians(lobe.incidence + 2.5);
        const double radius = 0.72 - 0.1 * double(lobe.model);
        text += "set label " + gnuplotText("mirrored: " + shortNumber(rounded(lobe.mirror, 2))) + " at " +
                numberText(radius * std::sin(at)) + "," + numberText(radius * std::cos(at)) +
                " left textcolor rgb \"" + seriesColor(lookOf(lobes, lobe).color) + "\" noenhanced front\n";
    }
    return text;
}

Table tableOf(const Lobes& lobes) {
    Table table({"model", "incidence [deg]", "angle [deg]", quantityText(lobes.request.quantity)});
    for (const Lobe& lobe : lobes.lobes)
        for (const LobePoint& point : lobe.points)
            table.add(
                {lobes.request.models[lobe.model].brdf->name, lobe.incidence, point.angle, point.value});
    return table;
}

}  // namespace

Drawing draw(const Lobes& lobes, RadiusScale asked) {
    const Radius radius = radiusFor(lobes, asked);
    const bool zero = isZero(lobes);
    const int headroom = 18 * excessEntries(lobes);
    Drawing drawing{tableOf(lobes), "Reflection in the plane of incidence", {}, "", 960, 600 + headroom};
    if (lobes.request.models.size() == 1)
        drawing.title = lobes.request.models[0].brdf->title + ": reflection in the plane of incidence";
    for (const Model& model : lobes.request.models)
        drawing.caption.push_back(describe(model));
    std::string& text = drawing.commands;
    std::string plots = keyEntries(lobes);
    for (size_t i = 0; i < lobes.lobes.size(); ++i) {
        std::vector<std::string> lines;
        for (const LobePoint& point : lobes.lobes[i].points)
            lines.push_back(numberText(point.angle) + " " + numberText(radius.of(point.value)));
        const std::string name = "lobe" + std::to_string(i);
        text += dataBlock(name, lines);
        if (peakOf(lobes.lobes[i].points) > 0.0)
            plots += ", $" + name + " using 1:2 with lines " + lineText(lookOf(lobes, lobes.lobes[i])) +
                     " notitle";
    }
    const std::string what = quantityText(lobes.request.quantity);
    drawing.caption.push_back(
        (zero ? "No light leaves in other directions; arrows: "
              : "Radius: " + what + radius.text() + ", " + channelText(lobes.request.channel) +
                    "; angle: of the eye against the normal; grey arrows: ") +
        std::string("incident light") +
        (hasMirror(lobes) ? ", and what is mirrored, by its reflectance" : "") +
        (lobes.request.azimuth != 0.0
             ? "; plane of incidence " + shortNumber(lobes.request.azimuth) + "° from the tangent"
             : ""));
    text +=
        "set polar\nset angles degrees\nset theta top clockwise\nset trange [-90:90]\nset rrange [0:1]\n"
        "set xrange [-1.2:1.2]\nset yrange [0:1.12]\nset size ratio -1\n"
        "set lmargin at screen 0.02\nset rmargin at screen 0.98\n"
        "set bmargin at screen bottom + 50 * pixel\nset tmargin at screen top - " +
        std::to_string(headroom) +
        " * pixel\n"
        "unset border\nunset xtics\nunset ytics\nunset raxis\n"
        "set grid polar 30 linetype 1 linewidth 0.7 linecolor rgb \"#cccccc\"\n"
        "set ttics -90,30,90 scale 0 format \"%.0f°\"\n"
        "set key at screen 0.985, top right Left reverse\n";
    text += zero ? "unset rtics\n" : "set rtics scale 0 " + ticksText(radius.ticks()) + "\n";
    if (!zero)
        text += "set label " + gnuplotText(what) + " at 0,0 center offset character 0,-2.2 noenhanced\n";
    text += arrows(lobes) + "plot " + plots + ", NaN notitle\n";
    return drawing;
}

}  // namespace lobe::plot
