/// SceneSummary x Quality x Capabilities -> FramePlan: what runs, in which variant, into which targets, and what is
/// left out, each with its reason. Pure: no OpenGL, no files.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plan/aov.hpp"
#include "plan/capabilities.hpp"
#include "plan/quality.hpp"
#include "plan/summary.hpp"

namespace lobe {

/// A texture or buffer of the frame, by what it holds.
struct Channel {
    std::string name;     ///< "depth", "normal", "material", "parameters0", "radiance"
    std::string format;   ///< GL name: "RG16", "RGBA32F", "DEPTH_COMPONENT32F"
    int bytesPerPixel = 0;
    std::string holds;    ///< for people: "octahedral shading normal", "baseColor.rgb, roughness"
    std::string reason;   ///< why it is there and why in this format
};

/// Where a parameter that varies within a material is kept in the G-buffer.
struct ParameterPlace {
    int parameter = -1;   ///< index in Brdf::parameters
    int target = 0;       ///< parameters0, parameters1, ...
    int component = 0;    ///< first component in that target
};

struct PlannedPass {
    std::string name;                        ///< "gbuffer", "light.point", "forward", ...
    std::string program;                     ///< shader file, "" for passes without one
    std::vector<std::string> variants;       ///< one a compiled program: sorted "KEY" or "KEY=value" separated by ' '
    std::vector<std::string> reads, writes;  ///< channel names
    std::string reason;                      ///< why it runs
};

struct LeftOut {
    std::string kind;    ///< "pass", "channel", "variant", "texture", "buffer"
    std::string name;
    std::string reason;
};

/// One model of the scene as the lighting passes see it.
struct PlannedBrdf {
    std::string name;                        ///< registry name, or "unlit"
    int stencil = 0;                         ///< mask value; 0 when the scene has one model only
    std::vector<ParameterPlace> places;      ///< parameters that are read from the G-buffer, others from the table
};

struct FramePlan {
    Quality quality;
    int samples = 1;
    bool reversedDepth = true;    ///< needs clip control; otherwise linear z in a channel of its own
    bool clusteredPoint = false, clusteredSpot = false;
    std::vector<PlannedBrdf> brdfs;
    std::vector<Channel> channels;
    std::vector<PlannedPass> passes;
    std::vector<LeftOut> leftOut;
    std::vector<std::string> lightGroups;  ///< for people: "point: 100 lights in clusters of 64 px x 24 slices"
    std::vector<std::string> textures;     ///< for people: one line a texture kept, with format and user
    std::vector<std::string> notes;        ///< decisions that are neither kept nor left out: background, camera, ...

    bool hasPass(std::string_view name) const;
    const Channel* channel(std::string_view name) const;
};

FramePlan planFrame(const SceneSummary& summary, const Quality& quality, const Capabilities& capabilities,
                    const AovSet& aovs = {Aov::radiance});

std::string toText(const FramePlan& plan);  ///< for `lobe plan`
std::string toJson(const FramePlan& plan);  ///< schema: docs/plan.schema.json; key "schema": 1

}  // namespace lobe
