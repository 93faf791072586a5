#include <algorithm>
#include <cmath>

#include "plot/drawing.hpp"
#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

/// Albedos above are cut off: some models' grow without bound towards grazing.
constexpr double kHighestShown = 2.0;

Table tableOf(const Albedo& albedo) {
    const AlbedoRequest& request = albedo.request;
    const std::string over = axisName(request.model, request.over);
    Table table({over.empty() ? "parameter" : over, "incidence [deg]", "albedo [1]"});
    for (size_t v = 0; v < request.values.size(); ++v)
        for (size_t a = 0; a < request.angles.size(); ++a)
            table.add({over.empty() ? Table::Cell("none") : Table::Cell(request.values[v]), request.angles[a],
                       albedo.albedo[v][a]});
    return table;
}

double highestOf(const Albedo& albedo) {
    double highest = 0.0;
    for (const auto& row : albedo.albedo)
        highest = std::max(highest, *std::max_element(row.begin(), row.end()));
    return highest;
}

std::string curveCommands(const Albedo& albedo, double top) {
    const AlbedoRequest& request = albedo.request;
    std::string text, plots;
    for (size_t v = 0; v < request.values.size(); ++v) {
        std::vector<std::string> lines;
        for (size_t a = 0; a < request.angles.size(); ++a)
            lines.push_back(numberText(request.angles[a]) + " " + numberText(albedo.albedo[v][a]));
        const std::string name = "curve" + std::to_string(v);
        text += dataBlock(name, lines);
        const double share =
            request.values.size() == 1 ? 0.3 : 0.92 * double(v) / double(request.values.size() - 1);
        plots += ", $" + name + " using 1:2 with lines linewidth 2.5 linecolor rgb \"" +
                 sequentialColor(share) + "\" " +
                 (request.over.empty()
                      ? "notitle"
                      : "title " + gnuplotText(request.over + " " + shortNumber(request.values[v])));
    }
    return text +
           "set lmargin at screen 0.085\nset rmargin at screen 0.8\n"
           "set bmargin at screen bottom + 64 * pixel\nset tmargin at screen top - 10 * pixel\n"
           "set key at screen 0.99, top top right Left reverse samplen 2\nset xrange [0:90]\nset xtics "
           "0,15,90\n"
           "set yrange [0:" +
           numberText(top) +
           "]\nset grid linetype 1 linewidth 0.5 linecolor rgb \"#dddddd\"\n"
           "set xlabel \"angle of incidence [°]\"\nset ylabel \"directional albedo\"\n"
           "plot 1 with lines linewidth 1 dashtype (6,4) linecolor rgb \"#777777\" title \"all light\"" +
           plots + "\n";
}

}  // namespace

Drawing draw(const Albedo& albedo, AlbedoStyle style) {
    const AlbedoRequest& request = albedo.request;
    Drawing drawing{tableOf(albedo), request.model.brdf->title + ": directional albedo", {}, "", 900, 600};
    const double highest = highestOf(albedo);
    drawing.caption = {
        describe(request.model) + (request.over.empty() ? "" : "; " + request.over + " as shown"),
        "Share of the light that is reflected into the hemisphere, " + channelText(request.channel) +
            (request.model.brdf->mirror ? ", with the mirrored part" : "") + "; largest " +
            shortNumber(std::round(highest * 1e4) / 1e4) +
            (highest > kHighestShown ? ", cut off at " + shortNumber(kHighestShown) : "")};
    if (style == AlbedoStyle::curves) {
        drawing.commands = curveCommands(albedo, std::clamp(1.05 * highest, 1.05, kHighestShown));
    } else {
        HeatMap map{"angle of incidence [°]", axisName(request.model, request.over),
                    "directional albedo",     request.angles,
                    request.values,           {}};
        map.zMaximum = std::clamp(highest, 1.0, kHighestShown);
        for (size_t a = 0; a < request.angles.size(); ++a) {
            map.z.emplace_back();
            for (const auto& row : albedo.albedo)
                map.z.back().push_back(row[a]);
        }
        drawing.commands = heatMapCommands(map);
    }
    return drawing;
}

}  // namespace lobe::plot
