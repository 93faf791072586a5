#include <algorithm>
#include <cmath>

#include "plot/drawing.hpp"
#include "plot/geometry.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

Table tableOf(const ErrorMap& map) {
    const std::string over = axisName(map.request.model, map.request.over);
    Table table(
        {over.empty() ? "parameter" : over, "incidence [deg]", "error [ulp]", "error [of allowance]"});
    for (const ErrorCell& cell : map.cells)
        table.add(
            {over.empty() ? Table::Cell("none") : Table::Cell(cell.value), cell.angle, cell.ulp, cell.share});
    return table;
}

std::string placeOf(const ErrorMap& map, const ErrorCell& cell) {
    return " at " + shortNumber(cell.angle) + "°" +
           (map.request.over.empty() ? "" : " and " + map.request.over + " " + shortNumber(cell.value));
}

}  // namespace

Drawing draw(const ErrorMap& map, ErrorMeasure measure) {
    const ErrorRequest& request = map.request;
    const bool ulp = measure == ErrorMeasure::ulp;
    Drawing drawing{tableOf(map), request.model.brdf->title + ": error of the GLSL against the double twin",
                    {},           "",
                    900,          640};
    drawing.caption = {
        describe(request.model) + (request.over.empty() ? "" : "; " + request.over + " as shown"),
        "Worst of " + std::to_string(kErrorViews) + " views and three channels in each cell. Largest: " +
            shortNumber(rounded(map.worstUlp.ulp, 3)) + " ulp" + placeOf(map, map.worstUlp) +
            "; of what the rounding of inputs allows: " + shortNumber(rounded(map.worstShare.share, 3)) +
            placeOf(map, map.worstShare)};
    HeatMap heat{"angle of incidence [°]",
                 axisName(request.model, request.over),
                 ulp ? "error [ulp]" : "error [of what rounding of inputs allows]",
                 request.angles,
                 request.values,
                 {}};
    for (size_t a = 0; a < request.angles.size(); ++a) {
        heat.z.emplace_back();
        for (size_t v = 0; v < request.values.size(); ++v) {
            const ErrorCell& cell = map.cells[v * request.angles.size() + a];
            heat.z.back().push_back(ulp ? cell.ulp : cell.share);
        }
    }
    heat.zIsLog = ulp;
    heat.zMinimum = ulp ? 0.5 : 0.0;
    heat.zMaximum =
        ulp ? std::max(10.0, std::pow(10.0, std::ceil(std::log10(std::max(map.worstUlp.ulp, 1.0)))))
            : std::max(1.0, map.worstShare.share);
    drawing.commands = heatMapCommands(heat);
    return drawing;
}

}  // namespace lobe::plot
