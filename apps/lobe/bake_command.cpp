// lobe bake: an environment prefiltered for models, as files for other programs.
#include <iostream>

#include "arguments.hpp"
#include "baked_environment.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "shot_environment.hpp"

namespace lobe::app {
namespace {

std::optional<std::pair<double, double>> widthsOf(const std::string& text) {
    if (text.empty()) return {};
    const size_t comma = text.find(',');
    std::array<double, 2> ends{};
    bool good = true;
    for (size_t i = 0; i < 2; ++i) {
        const std::string part = comma == std::string::npos ? text
                                 : i == 0                   ? text.substr(0, comma)
                                                            : text.substr(comma + 1);
        try {
            size_t read = 0;
            ends[i] = std::stod(part, &read);
            good = good && read == part.size();
        } catch (const std::exception&) {
            good = false;
        }
    }
    if (!good || !(ends[0] > 0.0 && ends[0] <= ends[1] && ends[1] <= 1e6))
        throw UsageError("--widths " + text +
                         "; expected one width above 0, or FROM,TO with FROM at most TO");
    return std::pair(ends[0], ends[1]);
}

std::vector<const Brdf*> modelsOf(const std::vector<std::string>& names) {
    std::vector<const Brdf*> all, models;
    std::string listed;
    for (const Brdf& brdf : allBrdfs()) {
        if (!whyNotBaked(brdf).empty()) continue;
        all.push_back(&brdf);
        listed += (listed.empty() ? "" : ", ") + brdf.name;
    }
    for (const std::string& name : names) {
        const Brdf& brdf = requireBrdf(name);
        if (const std::string why = whyNotBaked(brdf); !why.empty())
            throw UsageError("--models " + name + ": " + why + "; expected some of " + listed);
        models.push_back(&brdf);
    }
    return names.empty() ? all : models;
}

}  // namespace

int bakeCommand(const std::vector<std::string>& list) {
    Arguments arguments(
        "bake",
        "Prefilter an environment for models, and write maps, tables and a README that says how to use "
        "them into the folder -o [baked].");
    std::string picture, widths;
    std::vector<std::string> names;
    bool quiet = false;
    arguments.app()
        .add_option("environment", picture,
                    "a picture, cross, or six faces, as --env takes them; or give --sky")
        ->type_name("ENV");
    arguments.app()
        .add_option("--models", names,
                    "for which models; default all whose lobe is split from the environment")
        ->delimiter(',')
        ->type_name("NAME,...");
    arguments.app()
        .add_option("--widths", widths, "of each model's width parameter; default all that it takes")
        ->type_name("FROM,TO");
    arguments.app().add_flag("-q,--quiet", quiet, "only errors and warnings");
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;

    Settings settings = arguments.sources().resolve("");
    if (!picture.empty()) settings.set("!env", picture, "command line");
    if (settings.get("env").is_null() && settings.get("sky").is_null())
        throw UsageError("nothing to bake; expected a picture of an environment, or --sky");
    const BakeRequest request{modelsOf(names), widthsOf(widths)};
    const nlohmann::json& output = settings.get("output");
    const std::filesystem::path folder = output.is_null() ? "baked" : output.get<std::string>();

    Scene scene;
    applyEnvironment(scene, settings);
    for (const std::string& warning : scene.warnings)
        std::cerr << "lobe: warning: " << warning << '\n';
    ImageFiles files;
    bakeEnvironment(scene, request, folder, files, [&](const std::string& what) {
        if (!quiet) std::cerr << (folder / what).string() << '\n';
    });
    return 0;
}

}  // namespace lobe::app
