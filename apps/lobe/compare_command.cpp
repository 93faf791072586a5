// lobe compare: how far a picture is from the truth.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <set>

#include "arguments.hpp"
#include "base/atomic_file.hpp"
#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "comparison_report.hpp"
#include "error_picture.hpp"
#include "image/edges.hpp"
#include "image/image_files.hpp"
#include "plot_options.hpp"

namespace lobe::app {
namespace {

/// Radiance formats by their first bytes, as the image worker tells them: EXR and Radiance HDR.
bool holdsRadiance(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    char magic[4] = {};
    stream.read(magic, sizeof magic);
    const std::string_view bytes(magic, static_cast<size_t>(stream.gcount()));
    return bytes == "\x76\x2f\x31\x01" || bytes.starts_with("#?");
}

Image readRgb(ImageFiles& files, const std::string& file) {
    Image image = files.read(file);
    if (rgbLayer(image, "")) return image;
    throw InputError(file + ": channels: " + listed(image.channels) + "; expected R, G and B");
}

Metric metricNamed(const std::string& option, const std::string& name) {
    return static_cast<Metric>(choiceOf(option, name, metricNames()));
}

Threshold thresholdOf(const std::string& text, bool isMinimum, bool display) {
    const std::string option = isMinimum ? "--min" : "--max";
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(option + " " + text + "; expected METRIC=VALUE");
    const std::string name = text.substr(0, equals);
    const Metric metric = metricNamed(option, name);
    if (largerIsBetter(metric) != isMinimum)
        throw UsageError(option + " " + text + ": of " + name + (isMinimum ? " smaller" : " larger") +
                         " is better; expected " + (isMinimum ? "--max " : "--min ") + text);
    if (display && !isForDisplay(metric))
        throw UsageError(option + " " + text +
                         ": display pictures have no radiance; expected flip, flip_p99, "
                         "flip_max, psnr or ssim");
    const std::vector<double> values = numberList(option + " " + name, text.substr(equals + 1));
    if (values.size() != 1) throw UsageError(option + " " + text + "; expected one number");
    return {metric, values[0], isMinimum};
}

void addEdges(ComparisonReport& report, const ErrorMaps& maps, const Image& test, const Image& truth) {
    const std::optional<PixelMask> edges = edgePixels(test, truth);
    if (!edges) {
        report.notes.push_back(
            "edges and shading can't be told apart: neither picture has material.id, depth.Z or normal.X Y "
            "Z");
        return;
    }
    PixelMask shading(edges->size());
    std::transform(edges->begin(), edges->end(), shading.begin(),
                   [](uint8_t edge) { return static_cast<uint8_t>(edge == 0); });
    report.parts.push_back({"edges", "", poolErrors(maps, *edges)});
    report.parts.push_back({"shading", "", poolErrors(maps, shading)});
}

void addMaterials(ComparisonReport& report, const ErrorMaps& maps, const Image& test, const Image& truth) {
    std::optional<Plane> ids = channelOf(truth, "material.id");
    if (!ids) ids = channelOf(test, "material.id");
    if (!ids) return;
    for (const double id : std::set<double>(ids->begin(), ids->end())) {
        if (id < 1.0) continue;  // nothing is there
        PixelMask mask(ids->size());
        std::transform(ids->begin(), ids->end(), mask.begin(),
                       [&](double own) { return static_cast<uint8_t>(own == id); });
        report.parts.push_back(
            {"material", std::to_string(static_cast<long>(id) - 1), poolErrors(maps, mask)});
    }
}

void addLights(ComparisonReport& report, const Image& test, const Image& truth) {
    for (const char* light : {"emission", "ambient", "directional", "point", "spot", "transparent"}) {
        const std::string layer = std::string(light) + ".";
        const std::optional<Image> a = rgbLayer(test, layer), b = rgbLayer(truth, layer);
        // Without FLIP, which is of what one sees, and that is the sum of all light.
        if (a && b) report.parts.push_back({"light", light, measureError(*a, *b, {.perceptual = false})});
    }
}

}  // namespace

int compareCommand(const std::vector<std::string>& list) {
    Arguments arguments("compare", "Measure how far picture A is from B, the truth (docs/compare.md).");
    std::string testFile, truthFile, output, jsonFile;
    std::vector<std::string> metrics, maxima, minima;
    bool subtract = false;
    CLI::App& app = arguments.app();
    app.add_option("A", testFile, "picture to judge: EXR, HDR, PNG or JPEG")->required();
    app.add_option("B", truthFile, "the truth, of the same size and kind")->required();
    app.add_option("-o,--output", output,
                   "map of the first metric: .png or .jpg in viridis, .exr its values");
    app.add_option("--metric", metrics, "one of " + listed(metricNames()) + "; may be repeated [all]")
        ->type_name("NAME")
        ->allow_extra_args(false);
    app.add_option("--max", maxima, "fail (exit code 1) above it; may be repeated")
        ->type_name("METRIC=VALUE")
        ->allow_extra_args(false);
    app.add_option("--min", minima, "fail below it: psnr, ssim; may be repeated")
        ->type_name("METRIC=VALUE")
        ->allow_extra_args(false);
    app.add_option("--json", jsonFile, "write the result; - is standard output, without the table")
        ->type_name("FILE");
    app.add_flag("--subtract-truth-variance", subtract,
                 "take the truth's standard error (its channels error.R G B) off rel_mse and rmse");
    if (!arguments.parse(list)) return 0;

    const bool display = !holdsRadiance(testFile);
    ImageFiles files;
    const Image test = readRgb(files, testFile), truth = readRgb(files, truthFile);
    if (holdsRadiance(truthFile) == display)
        throw UsageError(testFile + ", " + truthFile +
                         ": one holds radiance and one display colours; expected two of a kind");
    if (test.width != truth.width || test.height != truth.height)
        throw InputError(testFile + ": size: " + std::to_string(test.width) + "x" +
                         std::to_string(test.height) + "; expected " + std::to_string(truth.width) + "x" +
                         std::to_string(truth.height) + " as " + truthFile);
    ComparisonReport report{testFile, truthFile, truth.width, truth.height, display, {}, {}, {}, {}};
    for (const std::string& name : metrics)
        report.shown.push_back(metricNamed("--metric", name));
    for (size_t i = 0; metrics.empty() && i < kMetricCount; ++i)
        if (!display || isForDisplay(static_cast<Metric>(i))) report.shown.push_back(static_cast<Metric>(i));
    for (const std::string& text : maxima)
        report.thresholds.push_back(thresholdOf(text, false, display));
    for (const std::string& text : minima)
        report.thresholds.push_back(thresholdOf(text, true, display));
    for (const Metric metric : report.shown)
        if (display && !isForDisplay(metric))
            throw UsageError(
                "--metric " + metricNames()[static_cast<size_t>(metric)] +
                ": display pictures have no radiance; expected flip, flip_p99, flip_max, psnr or "
                "ssim");
    if (!output.empty()) requireMapName(output);
    const ErrorOptions options{.display = display, .subtractTruthVariance = subtract};
    if (display) report.notes.push_back("display pictures: radiance and its metrics are not known");
    if (subtract && display)
        throw UsageError("--subtract-truth-variance: display pictures have no standard error; expected EXR");

    ErrorMetrics bad;
    for (auto [image, found] : {std::pair(&test, &bad.testNonFinite), std::pair(&truth, &bad.truthNonFinite)})
        *found = countNonFinite(*image);
    const bool finite = bad.testNonFinite.pixels == 0 && bad.truthNonFinite.pixels == 0;
    if (finite) {
        const ErrorMaps maps = errorMaps(test, truth, options);
        report.parts.push_back({"all", "", poolErrors(maps)});
        addEdges(report, maps, test, truth);
        addMaterials(report, maps, test, truth);
        addLights(report, test, truth);
        const Metric drawn = !metrics.empty() ? report.shown.front()
                             : display        ? Metric::flip
                                              : Metric::hdrFlip;
        if (!output.empty()) report.notes.push_back(writeErrorMap(output, maps, drawn, files));
    } else {
        report.parts.push_back({"all", "", bad});
        if (!output.empty()) report.notes.emplace_back("no map: of non-finite pixels there is no error");
    }
    if (jsonFile == "-")
        std::cout << toJson(report).dump(2) << '\n';
    else
        std::cout << toText(report);
    if (!jsonFile.empty() && jsonFile != "-") writeAtomically(jsonFile, toJson(report).dump(2) + "\n");
    if (!finite) {
        const bool own = bad.testNonFinite.pixels > 0;
        throw Error(ExitCode::nonFinite,
                    (own ? testFile : truthFile) + ": non-finite pixels: " +
                        std::to_string((own ? bad.testNonFinite : bad.truthNonFinite).pixels) +
                        "; expected none");
    }
    for (const Threshold& one : report.thresholds)
        if (!holds(one, report.parts.front().metrics))
            throw Error(ExitCode::checkFailed,
                        testFile + ": " + metricNames()[static_cast<size_t>(one.metric)] + ": " +
                            std::to_string(*report.parts.front().metrics[one.metric]) + "; expected at " +
                            (one.isMinimum ? "least " : "most ") + std::to_string(one.value));
    return 0;
}

}  // namespace lobe::app
