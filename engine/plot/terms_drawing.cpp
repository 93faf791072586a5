#include <algorithm>
#include <array>
#include <cmath>

#include "plot/drawing.hpp"
#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

std::string screenLabel(const std::string& text, const std::string& x, const std::string& y,
                        const char* options) {
    return "set label " + gnuplotText(text) + " at screen " + x + "," + y + " " + options + " noenhanced\n";
}

Table tableOf(const Terms& terms) {
    Table table({"incidence [deg]", "angle [deg]", "ambient [1/sr]", "diffuse [1/sr]", "specular [1/sr]",
                 "total [1/sr]"});
    for (const TermsRow& row : terms.rows)
        for (size_t i = 0; i < row.cells[0].size(); ++i)
            table.add({row.incidence, row.cells[0][i].angle, row.cells[0][i].value, row.cells[1][i].value,
                       row.cells[2][i].value, row.cells[3][i].value});
    return table;
}

/// Screen position of a column's left edge.
std::string columnAt(size_t column) {
    return "0.09 + " + std::to_string(column) + " * columnwidth";
}

/// Headings, and what all cells share; R is the radius that they show, `ring` where they have a ring.
std::string frameCommands(const Terms& terms, double radius, double ring) {
    std::string text = "R = " + numberText(radius) + "\nring = " + numberText(ring) +
                       "\ncolumnwidth = 0.225\nhead = top - 24 * pixel\ncellheight = (head - bottom) / " +
                       std::to_string(terms.rows.size()) + "\n";
    for (size_t c = 0; c < kTermNames.size(); ++c)
        text +=
            screenLabel(kTermNames[c], columnAt(c) + " + 0.5 * columnwidth", "top - 12 * pixel", "center");
    for (size_t r = 0; r < terms.rows.size(); ++r)
        text += screenLabel(shortNumber(terms.rows[r].incidence) + "°", "0.06",
                            "head - " + std::to_string(r) + ".6 * cellheight", "center");
    return text +
           "set angles degrees\nunset border\nunset tics\nunset key\nset size ratio -1\n"
           "set xrange [-1.12*R:1.12*R]\nset yrange [-0.03*R:1.2*R]\n"
           "set samples 181\nset parametric\nset trange [-90:90]\nset multiplot\n";
}

std::string cellCommands(const TermsRow& row, size_t r, size_t c) {
    constexpr std::array<size_t, 4> kColors{5, 2, 1, 0};  // of seriesColor()
    std::vector<std::string> lines;
    for (const LobePoint& point : row.cells[c])
        lines.push_back(numberText(point.angle) + " " + numberText(point.value));
    const std::string name = "cell" + std::to_string(r) + "_" + std::to_string(c);
    const std::string lobe = "$" + name + " using ($2*sin($1)):($2*cos($1)) with ";
    const std::string color = " linecolor rgb \"" + seriesColor(kColors[c]) + "\"";
    const std::string x = numberText(-std::sin(glm::radians(row.incidence)));
    const std::string y = numberText(std::cos(glm::radians(row.incidence)));
    return dataBlock(name, lines) + "set lmargin at screen " + columnAt(c) +
           " + 0.01\nset rmargin at screen " + columnAt(c + 1) + " - 0.01\nset tmargin at screen head - " +
           std::to_string(r) + " * cellheight\nset bmargin at screen head - " + std::to_string(r + 1) +
           " * cellheight + 6 * pixel\n"
           "unset arrow\nset arrow from 1.2*R*" +
           x + ",1.2*R*" + y + " to 1.02*R*" + x + ",1.02*R*" + y +
           " head filled size 0.07*R,18 linewidth 1.5 linecolor rgb \"#777777\" front\n"
           "plot ring*sin(t),ring*cos(t) with lines linewidth 0.7 linecolor rgb \"#bbbbbb\", "
           "1.12*R*t/90,0 with lines linewidth 1 linecolor rgb \"#888888\", " +
           lobe + "filledcurves closed fillstyle transparent solid 0.25 noborder" + color + ", " + lobe +
           "lines linewidth 2" + color + "\n" +
           // The headings are drawn with the first cell.
           (r == 0 && c == 0 ? "unset label\n" : "");
}

}  // namespace

Drawing draw(const Terms& terms) {
    const TermsRequest& request = terms.request;
    Drawing drawing{tableOf(terms), request.model.brdf->title + ": terms by incidence", {}, "", 1100, 600};
    double highest = 0.0;
    for (const TermsRow& row : terms.rows)
        highest = std::max(highest, peakOf(row.cells[3]));
    const double radius = highest > 0.0 ? 1.08 * highest : 1.0;
    const double ring = highest > 0.0 ? roundBelow(highest) : 1.0;
    drawing.caption = {describe(request.model),
                       "Radius: radiance for light of irradiance 1 on a facing surface and surroundings of "
                       "radiance " +
                           shortNumber(request.ambientRadiance) +
                           ", the same scale in all cells, grey ring at " + shortNumber(ring) + " per sr; " +
                           channelText(request.channel) + "; the light comes from the left"};

    drawing.commands = frameCommands(terms, radius, ring);
    for (size_t r = 0; r < terms.rows.size(); ++r)
        for (size_t c = 0; c < kTermNames.size(); ++c)
            drawing.commands += cellCommands(terms.rows[r], r, c);
    drawing.commands += "unset multiplot\n";
    return drawing;
}

}  // namespace lobe::plot
