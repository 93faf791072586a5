#include <algorithm>
#include <array>
#include <charconv>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "gl/context.hpp"
#include "plan/knobs.hpp"
#include "settings.hpp"
#include "shading/brdf.hpp"

namespace lobe::app {
namespace {

/// As few digits as give the number back.
std::string shortest(double value) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
    return {text.data(), end};
}

}  // namespace

std::string Setting::flag() const {
    std::string name = "--" + key;
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

std::string Setting::valueName() const {
    switch (type) {
        case SettingType::text:
            return key == "env" ? "FILE" : "NAME";
        case SettingType::integer:
        case SettingType::real:
            return "N";
        case SettingType::vector:
            return "X,Y,Z";
        case SettingType::colour:
            return "R,G,B";
        case SettingType::resolution:
            return "W,H";
        case SettingType::list:
            return "NAME,...";
        case SettingType::files:
            return "FILE";
        case SettingType::pairs:
            return "NAME=VALUE";
        case SettingType::choice:
            break;
    }
    if (key == "brdf") return "MODEL";  // as many as there are, and more with each version
    std::string names;
    for (const std::string& choice : choices)
        names += (names.empty() ? "" : "|") + choice;
    return names;
}

std::string Setting::allowed() const {
    if (type == SettingType::integer || type == SettingType::real)
        return shortest(minimum) + " to " + shortest(maximum) + (unit.empty() ? "" : " " + unit);
    if (type != SettingType::list) return valueName() + (unit.empty() ? "" : " " + unit);
    std::string names;
    for (const std::string& choice : choices)
        names += (names.empty() ? "" : ",") + choice;
    return names;
}

std::string Setting::defaultText() const {
    if (defaultValue.is_null()) return {};
    if (defaultValue.is_number()) return shortest(defaultValue.get<double>());
    std::string text = defaultValue.is_string() ? defaultValue.get<std::string>() : defaultValue.dump();
    std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == '"'; });
    return text;
}

