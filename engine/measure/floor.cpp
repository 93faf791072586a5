#include "measure/floor.hpp"

#include <algorithm>

#include "base/resources.hpp"
#include "gl/program.hpp"
#include "gl/timer.hpp"
#include "passes/targets.hpp"

namespace lobe::measure {
namespace {

bool isInteger(const Channel& channel) {
    return channel.format.ends_with("UI");
}

/// Reads every channel that a pass reads once, and writes every one that it writes.
std::string floorShader(const FramePlan& plan, const std::vector<std::string>& reads,
                        const std::vector<std::string>& colors) {
    std::string uniforms, outputs, body = "    float sum = 0.0;\n";
    for (size_t i = 0; i < reads.size(); ++i) {
        const std::string n = std::to_string(i);
        const bool integer = isInteger(*plan.channel(reads[i]));
        uniforms += std::string("uniform ") + (integer ? "usampler2D" : "sampler2D") + " uRead" + n + ";\n";
        body += "    sum += float(texelFetch(uRead" + n + ", ivec2(gl_FragCoord.xy), 0).x);\n";
    }
    for (size_t i = 0; i < colors.size(); ++i) {
        const std::string n = std::to_string(i);
        const bool integer = isInteger(*plan.channel(colors[i]));
        outputs += "layout(location = " + n + ") out " + (integer ? "uvec4" : "vec4") + " oWrite" + n + ";\n";
        body += "    oWrite" + n + " = " + (integer ? "uvec4(uint(sum))" : "vec4(sum)") + ";\n";
    }
    return uniforms + outputs + "void main()\n{\n" + body + "}\n";
}

}  // namespace

std::map<std::string, double> floorTimes(const FramePlan& plan, const gl::ContextInfo& info, int width,
                                         int height, int runs) {
    const Targets targets(plan, width, height);
    const gl::ShaderLibrary library(shaderDirectory());
    const gl::VertexArray empty = gl::VertexArray::make();
    glBindVertexArray(empty.id());
    glViewport(0, 0, width, height);
    std::map<std::string, double> result;
    for (const PlannedPass& pass : plan.passes) {
        if (pass.name == "accumulate" || pass.name == "aov" || pass.name == "forward" || pass.name == "peel")
            continue;
        const bool geometry = pass.name == "gbuffer";
        std::vector<std::string> colors = pass.writes;
        std::erase(colors, "depth");
        // Shadow maps have a size of their own: passes that draw them have no floor here, those that read
        // them the one without.
        if (!std::ranges::all_of(colors, [&](const std::string& c) { return targets.has(c); })) continue;
        std::vector<std::string> reads = pass.reads;
        std::erase_if(reads, [&](const std::string& c) { return !targets.has(c); });
        const std::map<std::string, std::string> generated = {
            {"generated/floor.frag", floorShader(plan, reads, colors)}};
        const gl::Program program(library.source("pass/screen.vert", {}),
                                  library.source("generated/floor.frag", {}, generated), "floor");
        double best = 1e30;
        for (int run = 0; run < runs; ++run) {
            glBindFramebuffer(GL_FRAMEBUFFER,
                              geometry ? targets.gbuffer() : targets.lighting(colors.front()));
            program.use();
            program.set("uFarDepth", 0.5f);
            for (size_t i = 0; i < reads.size(); ++i) {
                glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
                glBindTexture(GL_TEXTURE_2D, targets.texture(reads[i]));
                glBindSampler(static_cast<GLuint>(i), 0);
                program.set("uRead" + std::to_string(i), static_cast<int>(i));
            }
            gl::PassTimer timer(info.reliableTimers);
            timer.start();
            if (geometry) {
                // What the G-buffer pass does beside drawing belongs to its floor: clearing depth, writing
                // it.
                glEnable(GL_DEPTH_TEST);
                glDepthMask(GL_TRUE);
                glDepthFunc(GL_ALWAYS);
                glClear(GL_DEPTH_BUFFER_BIT);
            } else {
                glEnable(GL_BLEND);
                glBlendFunc(GL_ONE, GL_ONE);
            }
            glDrawArrays(GL_TRIANGLES, 0, 3);
            if (geometry) targets.copyMask();
            timer.mark("floor");
            glDisable(GL_BLEND);
            glDisable(GL_DEPTH_TEST);
            const auto times = timer.finish();
            if (run > 0) best = std::min(best, times.front().second);  // the first run compiles
        }
        result[pass.name] = best;
    }
    return result;
}

}  // namespace lobe::measure
