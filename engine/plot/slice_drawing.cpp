#include "plot/drawing.hpp"
#include "plot/geometry.hpp"
#include "plot/gnuplot.hpp"
#include "plot/style.hpp"

namespace lobe::plot {
namespace {

/// Cells are repeated so that viewers that smooth images leave edges where they are.
constexpr int kRepeat = 4;

Table tableOf(const Slice& slice) {
    Table table({"theta_h [deg]", "theta_d [deg]", "f_r red [1/sr]", "f_r green [1/sr]", "f_r blue [1/sr]",
                 "shown red [0..255]", "shown green [0..255]", "shown blue [0..255]"});
    for (const SliceCell& cell : slice.cells)
        table.add({cell.thetaH, cell.thetaD, cell.f.r, cell.f.g, cell.f.b, double(cell.tone[0]),
                   double(cell.tone[1]), double(cell.tone[2])});
    return table;
}

}  // namespace

Drawing draw(const Slice& slice) {
    const SliceRequest& request = slice.request;
    Drawing drawing{tableOf(slice),
                    request.model.brdf->title + ": slice at φ_d = " + shortNumber(request.phiD) + "°",
                    {},
                    "",
                    640,
                    720};
    drawing.caption = {
        describe(request.model),
        "f_r by channel; tone: ln(1 + f/a) / ln(1 + b/a), a = " + shortNumber(rounded(slice.reference, 3)) +
            " 1/sr (a tenth is below), b = " + shortNumber(rounded(slice.brightest, 3)) +
            " 1/sr (a hundredth is above)"};
    std::vector<std::string> lines;
    const int n = request.cells;
    for (int y = 0; y < n * kRepeat; ++y)
        for (int x = 0; x < n * kRepeat; ++x) {
            const SliceCell& cell = slice.cells[static_cast<size_t>(y / kRepeat) * static_cast<size_t>(n) +
                                                static_cast<size_t>(x / kRepeat)];
            const double step = 90.0 / (n * kRepeat);
            lines.push_back(numberText((x + 0.5) * step) + " " + numberText((y + 0.5) * step) + " " +
                            std::to_string(cell.tone[0]) + " " + std::to_string(cell.tone[1]) + " " +
                            std::to_string(cell.tone[2]));
        }
    drawing.commands =
        dataBlock("slice", lines) +
        "set lmargin at screen 0.12\nset rmargin at screen 0.96\nset bmargin at screen bottom + 70 * pixel\n"
        "set tmargin at screen top - 8 * pixel\nset size ratio 1\nunset key\nset tics out\nset xrange "
        "[0:90]\n"
        "set yrange [0:90]\nset xtics 0,15,90\nset ytics 0,15,90\n"
        "set xlabel \"half angle θ_h [°]\" noenhanced\nset ylabel \"difference angle θ_d [°]\" noenhanced\n"
        "plot $slice using 1:2:3:4:5 with rgbimage\n";
    return drawing;
}

}  // namespace lobe::plot
