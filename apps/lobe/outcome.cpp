#include "outcome.hpp"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

namespace lobe::app {

double peakMemoryMib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string toJson(const Outcome& outcome, const std::string& backend, const std::string& renderer) {
    nlohmann::ordered_json line;
    line["schema"] = 1;
    line["output"] = outcome.shot.output;
    line["scene"] = outcome.shot.scene.string();
    line["status"] = outcome.error ? "failed" : outcome.skipped ? "skipped" : "done";
    if (outcome.error) {
        line["exit_code"] = static_cast<int>(*outcome.error);
        line["error"] = outcome.message;
    }
    line["camera"] = outcome.camera;
    line["frame"] = outcome.shot.frame;
    line["resolution"] = outcome.shot.settings->get("resolution");
    line["milliseconds"] = {{"load", outcome.loadMs},
                            {"upload", outcome.uploadMs},
                            {"render", outcome.renderMs},
                            {"encode", outcome.encodeMs}};
    line["pass_milliseconds"] = nlohmann::ordered_json::object();
    for (const PassTime& pass : outcome.passes)
        line["pass_milliseconds"][pass.pass] = pass.milliseconds;
    line["peak_memory_mib"] = peakMemoryMib();
    line["non_finite_pixels"] = outcome.nonFinite.pixels;
    line["backend"] = backend;
    line["renderer"] = renderer;
    line["warnings"] = outcome.warnings;
    return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);  // paths need not be UTF-8
}

}  // namespace lobe::app
