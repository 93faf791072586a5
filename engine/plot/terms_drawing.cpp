#include <algorithm>

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

}  // namespace

Drawing draw(const Terms& terms) {
    const TermsRequest& request = terms.request;
    Drawing drawing{tableOf(terms), request.model.brdf->title + ": terms by incidence", {}, "", 1100, 640};
    double highest = 0.0;
    for (const TermsRow& row : terms.rows)
        highest = std::max(highest, peakOf(row.cells[3]));
    const double radius = highest > 0.0 ? 1.08 * highest : 1.0;
    const double ring = highest > 0.0 ? roundSteps(highest, 2)[1] : 1.0;
    drawing.caption = {describe(request.model),
                       "Radius: radiance for light of irradiance 1 on a facing surface and surroundings of "
                       "radiance " +
                           shortNumber(request.ambientRadiance) + ", the same scale in all cells, ring at " +
                           shortNumber(ring) + " 1/sr; " + channelText(request.channel) +
                           "; the light comes from the left"};

    std::string& text = drawing.commands;
    const std::string columnWidth = "0.225", left = "0.09";
    const auto rows = std::to_string(terms.rows.size());
    text += "head = top - 28 * pixel\ncellheight = (head - bottom - 6 * pixel) / " + rows + "\n";
    for (size_t c = 0; c < kTermNames.size(); ++c)
        text += screenLabel(kTermNames[c], left + " + " + std::to_string(c) + ".5 * " + columnWidth,
                            "top - 14 * pixel", "center");
    for (size_t r = 0; r < terms.rows.size(); ++r)
        text += screenLabel(shortNumber(terms.rows[r].incidence) + "°", "0.06",
                            "head - " + std::to_string(r) + ".6 * cellheight", "center");
    text +=
        "set angles degrees\nunset border\nunset tics\nunset key\nset size ratio -1\n"
        "set xrange [" +
        numberText(-radius) + ":" + numberText(radius) + "]\nset yrange [" + numberText(-0.03 * radius) +
        ":" + numberText(radius) +
        "]\nset samples 181\nset parametric\nset trange [-90:90]\n"
        "set multiplot\n";
    for (size_t r = 0; r < terms.rows.size(); ++r)
        for (size_t c = 0; c < kTermNames.size(); ++c) {
            const TermsRow& row = terms.rows[r];
            std::vector<std::string> lines;
            for (const LobePoint& point : row.cells[c])
                lines.push_back(numberText(point.angle) + " " + numberText(point.value));
            const std::string name = "cell" + std::to_string(r) + "_" + std::to_string(c);
            const std::string x = left + " + " + std::to_string(c) + " * " + columnWidth;
            const std::string color = seriesColor(c == 3 ? 0 : c == 2 ? 1 : c == 1 ? 2 : 5);
            const double dx = std::sin(glm::radians(-row.incidence)),
                         dy = std::cos(glm::radians(row.incidence));
            text +=
                dataBlock(name, lines) + "set lmargin at screen " + x + " + 0.01\nset rmargin at screen " +
                x + " + " + columnWidth + " - 0.01\nset tmargin at screen head - " + std::to_string(r) +
                " * cellheight\nset bmargin at screen head - " + std::to_string(r + 1) +
                " * cellheight + 14 * pixel\nunset arrow\nset arrow from " + numberText(radius * dx) + "," +
                numberText(radius * dy) + " to " + numberText(0.8 * radius * dx) + "," +
                numberText(0.8 * radius * dy) + " head filled size " + numberText(0.07 * radius) +
                ",18 linewidth 1.5 linecolor rgb \"#777777\" front\n"
                "plot " +
                numberText(ring) + "*sin(t)," + numberText(ring) +
                "*cos(t) with lines linewidth 0.7 linecolor rgb \"#cccccc\", " + numberText(radius) +
                "*t/90,0 with lines linewidth 1 linecolor rgb \"#888888\", $" + name +
                " using ($2*sin($1)):($2*cos($1)) with filledcurves closed fillstyle transparent solid 0.25 "
                "noborder linecolor rgb \"" +
                color + "\", $" + name +
                " using ($2*sin($1)):($2*cos($1)) with lines linewidth 2 linecolor rgb \"" + color + "\"\n";
            if (r == 0 && c == 0) text += "unset label\n";
        }
    text += "unset multiplot\n";
    return drawing;
}

}  // namespace lobe::plot
