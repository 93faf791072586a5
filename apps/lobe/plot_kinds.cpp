#include "plot_kinds.hpp"

#include "base/error.hpp"
#include "plot/geometry.hpp"
#include "plot_options.hpp"
#include "shading/metals.hpp"

namespace lobe::app {
namespace {

constexpr int kMostSteps = 200;
constexpr double kSteepestAngle = 88.0;  // of incidence, where sweeps over angles end

void addModel(CLI::App& app, PlotOptions& options, const char* help) {
    app.add_option("--brdf", options.brdf, help)->type_name("NAME");
    app.add_option("--set,-D", options.set,
                   "set a parameter, by the name that scenes have for it; may be repeated")
        ->type_name("[MODEL.]PARAMETER=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

void addView(CLI::App& app, PlotOptions& options) {
    app.add_option("--channel", options.channel, "luminance, red, green or blue [luminance]");
    app.add_option("--azimuth", options.azimuth,
                   "of the plane of incidence against the tangent, degrees, as --azimuth=30 [0]");
}

void addQuantity(CLI::App& app, PlotOptions& options) {
    app.add_option("--quantity", options.quantity,
                   "f_cos (times the light's cosine), f, or f_cos_out (times the eye's) [f_cos]");
}

void addSweep(CLI::App& app, PlotOptions& options, const char* stepsHelp) {
    app.add_option("--over", options.over, "parameter to sweep [the one that sets the lobe's width]")
        ->type_name("PARAMETER");
    app.add_option("--range", options.range, "of that parameter [what surfaces use]")->type_name("LOW,HIGH");
    app.add_option("--steps", options.steps, stepsHelp);
}

double azimuthOf(const PlotOptions& options) {
    return options.azimuth.empty() ? 0.0 : numberIn("--azimuth", options.azimuth, -360.0, 360.0);
}

int stepsOf(const PlotOptions& options, int otherwise) {
    return options.steps.empty() ? otherwise
                                 : static_cast<int>(numberIn("--steps", options.steps, 2, kMostSteps));
}

plot::Quantity quantityOf(const PlotOptions& options) {
    return static_cast<plot::Quantity>(choiceOf("--quantity", options.quantity, {"f_cos", "f", "f_cos_out"}));
}

std::vector<double> incidencesOf(const PlotOptions& options, std::vector<double> otherwise) {
    if (options.incidence.empty()) return otherwise;
    std::vector<double> incidences = numberList("--incidence", options.incidence);
    constexpr size_t kMost = 8;
    if (incidences.size() > kMost)
        throw UsageError("--incidence: " + std::to_string(incidences.size()) + " angles; expected at most 8");
    return incidences;
}

void addIncidences(CLI::App& app, PlotOptions& options, const char* help) {
    app.add_option("--incidence", options.incidence, help)->type_name("DEGREES,...");
}

PlotKind lobesKind() {
    return {"lobes", "Polar lobes of one or several models in the plane of incidence.",
            [](CLI::App& app, PlotOptions& options) {
                addModel(app, options, "models, separated by commas");
                addIncidences(app, options, "angles of incidence [0,30,60]");
                addQuantity(app, options);
                app.add_option("--radius", options.radius, "auto, linear, sqrt or log [auto]");
                addView(app, options);
            },
            [](const PlotOptions& options, const plot::Sampler& sampler) {
                const plot::LobesRequest request{
                    modelsOf(options.brdf, options.set), incidencesOf(options, {0.0, 30.0, 60.0}),
                    quantityOf(options), channelNamed(options.channel), azimuthOf(options)};
                const auto scale = static_cast<plot::RadiusScale>(
                    choiceOf("--radius", options.radius, {"auto", "linear", "sqrt", "log"}));
                return plot::draw(plot::computeLobes(sampler, request), scale);
            }};
}

PlotKind tableKind() {
    return {"table", "A table of lobes: ambient, diffuse, specular and total, a row for each incidence.",
            [](CLI::App& app, PlotOptions& options) {
                addModel(app, options, "model with a diffuse and a specular part");
                addIncidences(app, options, "angles of incidence [60,25,0]");
                app.add_option("--ambient", options.ambient,
                               "radiance of the surroundings, for light of irradiance 1 [0.1]");
                addView(app, options);
            },
            [](const PlotOptions& options, const plot::Sampler& sampler) {
                // A default of no ambient reflection would leave a column empty.
                std::vector<std::string> set = options.set;
                const Brdf* brdf = findBrdf(options.brdf);
                if (brdf != nullptr && brdf->parameterIndex("ambient") >= 0)
                    set.insert(set.begin(), "ambient=1");
                plot::TermsRequest request{modelOf(options.brdf, set)};
                request.incidences = incidencesOf(options, request.incidences);
                if (!options.ambient.empty())
                    request.ambientRadiance = numberIn("--ambient", options.ambient, 0.0, 1e3);
                request.channel = channelNamed(options.channel);
                request.azimuth = azimuthOf(options);
                return plot::draw(plot::computeTerms(sampler, request));
            }};
}

/// One interface where all channels are alike, else three.
plot::FresnelRequest fresnelRequest(std::string name, const glm::dvec3& eta, const glm::dvec3& k) {
    plot::FresnelRequest request{std::move(name), {}};
    if (eta == glm::dvec3(eta.x) && k == glm::dvec3(k.x)) {
        request.interfaces = {{"", eta.x, k.x}};
        return request;
    }
    constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
    for (int c = 0; c < 3; ++c)
        request.interfaces.push_back({kChannels[static_cast<size_t>(c)], eta[c], k[c]});
    return request;
}

glm::dvec3 oneOrThree(const std::string& option, const std::string& text) {
    const std::vector<double> numbers = numberList(option, text);
    if (numbers.size() != 1 && numbers.size() != 3)
        throw UsageError(option + ": '" + text + "'; expected one number, or three as red,green,blue");
    return numbers.size() == 1 ? glm::dvec3(numbers[0]) : glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

/// Of a number or three; or by name in the lecture's table.
plot::FresnelRequest byNormalReflectance(const std::string& text) {
    glm::dvec3 f0(0.0);
    bool named = false;
    for (const shading::NamedReflectance& entry : shading::namedReflectances())
        if (entry.name == text) {
            f0 = entry.f0;
            named = true;
        }
    if (!named) f0 = oneOrThree("--f0", text);
    glm::dvec3 eta;
    constexpr double kHighest = 0.8;  // an index of 18; the registry's end at 20
    for (int c = 0; c < 3; ++c) {
        if (!(f0[c] >= 0.0 && f0[c] <= kHighest))
            throw UsageError(
                "--f0: " + plot::shortNumber(f0[c]) +
                "; expected 0..0.8, which an index without absorption can give; metals by --metal");
        eta[c] = plot::indexOf(f0[c]);
    }
    return fresnelRequest(named ? text : "F0 " + text, eta, glm::dvec3(0.0));
}

plot::FresnelRequest fresnelOf(const PlotOptions& options) {
    const int given = int(!options.eta.empty()) + int(!options.metal.empty()) + int(!options.f0.empty());
    if (given > 1)
        throw UsageError("--eta, --metal, --f0: " + std::to_string(given) + " given; expected one");
    if (!options.k.empty() && options.eta.empty()) throw UsageError("--k: expected beside --eta");
    if (!options.f0.empty()) return byNormalReflectance(options.f0);
    if (options.metal.empty()) {
        const std::string eta = options.eta.empty() ? "1.5" : options.eta;
        return fresnelRequest("index " + eta + (options.k.empty() ? "" : " + " + options.k + " i"),
                              oneOrThree("--eta", eta),
                              options.k.empty() ? glm::dvec3(0.0) : oneOrThree("--k", options.k));
    }
    std::vector<std::string> names;
    for (const shading::Metal& metal : shading::metals())
        names.push_back(metal.name);
    const shading::Metal& metal = shading::metals()[choiceOf("--metal", options.metal, names)];
    return fresnelRequest(metal.name, metal.eta, metal.k);
}

PlotKind fresnelKind() {
    return {"fresnel", "Fresnel reflectance: exact, by polarisation, and Schlick's approximation.",
            [](CLI::App& app, PlotOptions& options) {
                app.add_option("--eta", options.eta, "index of refraction, one or three numbers [1.5]");
                app.add_option("--k", options.k, "extinction coefficient, beside --eta");
                app.add_option("--metal", options.metal, "eta and k by name");
                app.add_option(
                    "--f0", options.f0,
                    "reflectance at normal incidence, or a name of the table of such (water, glass)");
            },
            [](const PlotOptions& options, const plot::Sampler& sampler) {
                return plot::draw(plot::computeFresnel(sampler, fresnelOf(options)));
            }};
}

PlotKind albedoKind() {
    return {"albedo", "Directional albedo against the angle of incidence and a parameter.",
            [](CLI::App& app, PlotOptions& options) {
                addModel(app, options, "model");
                addSweep(app, options, "values of the parameter [6 curves, or 24 rows of a map]");
                app.add_option("--as", options.style, "curves or map [curves]");
                addView(app, options);
            },
            [](const PlotOptions& options, const plot::Sampler& sampler) {
                const plot::Model model = modelOf(options.brdf, options.set);
                const auto style =
                    static_cast<plot::AlbedoStyle>(choiceOf("--as", options.style, {"curves", "map"}));
                const bool map = style == plot::AlbedoStyle::map;
                const Sweep sweep =
                    sweepOf(model, options.over, options.range, stepsOf(options, map ? 24 : 6));
                if (map && sweep.over.empty())
                    throw UsageError("--as map: " + model.brdf->name +
                                     " has no parameter to sweep; expected curves");
                const plot::AlbedoRequest request{model,
                                                  sweep.over,
                                                  sweep.values,
                                                  plot::linearSteps(0.0, kSteepestAngle, 45),
                                                  channelNamed(options.channel),
                                                  azimuthOf(options)};
                return plot::draw(plot::computeAlbedo(sampler, request), style);
            }};
}

PlotKind lobe3dKind() {
    return {
        "lobe3d", "A lobe in three dimensions.",
        [](CLI::App& app, PlotOptions& options) {
            addModel(app, options, "model");
            app.add_option("--incidence", options.incidence, "angle of incidence [45]")->type_name("DEGREES");
            addQuantity(app, options);
            addView(app, options);
        },
        [](const PlotOptions& options, const plot::Sampler& sampler) {
            plot::SurfaceRequest request{modelOf(options.brdf, options.set)};
            if (!options.incidence.empty())
                request.incidence = numberIn("--incidence", options.incidence, 0.0, 89.9);
            request.quantity = quantityOf(options);
            request.channel = channelNamed(options.channel);
            request.azimuth = azimuthOf(options);
            return plot::draw(plot::computeSurface(sampler, request));
        }};
}

PlotKind sliceKind() {
    return {"slice", "An image of a model's values over half angle and difference angle.",
            [](CLI::App& app, PlotOptions& options) {
                addModel(app, options, "model [measured, with --table]");
                app.add_option("--table", options.table, "MERL table to show")->type_name("FILE.binary");
                app.add_option("--phi-d", options.phiD,
                               "azimuth of the light about the half vector, degrees [90]");
            },
            [](const PlotOptions& options, const plot::Sampler& sampler) {
                if (options.brdf.empty() == options.table.empty())
                    throw UsageError("--brdf, --table: expected one of them");
                std::vector<std::string> set = options.set;
                if (!options.table.empty()) set.insert(set.begin(), "file=" + options.table);
                plot::SliceRequest request{modelOf(options.table.empty() ? options.brdf : "measured", set)};
                if (!options.phiD.empty()) request.phiD = numberIn("--phi-d", options.phiD, 0.0, 180.0);
                return plot::draw(plot::computeSlice(sampler, request));
            }};
}

PlotKind errorKind() {
    return {"error", "Error of a model's GLSL against its double twin, over incidence and a parameter.",
            [](CLI::App& app, PlotOptions& options) {
                addModel(app, options, "model");
                addSweep(app, options, "values of the parameter [24]");
                app.add_option("--show", options.show,
                               "ulp, or share (of what the rounding of inputs allows) [ulp]");
                app.add_option("--azimuth", options.azimuth,
                               "of the plane of incidence against the tangent, degrees [0]");
            },
            [](const PlotOptions& options, const plot::Sampler& sampler) {
                const plot::Model model = modelOf(options.brdf, options.set);
                const auto measure =
                    static_cast<plot::ErrorMeasure>(choiceOf("--show", options.show, {"ulp", "share"}));
                const Sweep sweep = sweepOf(model, options.over, options.range, stepsOf(options, 24));
                const plot::ErrorRequest request{model, sweep.over, sweep.values,
                                                 plot::linearSteps(0.0, kSteepestAngle, 45),
                                                 azimuthOf(options)};
                return plot::draw(plot::computeErrorMap(sampler, request), measure);
            }};
}

PlotKind fitKind() {
    return {"fit", "Error of the fits for lights with a body, over the angle of view and a parameter.",
            [](CLI::App& app, PlotOptions& options) {
                addModel(app, options, "model");
                addSweep(app, options, "values of the parameter [12]");
            },
            [](const PlotOptions& options, const plot::Sampler&) {
                const plot::Model model = modelOf(options.brdf, options.set);
                const Sweep sweep = sweepOf(model, options.over, options.range, stepsOf(options, 12));
                return plot::draw(plot::computeFitErrors(
                    {model, sweep.over, sweep.values, plot::linearSteps(0.0, kSteepestAngle, 45)}));
            }};
}

}  // namespace

const std::vector<PlotKind>& plotKinds() {
    static const std::vector<PlotKind> kinds{lobesKind(),  tableKind(), fresnelKind(), albedoKind(),
                                             lobe3dKind(), sliceKind(), errorKind(),   fitKind()};
    return kinds;
}

}  // namespace lobe::app
