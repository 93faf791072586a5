/// What every kind of plot becomes: numbers for CSV, and gnuplot commands within a common frame.
#pragma once

#include "plot/albedo.hpp"
#include "plot/error_map.hpp"
#include "plot/fit_errors.hpp"
#include "plot/fresnel_curves.hpp"
#include "plot/lobe_surface.hpp"
#include "plot/slice.hpp"
#include "plot/table.hpp"
#include "plot/terms.hpp"

namespace lobe::plot {

struct Drawing {
    Table table;
    std::string title;
    std::vector<std::string> caption;  ///< what was drawn, under which values
    /// To draw between the screen heights `bottom` and `top`, which are set (0..1). Everything else is
    /// relative to a canvas of this size.
    std::string commands;
    int width = 960, height = 640;  ///< pixels, unless others are asked for
};

enum class RadiusScale { automatic, linear, sqrt, log };

Drawing draw(const Lobes& lobes, RadiusScale scale);
Drawing draw(const Terms& terms);
Drawing draw(const FresnelCurves& curves);
enum class AlbedoStyle { curves, map };
Drawing draw(const Albedo& albedo, AlbedoStyle style);
Drawing draw(const Surface& surface);
Drawing draw(const Slice& slice);
enum class ErrorMeasure { ulp, share };
Drawing draw(const ErrorMap& map, ErrorMeasure measure);
Drawing draw(const FitErrors& fits);

enum class Format { svg, png, csv };

/// Bytes of the file; the same for the same drawing. Width and height in pixels scale the text with them.
/// Throws as runGnuplot does.
std::string render(const Drawing& drawing, Format format, int width, int height);

}  // namespace lobe::plot
