// lobe plot: pictures of reflectance models, from the GLSL that renders.
#include <filesystem>
#include <iostream>

#include "arguments.hpp"
#include "base/atomic_file.hpp"
#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"
#include "commands.hpp"
#include "gl/context.hpp"
#include "gl/program.hpp"
#include "plot_kinds.hpp"
#include "plot_options.hpp"

namespace lobe::app {
namespace {

constexpr const char* kUsage = "usage: lobe plot KIND -o FILE.svg|.png|.csv [OPTION...]\n";

struct Output {
    std::string file, format, size, title, backend, device;
    bool twin = false;
};

void addOutput(CLI::App& app, Output& output) {
    app.add_option("-o,--output", output.file, ".svg, .png or .csv; - for standard output, with --format")
        ->type_name("FILE");
    app.add_option("--format", output.format, "svg, png or csv [by the file's extension]");
    app.add_option("--size", output.size, "of the picture, pixels; text grows with it")->type_name("W,H");
    app.add_option("--title", output.title, "in place of the plot's own");
    CLI::Option* backend =
        app.add_option("--backend", output.backend, "auto, egl, osmesa or glfw: where the GLSL runs [auto]");
    CLI::Option* device = app.add_option("--device", output.device, "EGL device by its index in lobe info");
    app.add_flag("--twin", output.twin, "values from the double-precision twin, without OpenGL")
        ->excludes(backend)
        ->excludes(device);
}

const std::vector<std::string> kFormats{"svg", "png", "csv"};

plot::Format formatOf(const Output& output) {
    if (output.file.empty())
        throw UsageError("-o: missing; expected a file .svg, .png or .csv, or - with --format");
    const bool stream = output.file == "-";
    if (stream && output.format.empty())
        throw UsageError("-o -: expected --format svg, png or csv beside it");
    const std::string extension = std::filesystem::path(output.file).extension().string();
    const std::string named = extension.empty() ? "" : extension.substr(1);
    if (!stream && std::find(kFormats.begin(), kFormats.end(), named) == kFormats.end())
        throw UsageError("-o " + output.file + ": expected a name that ends in .svg, .png or .csv");
    const size_t format = choiceOf("--format", stream ? output.format : named, kFormats);
    if (!stream && choiceOf("--format", output.format, kFormats, format) != format)
        throw UsageError("-o " + output.file + ", --format " + output.format + ": expected the same of both");
    return static_cast<plot::Format>(format);
}

struct Size {
    int width, height;
};

Size sizeOf(const std::string& text, const plot::Drawing& drawing) {
    if (text.empty()) return {drawing.width, drawing.height};
    constexpr double kSmallest = 320.0, kLargest = 8192.0;
    std::string list = text;
    if (const size_t x = list.find('x'); x != std::string::npos) list[x] = ',';
    const std::vector<double> sides = numberList("--size", list);
    const auto fits = [&](double side) {
        return side >= kSmallest && side <= kLargest && side == static_cast<int>(side);
    };
    if (sides.size() != 2 || !fits(sides[0]) || !fits(sides[1]))
        throw UsageError("--size: '" + text + "'; expected W,H, each 320 to 8192 pixels");
    return {static_cast<int>(sides[0]), static_cast<int>(sides[1])};
}

plot::Drawing makeDrawing(const PlotKind& kind, const PlotOptions& options, const Output& output) {
    if (output.twin) {
        plot::Drawing drawing = kind.make(options, plot::Sampler());
        drawing.caption.back() += "; values of the double twin";
        return drawing;
    }
    gl::ContextRequest request;
    if (!output.backend.empty()) request.backend = gl::parseBackend(output.backend);
    if (!output.device.empty())
        request.device = static_cast<int>(numberIn("--device", output.device, 0.0, 255.0));
    const auto context = gl::Context::create(request);
    const gl::ShaderLibrary library(shaderDirectory());
    plot::Drawing drawing = kind.make(options, plot::Sampler(library));
    if (kind.name != "error") drawing.caption.back() += "; values of the GLSL";
    return drawing;
}

const PlotKind& requireKind(const std::string& name) {
    std::vector<std::string> names;
    std::string list;
    for (const PlotKind& kind : plotKinds()) {
        if (kind.name == name) return kind;
        names.push_back(kind.name);
        list += (list.empty() ? "" : ", ") + kind.name;
    }
    throw UsageError("plot: " + (name.empty() ? "no kind" : "unknown kind '" + name + "'") +
                     didYouMean(name, names) + "; expected one of " + list);
}

}  // namespace

int plotCommand(const std::vector<std::string>& list) {
    const std::string name = list.empty() ? "" : list[0];
    if (name == "--help" || name == "-h") {
        std::cout << kUsage;
        for (const PlotKind& kind : plotKinds())
            std::cout << "  " << kind.name << std::string(10 - kind.name.size(), ' ') << kind.description
                      << '\n';
        std::cout << "lobe plot KIND --help lists a kind's options.\n";
        return 0;
    }
    const PlotKind& kind = requireKind(name);
    Arguments arguments("plot " + kind.name, kind.description);
    PlotOptions options;
    Output output;
    kind.addOptions(arguments.app(), options);
    addOutput(arguments.app(), output);
    if (!arguments.parse({list.begin() + 1, list.end()})) return 0;

    const plot::Format format = formatOf(output);
    plot::Drawing drawing = makeDrawing(kind, options, output);
    if (!output.title.empty()) drawing.title = output.title;
    const Size size = sizeOf(output.size, drawing);
    const std::string bytes = plot::render(drawing, format, size.width, size.height);
    if (output.file == "-")
        std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    else
        writeAtomically(output.file, bytes);
    return 0;
}

}  // namespace lobe::app
