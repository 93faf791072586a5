#include <algorithm>

#include "plot/drawing.hpp"
#include "plot/geometry.hpp"
#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

Table tableOf(const Surface& surface) {
    Table table({"x [1]", "y [1]", "z [1]", quantityText(surface.request.quantity)});
    for (const auto& ring : surface.rings)
        for (const SurfacePoint& point : ring)
            table.add({point.direction.x, point.direction.y, point.direction.z, point.value});
    return table;
}

std::string pointText(const glm::dvec3& p) {
    return numberText(p.x) + "," + numberText(p.y) + "," + numberText(p.z);
}

}  // namespace

Drawing draw(const Surface& surface) {
    const SurfaceRequest& request = surface.request;
    Drawing drawing{tableOf(surface),
                    request.model.brdf->title + ": lobe at incidence " + shortNumber(request.incidence) + "°",
                    {},
                    "",
                    860,
                    620};
    double highest = 0.0;
    for (const auto& ring : surface.rings)
        for (const SurfacePoint& point : ring)
            highest = std::max(highest, point.value);
    drawing.caption = {describe(request.model),
                       "Distance from the origin and colour: " + quantityText(request.quantity) + ", " +
                           channelText(request.channel) + "; z: normal, x: tangent" +
                           (request.azimuth == 0.0 ? ""
                                                   : "; plane of incidence " + shortNumber(request.azimuth) +
                                                         "° from the tangent") +
                           "; grey arrow: incident light"};
    std::vector<std::string> lines;
    for (const auto& ring : surface.rings) {
        for (const SurfacePoint& point : ring) {
            const glm::dvec3 p = point.direction * point.value;
            lines.push_back(numberText(p.x) + " " + numberText(p.y) + " " + numberText(p.z) + " " +
                            numberText(point.value));
        }
        lines.emplace_back();
    }
    // The same half of a cube about every lobe, so that it always fits.
    const double reach = highest > 0.0 ? 1.02 * highest : 1.0;
    const glm::dvec3 light = toLight(request.incidence, request.azimuth);
    const double step = roundBelow(reach);
    std::string& text = drawing.commands;
    text = dataBlock("surface", lines) +
           "set lmargin at screen 0.05\nset rmargin at screen 0.84\n"
           "set bmargin at screen bottom + 44 * pixel\nset tmargin at screen top\n"
           "set view 62,35,1.02\nset view equal xyz\nset xyplane at 0\nunset key\nset border 31\n"
           "R = " +
           numberText(reach) + "\nset xrange [-R:R]\nset yrange [-R:R]\nset zrange [0:R]\nset tics " +
           numberText(step) +
           "\nset xtics offset 0,-0.5\nset ytics offset 0.8,-0.4\nset cbtics auto\nset xlabel \"x\"\nset "
           "ylabel \"y\"\nset zlabel \"z\" offset 3,0\nset cblabel " +
           gnuplotText(quantityText(request.quantity)) + " noenhanced\nset cbrange [0:" + numberText(reach) +
           "]\n"
           "set colorbox user origin screen 0.87, screen bottom + 90 * pixel size screen 0.025, screen 0.5\n"
           "set pm3d depthorder border linewidth 0.15 linecolor rgb \"#40404040\"\n"
           "set arrow from " +
           pointText(0.8 * reach * light) + " to " + pointText(0.03 * reach * light) +
           " head filled linewidth 2 linecolor rgb \"#777777\"\n"
           "splot $surface using 1:2:3:4 with pm3d\n";
    return drawing;
}

}  // namespace lobe::plot
