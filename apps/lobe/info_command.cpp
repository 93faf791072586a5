// lobe info: the ways to an OpenGL context here, and what each offers.
#include <iostream>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "gl/context.hpp"

namespace lobe::app {
namespace {

nlohmann::ordered_json toJson(const gl::Candidate& candidate) {
    nlohmann::ordered_json entry = {{"backend", gl::backendNames()[static_cast<size_t>(candidate.backend)]},
                                    {"platform", candidate.platform},
                                    {"device", candidate.device},
                                    {"usable", candidate.info.has_value()}};
    if (!candidate.info) {
        entry["failure"] = candidate.failure;
        return entry;
    }
    const gl::ContextInfo& info = *candidate.info;
    entry["renderer"] = info.renderer;
    entry["vendor"] = info.vendor;
    entry["version"] = info.version;
    entry["glsl_version"] = info.glslVersion;
    entry["software"] = info.software;
    entry["clip_control"] = info.clipControl;
    entry["anisotropic_filter"] = info.anisotropicFilter;
    entry["debug_output"] = info.debugOutput;
    entry["gpu_timers"] = info.reliableTimers;
    entry["limits"] = {{"texture_size", info.maxTextureSize},
                       {"array_layers", info.maxArrayLayers},
                       {"color_attachments", info.maxColorAttachments},
                       {"draw_buffers", info.maxDrawBuffers},
                       {"texture_buffer_texels", info.maxTextureBufferTexels},
                       {"uniform_block_bytes", info.maxUniformBlockSize},
                       {"fragment_uniform_components", info.maxFragmentUniformComponents},
                       {"samples", info.maxSamples}};
    return entry;
}

void print(const gl::Candidate& candidate) {
    std::cout << gl::backendNames()[static_cast<size_t>(candidate.backend)] << ' ' << candidate.platform
              << '\n';
    if (!candidate.info) {
        std::cout << "  not usable: " << candidate.failure << '\n';
        return;
    }
    const gl::ContextInfo& info = *candidate.info;
    std::cout << "  renderer  " << info.renderer << " (" << info.vendor << ")"
              << (info.software ? ", software" : ", hardware") << '\n'
              << "  version   OpenGL " << info.version << ", GLSL " << info.glslVersion << '\n'
              << "  offers    clip control " << (info.clipControl ? "yes" : "no") << ", anisotropic filter "
              << (info.anisotropicFilter ? "yes" : "no") << ", debug output "
              << (info.debugOutput ? "yes" : "no") << ", GPU timers " << (info.reliableTimers ? "yes" : "no")
              << '\n'
              << "  limits    texture " << info.maxTextureSize << ", layers " << info.maxArrayLayers
              << ", colour targets " << info.maxColorAttachments << ", texture buffer "
              << info.maxTextureBufferTexels << " texels, uniform block " << info.maxUniformBlockSize
              << " B, samples " << info.maxSamples << '\n';
}

}  // namespace

int infoCommand(const std::vector<std::string>& list) {
    Arguments arguments("info", "List the ways to an OpenGL context that were found, and what each offers.");
    bool json = false;
    arguments.app().add_flag("--json", json, "for programs");
    if (!arguments.parse(list)) return 0;
    const std::vector<gl::Candidate> candidates = gl::probe();
    bool usable = false;
    nlohmann::ordered_json all = {{"schema", 1}, {"contexts", nlohmann::ordered_json::array()}};
    for (const gl::Candidate& candidate : candidates) {
        usable |= candidate.info.has_value();
        if (json)
            all["contexts"].push_back(toJson(candidate));
        else
            print(candidate);
    }
    if (json) std::cout << all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    if (!usable) throw ContextError("no OpenGL 3.3 context can be made here");
    return 0;
}

}  // namespace lobe::app
