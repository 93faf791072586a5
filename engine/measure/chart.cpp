#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "measure/report_files.hpp"
#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;

/// "relmse" is shown as its root, which is a share of a pixel's value.
double shownError(const json& error, const std::string& metric) {
    const json& value = error.contains(metric) ? error[metric] : json();
    const double number = value.is_number() ? value.get<double>() : 0.0;
    return metric.starts_with("relmse") ? std::sqrt(number) : number;
}

std::string axisOf(const std::string& metric) {
    return metric.starts_with("relmse") ? "error: root of " + metric : "error: " + metric;
}

std::string number(double value) {
    std::ostringstream text;
    text.precision(9);
    text << value;
    return text.str();
}

struct Dot {
    double low, time, high, error;
    bool front;
    std::string preset;
};

std::vector<Dot> dotsOf(const json& scene, const std::string& metric) {
    std::vector<Dot> dots;
    for (const json& setting : scene["settings"]) {
        const json& time = setting["time"];
        const double error = shownError(setting["error"], metric);
        if (error <= 0.0) continue;  // logarithmic axis
        dots.push_back({time["low_ms"], time["median_ms"], time["high_ms"], error,
                        setting.value("front", false),
                        setting["preset"].is_string() ? setting["preset"].get<std::string>() : ""});
    }
    std::sort(dots.begin(), dots.end(), [](const Dot& a, const Dot& b) { return a.time < b.time; });
    return dots;
}

std::string frameCommands(int width, int height) {
    return "set terminal pngcairo size " + std::to_string(width) + "," + std::to_string(height) +
           " font \"sans,11\"\nset encoding utf8\nset output\nset border linewidth 1 linecolor rgb "
           "\"#444444\"\n"
           "set tics nomirror\nset grid linecolor rgb \"#dddddd\"\nset logscale xy\nset format x \"%g\"\n";
}

}  // namespace

std::string costChart(const json& costs, int width, int height) {
    std::string blocks, plots;
    size_t index = 0;
    for (const json& cost : costs) {
        const std::string n = std::to_string(index), colour = plot::seriesColor(index++);
        std::vector<std::string> points;
        for (const json& point : cost["points"])
            points.push_back(number(point["count"]) + " " + number(point["median_ms"]) + " " +
                             number(point["low_ms"]) + " " + number(point["high_ms"]));
        blocks += plot::dataBlock("points" + n, points);
        const json& fit = cost["fit"];
        std::ostringstream title;
        title.precision(3);
        title << cost["scene"].get<std::string>() << ": exponent " << fit["exponent"].get<double>() << " ("
              << fit["exponent_low"].get<double>() << " to " << fit["exponent_high"].get<double>() << ")";
        plots += std::string(plots.empty() ? "" : ", ") + "$points" + n +
                 " using 1:2:3:4 with yerrorbars pointtype 7 linecolor rgb \"" + colour + "\" notitle, " +
                 number(fit["constant_ms"]) + " + " + number(fit["factor_ms"]) + " * x ** " +
                 number(fit["exponent"]) + " with lines linewidth 2 linecolor rgb \"" + colour + "\" title " +
                 plot::gnuplotText(title.str()) + " noenhanced";
    }
    return plot::runGnuplot(
        frameCommands(width, height) + "set format y \"%g\"\nset key top left noenhanced\n" +
        "set samples 500\nset xlabel " +
        plot::gnuplotText("number of " + costs[0]["what"].get<std::string>()) + " noenhanced\nset ylabel " +
        plot::gnuplotText("time of a frame, ms") + " noenhanced\n" + blocks + "plot " + plots + "\n");
}

std::string reportChart(const json& report, const std::string& metric, int width, int height) {
    std::string blocks, plots, labels;
    size_t index = 0;
    int presets = 0;  // names of neighbours stand above and below
    double highest = 0.0, lowest = 1e300, fastest = 1e300, slowest = 0.0;
    for (const json& scene : report["scenes"]) {
        const std::string n = std::to_string(index), colour = plot::seriesColor(index);
        std::vector<std::string> all, front;
        for (const Dot& dot : dotsOf(scene, metric)) {
            all.push_back(number(dot.time) + " " + number(dot.error) + " " + number(dot.low) + " " +
                          number(dot.high));
            if (dot.front) front.push_back(number(dot.time) + " " + number(dot.error));
            if (!dot.preset.empty())
                labels += "set label " + plot::gnuplotText(dot.preset) + " noenhanced at first " +
                          number(dot.time) + ", first " + number(dot.error) +
                          " offset character 0.8, character " + (presets++ % 2 == 0 ? "0.7" : "-0.9") +
                          " textcolor rgb \"#444444\"\n";
            highest = std::max(highest, dot.error);
            lowest = std::min(lowest, dot.error);
            fastest = std::min(fastest, dot.low);
            slowest = std::max(slowest, dot.high);
        }
        ++index;
        if (all.empty()) continue;
        blocks += plot::dataBlock("all" + n, all) + plot::dataBlock("front" + n, front);
        plots += std::string(plots.empty() ? "" : ", ") + "$all" + n +
                 " using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0.8 linecolor rgb \"" + colour +
                 "\" notitle, $front" + n +
                 " using 1:2 with linespoints linewidth 2 pointtype 6 pointsize 1.6 " + "linecolor rgb \"" +
                 colour + "\" title " +
                 plot::gnuplotText(scene["scene"].get<std::string>() + ": Pareto front") + " noenhanced";
    }
    if (plots.empty())
        throw Error(ExitCode::checkFailed, "no setting with a time and an error above 0 to draw");
    const std::string clock = report["context"].value("clock", "");
    return plot::runGnuplot(frameCommands(width, height) +
                            "set format y \"10^{%T}\"\nset key top right noenhanced\nset xrange [" +
                            number(fastest * 0.7) + ":" + number(slowest * 2.0) + "]\nset yrange [" +
                            number(lowest * 0.5) + ":" + number(highest * 2.0) + "]\nset xlabel " +
                            plot::gnuplotText("time of a frame, ms (" + clock + ")") +
                            " noenhanced\nset ylabel " + plot::gnuplotText(axisOf(metric)) + " noenhanced\n" +
                            blocks + labels + "plot " + plots + "\n");
}

}  // namespace lobe::measure
