/// The kinds of `lobe plot`: their options, and the drawing that they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "plot/drawing.hpp"

namespace lobe::app {

/// Options as they were written; empty where they were not.
struct PlotOptions {
    std::string brdf, table, incidence, quantity, radius, channel, azimuth, over, range, steps, style, show,
        ambient, eta, k, metal, f0, phiD;
    std::vector<std::string> set;
};

struct PlotKind {
    std::string name;
    std::string description;
    std::function<void(CLI::App&, PlotOptions&)> addOptions;
    std::function<plot::Drawing(const PlotOptions&, const plot::Sampler&)> make;
};

const std::vector<PlotKind>& plotKinds();

}  // namespace lobe::app