namespace {

/// A quality knob as a setting.
Setting settingOf(const Knob& knob) {
    Setting setting{knob.name, knob.range ? SettingType::integer : SettingType::choice,
                    nullptr,   knob.help,
                    "Quality", {}};
    if (knob.range) {
        setting.minimum = knob.range->first;
        setting.maximum = knob.range->second;
    } else {
        setting.choices = knob.values;
    }
    return setting;
}

std::vector<Setting> makeTable() {
    using enum SettingType;
    std::vector<Setting> table = {
        {"output", text, nullptr,
         "file to write; {model} {camera} {n:3} {frame:4} {date} {brdf} {quality} and ### are filled in; - "
         "is standard output (PNG). "
         "Default out/{model}.png, with frames out/{model}_{frame:4}.png",
         "Output"},
        {"resolution",
         resolution,
         {1280, 720},
         "picture size; also 1280x720, and -r W H",
         "Output",
         {},
         0.0,
         0.0,
         "pixels"},
        {"aov", list, {"radiance"}, "quantities to write as layers of one EXR file", "Output", aovNames()},
        {"exr_precision", choice, "half", "bits of EXR channels", "Output", {"half", "float"}},
        {"jpeg_quality", integer, 92, "quality of JPEG files", "Output", {}, 1, 100},

        {"camera", text, nullptr,
         "camera of the scene, by name or index; default the first, or one that frames the scene", "Camera"},
        {"camera_position", vector, nullptr, "eye in world space", "Camera", {}, 0.0, 0.0, "m"},
        {"camera_focal_point",
         vector,
         nullptr,
         "what camera_position looks at; default the centre of the scene",
         "Camera",
         {},
         0.0,
         0.0,
         "m"},
        {"camera_view_angle",
         real,
         nullptr,
         "vertical field of view; default the camera's own, or 45",
         "Camera",
         {},
         0.01,
         179.0,
         "degrees"},
        {"camera_azimuth",
         real,
         nullptr,
         "frame the scene from this side, from the front (0) to the right",
         "Camera",
         {},
         -360.0,
         360.0,
         "degrees"},
        {"camera_elevation",
         real,
         nullptr,
         "frame the scene from this height above the horizon",
         "Camera",
         {},
         -90.0,
         90.0,
         "degrees"},
        {"frames", integer, 1, "number of pictures of a turntable", "Camera", {}, 1, 1000000},
        {"orbit",
         real,
         0.0,
         "angle that the camera turns over all frames; 360 closes the circle",
         "Camera",
         {},
         -36000.0,
         36000.0,
         "degrees"},

        {"time", real, 0.0, "pose animations at this time", "Scene", {}, 0.0, 1e6, "s"},
        {"normals",
         choice,
         "file",
         "missing normals: flat as glTF says, or averaged (smooth); flat: always flat",
         "Scene",
         {"file", "smooth", "flat"}},
        {"brdf", choice, nullptr,
         "shading model for all materials, one of those in docs/models; default each material's own", "Scene",
         brdfNames()},
        {"brdf_file", files, nullptr,
         "GLSL file of a shading model of your own, for all materials unless some name it; may be repeated "
         "(docs/how_to/add_a_brdf.md)",
         "Scene"},
        {"brdf_set", pairs, nullptr,
         "value of a parameter in all materials whose model has it, as m=0.2, diffuse=0.8,0.2,0.1 or "
         "metal=gold; "
         "may be repeated",
         "Scene"},

        {"bands",
         integer,
         3,
         "bands of wavelength in which metals that are named reflect; 3 is red, green and blue "
         "(docs/bands.md)",
         "Scene",
         {},
         3,
         64},

        {"env", text, nullptr,
         "picture of the environment that lights the scene, in place of its own: equirectangular, a cube "
         "unfolded "
         "as a cross, or, as a folder or a name with *, six faces px nx py ny pz nz (docs/environment.md)",
         "Scene"},
        {"env_rotation",
         real,
         0.0,
         "turns the environment about the vertical, counter-clockwise as seen from above",
         "Scene",
         {},
         -36000.0,
         36000.0,
         "degrees"},
        {"env_intensity", real, 1.0, "multiplies the environment's radiance", "Scene", {}, 0.0, 1e6},
        {"env_background",
         choice,
         nullptr,
         "the environment behind surfaces; default as the scene says, else show",
         "Scene",
         {"show", "blur", "hide"}},

        {"quality", choice, "balanced", "preset of the knobs below; a knob that is set wins over it",
         "Quality", qualityPresetNames()},

        {"exposure",
         real,
         0.0,
         "EV: radiance is multiplied by 2 to this power before the tone curve",
         "Display",
         {},
         -40.0,
         40.0,
         "stops"},
        {"tone_mapping", choice, "none", "tone curve of PNG and JPEG", "Display", toneMappingNames()},
        {"background", colour, "0,0,0",
         "sRGB as R,G,B from 0 to 1 or #rrggbb, or transparent (PNG); EXR and HDR keep radiance on black",
         "Display"},

        {"backend", choice, "auto", "how the OpenGL context is made", "Device", gl::backendNames()},
        {"device", integer, -1, "EGL device, as lobe info numbers them; -1 any", "Device", {}, -1, 255},
    };
    auto place =
        std::find_if(table.begin(), table.end(), [](const Setting& s) { return s.key == "quality"; });
    for (const Knob& knob : knobTable())
        place = table.insert(place + 1, settingOf(knob));
    return table;
}

}  // namespace

const std::vector<Setting>& settingTable() {
    static const std::vector<Setting> table = makeTable();
    return table;
}

std::vector<std::string> settingKeys() {
    std::vector<std::string> keys;
    for (const Setting& setting : settingTable())
        keys.push_back(setting.key);
    return keys;
}

const Setting& requireSetting(const std::string& key, const std::string& where) {
    std::string folded = key;
    std::replace(folded.begin(), folded.end(), '-', '_');
    for (const Setting& setting : settingTable())
        if (setting.key == folded) return setting;
    throw UsageError(where + ": unknown setting '" + key + "'" + didYouMean(key, settingKeys()));
}

}  // namespace lobe::app
