#include "environment_commands.hpp"

#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "commands.hpp"
#include "environment_cost.hpp"
#include "environment_errors.hpp"
#include "environment_pictures.hpp"
#include "prefilter_times.hpp"

namespace lobe::bench {
namespace {

struct Settings {
    std::string json, table, backend = "auto", part;
    std::vector<std::string> pictures;
    int rounds = 3;
};

void runTimes(const Settings& settings, const std::vector<Panorama>& panoramas, nlohmann::json& report) {
    constexpr int kWidth = 2048;
    constexpr double kNarrowest = 0.02;
    std::printf("%s at %d x %d, widths %.2f to 1, least of %d rounds, all cores\n", panoramas[0].name.c_str(),
                kWidth, kWidth / 2, kNarrowest, settings.rounds);
    std::printf("%-20s %8s %12s %10s %12s %8s %7s\n", "what", "s", "processor s", "MiB", "samples", "floor s",
                "ratio");
    for (const PrefilterTime& time : prefilterTimes(
             resized(panoramas[0].bitmap, kWidth, kWidth / 2), kNarrowest, settings.rounds,
             [](const PrefilterTime& t) {
                 std::printf("%-20s %8.3f %12.3f %10.1f %12.3g %8.3f %7.1f\n", t.what.c_str(), t.seconds,
                             t.processor, t.bytes / (1 << 20), t.samples, t.floor, t.processor / t.floor);
                 std::fflush(stdout);
             }))
        report["prefilter"].push_back({{"what", time.what},
                                       {"seconds", time.seconds},
                                       {"processor_seconds", time.processor},
                                       {"bytes", time.bytes},
                                       {"samples", time.samples},
                                       {"floor_seconds", time.floor}});
}

void runCosts(gl::Context& context, const Settings& settings, const std::vector<Panorama>& panoramas,
              nlohmann::json& report) {
    std::printf("\n%s, ns a pixel, least of %d rounds\n", context.info().renderer.c_str(), settings.rounds);
    std::printf("%-20s %-18s %10s %12s %7s\n", "model", "method", "point", "environment", "ratio");
    for (const EnvironmentCost& cost :
         environmentCosts(context, panoramas[0].bitmap, settings.rounds, [](const EnvironmentCost& c) {
             std::printf("%-20s %-18s %10.1f %12.1f %7.2f\n", c.model.c_str(), c.method.c_str(), c.point,
                         c.environment, c.environment / c.point);
         }))
        report["costs"].push_back({{"model", cost.model},
                                   {"method", cost.method},
                                   {"point_ns", cost.point},
                                   {"environment_ns", cost.environment},
                                   {"ratio", cost.environment / cost.point}});
}

void runErrors(gl::Context& context, const Settings& settings, const std::vector<Panorama>& panoramas,
               nlohmann::json& report) {
    std::printf("\n%-28s %-20s %7s %6s %-16s %9s %9s\n", "panorama", "model", "width", "angle", "method",
                "error %", "bias %");
    const std::vector<EnvironmentError> errors =
        environmentErrors(context, panoramas, [](const EnvironmentError& e) {
            std::printf("%-28s %-20s %7.2f %6.0f %-16s %9.2f %9.2f\n", e.panorama.c_str(), e.model.c_str(),
                        e.width, e.angle, e.method.c_str(), 100.0 * e.error / e.truth,
                        100.0 * e.bias / e.truth);
            std::fflush(stdout);
        });
    for (const EnvironmentError& e : errors)
        report["errors"].push_back({{"panorama", e.panorama},
                                    {"model", e.model},
                                    {"width", e.width},
                                    {"angle", e.angle},
                                    {"method", e.method},
                                    {"truth", e.truth},
                                    {"error", e.error},
                                    {"bias", e.bias}});
    if (!settings.table.empty()) writeAtomically(settings.table, errorTable(errors));
}

void run(const Settings& settings) {
    const std::vector<Panorama> panoramas = panoramasOf(settings.pictures);
    nlohmann::json report = {{"schema", 1}};
    const auto asked = [&](const char* part) { return settings.part.empty() || settings.part == part; };
    if (asked("prefilter")) runTimes(settings, panoramas, report);
    if (asked("cost") || asked("error")) {
        const auto context = gl::Context::create({.backend = gl::parseBackend(settings.backend)});
        if (asked("cost")) runCosts(*context, settings, panoramas, report);
        if (asked("error")) runErrors(*context, settings, panoramas, report);
    }
    writeJson(settings.json, report);
}

}  // namespace

void addEnvironmentCommand(CLI::App& app) {
    CLI::App* sub =
        app.add_subcommand("environment", "time to prefilter, cost of the pass, error of each method");
    const auto settings = std::make_shared<Settings>();
    sub->add_option("--json", settings->json, "write the results here as well");
    sub->add_option("--backend", settings->backend, "auto, egl or osmesa");
    sub->add_option("--rounds", settings->rounds, "times that each is measured")->check(CLI::Range(1, 1000));
    sub->add_option("--env", settings->pictures,
                    "panoramas in place of those that are computed; may be repeated");
    sub->add_option("--only", settings->part, "one of the three: prefilter, cost, error")
        ->check(CLI::IsMember({"prefilter", "cost", "error"}));
    sub->add_option("--table", settings->table,
                    "write the errors here as a table in Markdown (docs/environment.md)");
    sub->callback([settings] { run(*settings); });
}

}  // namespace lobe::bench
