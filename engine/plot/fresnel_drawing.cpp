#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plot/drawing.hpp"
#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

std::string fourDecimals(double value) {
    return shortNumber(std::round(value * 1e4) / 1e4);
}

std::string namedOf(const FresnelCurve& curve) {
    return curve.interface.label.empty() ? "" : curve.interface.label + ": ";
}

Table tableOf(const FresnelCurves& curves) {
    Table table({"channel", "angle [deg]", "R exact [1]", "R_s [1]", "R_p [1]", "R Schlick [1]",
                 "Schlick - exact [1]"});
    for (const FresnelCurve& curve : curves.curves)
        for (const FresnelPoint& p : curve.points)
            table.add({curve.interface.label.empty() ? "all" : curve.interface.label, p.angle, p.exact, p.s,
                       p.p, p.schlick, p.schlick - p.exact});
    return table;
}

std::string captionOf(const FresnelCurve& curve) {
    return namedOf(curve) + "index " + shortNumber(curve.interface.eta) +
           (curve.interface.k == 0.0 ? "" : " + " + shortNumber(curve.interface.k) + " i") + ", F0 " +
           fourDecimals(curve.f0) + "; largest difference of Schlick's from the exact mean " +
           (curve.largestDifference > 0.0 ? "+" : "") + fourDecimals(curve.largestDifference) + " at " +
           shortNumber(curve.atAngle) + "°";
}

}  // namespace

Drawing draw(const FresnelCurves& curves) {
    const bool several = curves.curves.size() > 1;
    Drawing drawing{
        tableOf(curves),    "Fresnel reflectance of " + curves.request.name, {}, "", several ? 1200 : 860,
        several ? 520 : 600};
    for (const FresnelCurve& curve : curves.curves)
        drawing.caption.push_back(captionOf(curve));
    drawing.caption.emplace_back(
        "R_s perpendicular and R_p parallel to the plane of incidence; the exact reflectance of unpolarised "
        "light "
        "is their mean");
    std::string& text = drawing.commands;
    const double width = (several ? 0.935 : 0.89) / double(curves.curves.size());
    text +=
        "set xrange [0:90]\nset xtics 0,15,90\nset yrange [0:1]\nset ytics 0,0.2,1\nset grid linetype 1 "
        "linewidth 0.5 "
        "linecolor rgb \"#dddddd\"\nset xlabel \"angle of incidence [°]\"\n"
        "set bmargin at screen bottom + 64 * pixel\nset tmargin at screen top - " +
        std::to_string(several ? 52 : 34) +
        " * pixel\nset key at screen 0.5, top - 12 * pixel center center vertical maxrows 1 Left reverse "
        "samplen 3\nset multiplot\n";
    for (size_t i = 0; i < curves.curves.size(); ++i) {
        const FresnelCurve& curve = curves.curves[i];
        std::vector<std::string> lines;
        for (const FresnelPoint& p : curve.points)
            lines.push_back(numberText(p.angle) + " " + numberText(p.exact) + " " + numberText(p.s) + " " +
                            numberText(p.p) + " " + numberText(p.schlick));
        const std::string name = "curve" + std::to_string(i);
        const double left = (several ? 0.055 : 0.09) + double(i) * width;
        text += dataBlock(name, lines) + "set lmargin at screen " + numberText(left) +
                "\nset rmargin at screen " + numberText(left + width - 0.02) + "\n";
        if (!curve.interface.label.empty())
            text += "set title " + gnuplotText(curve.interface.label) + " noenhanced offset 0,-0.5\n";
        text += i == 0 ? "set ylabel \"reflectance\"\n" : "unset ylabel\nset ytics format \"\"\n";
        if (i > 0) text += "unset key\n";
        if (i > 0) text += "unset label\n";
        text += "plot $" + name + " using 1:3 with lines linewidth 2 dashtype (8,4) linecolor rgb \"" +
                seriesColor(2) + "\" title \"R_s\", $" + name +
                " using 1:4 with lines linewidth 2 dashtype (3,3) linecolor rgb \"" + seriesColor(3) +
                "\" title \"R_p\", $" + name + " using 1:2 with lines linewidth 2.5 linecolor rgb \"" +
                seriesColor(0) + "\" title \"exact mean\", $" + name +
                " using 1:5 with lines linewidth 2 dashtype (14,6) linecolor rgb \"" + seriesColor(1) +
                "\" title \"Schlick\"\n";
    }
    text += "unset multiplot\n";
    return drawing;
}

}  // namespace lobe::plot
