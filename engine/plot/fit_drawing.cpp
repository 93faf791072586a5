#include <algorithm>
#include <cmath>

#include "plot/drawing.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

/// Ends of the bands of angles that are told apart, degrees.
constexpr std::array kBands{60.0, 75.0, 85.0, 90.0};

Table tableOf(const FitErrors& fits) {
    const std::string over = axisName(fits.request.model, fits.request.over);
    Table table({over.empty() ? "parameter" : over, "view [deg]", "mean error [1]", "worst error [1]"});
    for (size_t v = 0; v < fits.request.values.size(); ++v)
        for (size_t a = 0; a < fits.request.angles.size(); ++a)
            table.add({over.empty() ? Table::Cell("none") : Table::Cell(fits.request.values[v]),
                       fits.request.angles[a], fits.errors[v][a].mean, fits.errors[v][a].worst});
    return table;
}

std::string percent(double share) {
    return shortNumber(std::round(share * 1e4) / 1e2) + " %";
}

/// "to 60°: 1.1 %, 2.3 % at most; ..."
std::string bandText(const FitErrors& fits) {
    std::string text;
    double from = -1.0;
    for (double to : kBands) {
        double sum = 0.0, most = 0.0;
        int count = 0;
        for (const auto& row : fits.errors)
            for (size_t a = 0; a < row.size(); ++a) {
                if (!(fits.request.angles[a] > from && fits.request.angles[a] <= to)) continue;
                sum += row[a].mean;
                most = std::max(most, row[a].mean);
                ++count;
            }
        if (count > 0)
            text += (text.empty() ? "to " : "; to ") + shortNumber(to) + "°: " + percent(sum / count) +
                    ", at most " + percent(most);
        from = to;
    }
    return text;
}

}  // namespace

Drawing draw(const FitErrors& fits) {
    const FitErrorsRequest& request = fits.request;
    Drawing drawing{tableOf(fits),
                    request.model.brdf->title + ": error of the fits for lights with a body",
                    {},
                    "",
                    900,
                    640};
    drawing.caption = {
        describe(request.model) + (request.over.empty() ? "" : "; " + request.over + " as shown"),
        "150 discs of 5 to 40° in the sky, half of them within the lobe: mean of the errors over mean of the "
        "light",
        bandText(fits)};
    HeatMap map{"angle of view [°]", axisName(request.model, request.over),
                "mean error",        request.angles,
                request.values,      {}};
    double most = 0.01;
    for (size_t a = 0; a < request.angles.size(); ++a) {
        map.z.emplace_back();
        for (const auto& row : fits.errors) {
            map.z.back().push_back(row[a].mean);
            most = std::max(most, row[a].mean);
        }
    }
    constexpr double kHighestShown = 0.2;
    map.zMaximum = std::min(most, kHighestShown);
    drawing.commands = heatMapCommands(map);
    return drawing;
}

}  // namespace lobe::plot
