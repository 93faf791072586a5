// The plan for people (`lobe plan`) and for programs (`lobe plan --json`).
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "plan/plan.hpp"

namespace lobe {
namespace {

std::string joined(const std::vector<std::string>& parts, const char* separator) {
    std::string text;
    for (const std::string& part : parts)
        text += (text.empty() ? "" : separator) + part;
    return text;
}

std::string definesText(const std::map<std::string, std::string>& defines) {
    std::vector<std::string> parts;
    for (const auto& [key, value] : defines)
        parts.push_back(value == "1" ? key : key + "=" + value);
    return joined(parts, " ");
}

/// Variants of one model that differ in defines are listed by what they do not share.
void writePass(std::ostringstream& out, const PlannedPass& pass) {
    out << "  " << pass.name << ": " << pass.reason << '\n';
    if (!pass.reads.empty()) out << "      reads  " << joined(pass.reads, ", ") << '\n';
    out << "      writes " << joined(pass.writes, ", ") << '\n';
    for (const Variant& variant : pass.variants) {
        if (variant.brdf.empty()) continue;
        out << "      program " << pass.program << " [" << variant.brdf << "] "
            << definesText(variant.defines) << '\n';
    }
}

}  // namespace

std::string toText(const FramePlan& plan) {
    std::ostringstream out;
    out << "Kept\n";
    out << "passes (" << plan.samples << (plan.samples == 1 ? " sample" : " samples") << " a pixel)\n";
    for (const PlannedPass& pass : plan.passes)
        writePass(out, pass);
    out << "channels (G-buffer: " << plan.gbufferBytesPerPixel() << " bytes a pixel)\n";
    for (const Channel& channel : plan.channels)
        out << "  " << channel.name << ' ' << channel.format << " (" << channel.bytesPerPixel
            << " B): " << channel.holds << "; " << channel.reason << '\n';
    const auto list = [&out](const char* title, const std::vector<std::string>& lines) {
        if (lines.empty()) return;
        out << title << '\n';
        for (const std::string& line : lines)
            out << "  " << line << '\n';
    };
    list("lights", plan.lightGroups);
    list("textures", plan.textures);
    list("notes", plan.notes);
    out << "Left out\n";
    for (const LeftOut& leftOut : plan.leftOut)
        out << "  " << leftOut.kind << ' ' << leftOut.name << ": " << leftOut.reason << '\n';
    return out.str();
}

std::string toJson(const FramePlan& plan) {
    using nlohmann::json;
    json result;
    result["schema"] = 1;
    result["samples"] = plan.samples;
    result["reversed_depth"] = plan.reversedDepth;
    result["gbuffer_bytes_per_pixel"] = plan.gbufferBytesPerPixel();
    for (const char* key : {"passes", "channels", "left_out", "lights", "textures", "notes"})
        result[key] = json::array();
    for (const PlannedPass& pass : plan.passes) {
        json variants = json::array();
        for (const Variant& variant : pass.variants)
            variants.push_back({{"brdf", variant.brdf}, {"defines", variant.defines}});
        result["passes"].push_back({{"name", pass.name},
                                    {"program", pass.program},
                                    {"variants", variants},
                                    {"reads", pass.reads},
                                    {"writes", pass.writes},
                                    {"reason", pass.reason}});
    }
    for (const Channel& channel : plan.channels)
        result["channels"].push_back({{"name", channel.name},
                                      {"format", channel.format},
                                      {"bytes_per_pixel", channel.bytesPerPixel},
                                      {"holds", channel.holds},
                                      {"reason", channel.reason}});
    for (const LeftOut& leftOut : plan.leftOut)
        result["left_out"].push_back(
            {{"kind", leftOut.kind}, {"name", leftOut.name}, {"reason", leftOut.reason}});
    result["lights"] = plan.lightGroups;
    result["textures"] = plan.textures;
    result["notes"] = plan.notes;
    return result.dump(2);
}

}  // namespace lobe
