/// What can be set about a picture. One table: flags, -D keys, configuration files, batch files and the
/// documentation are all derived from it.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "image/image_files.hpp"
#include "image/tone.hpp"
#include "plan/aov.hpp"
#include "plan/quality.hpp"
#include "plan/summary.hpp"
#include "scene/load.hpp"

namespace lobe::app {

enum class SettingType { text, integer, real, choice, vector, colour, resolution, list, files, pairs };

struct Setting {
    std::string key;  ///< "tone_mapping"; its flag is "--tone-mapping"
    SettingType type;
    nlohmann::json defaultValue;  ///< null: not set (its meaning is in the help)
    std::string help;
    std::string group;
    std::vector<std::string> choices = {};  ///< for choice and list
    double minimum = 0.0, maximum = 0.0;    ///< for integer and real
    std::string unit = {};                  ///< "degrees", "s"; empty: none

    std::string flag() const;
    std::string valueName() const;    ///< "W,H", "NAME", "N": short, for --help
    std::string allowed() const;      ///< "1 to 100", "-90 to 90 degrees", "none|aces": for documentation
    std::string defaultText() const;  ///< "1280,720"; empty where there is none
};

const std::vector<Setting>& settingTable();
std::vector<std::string> settingKeys();
/// Throws UsageError "WHERE: unknown setting 'x'; did you mean 'y'?".
const Setting& requireSetting(const std::string& key, const std::string& where);

/// The canonical value of a setting from text ("1280x720") or JSON ([1280, 720]). Throws UsageError naming
/// `where`.
nlohmann::json parseSetting(const Setting& setting, const nlohmann::json& given, const std::string& where);

/// Values with their origin. Later layers win, but for values marked with a leading '!'.
class Settings {
public:
    Settings();  ///< built-in defaults
    /// `key` or `value` may start with '!': then only another '!' wins over it.
    void set(const std::string& key, const nlohmann::json& value, const std::string& origin);
    void setAll(const nlohmann::json& object, const std::string& origin);
    void reset(const std::string& key, const std::string& origin);

    const nlohmann::json& get(const std::string& key) const;
    nlohmann::json toJson() const;  ///< key -> value, those that are set
    /// "key = value (origin)" a line, with what it won over, for --verbose.
    std::string chain() const;

private:
    // json moves without throwing; the check cannot see it.
    struct Layer {  // NOLINT(bugprone-exception-escape)
        nlohmann::json value;
        std::string origin;
        bool forced = false;
    };
    struct Value {  // NOLINT(bugprone-exception-escape)
        Layer winner;
        std::vector<Layer> others;  ///< in the order in which they came
    };
    void put(const std::string& key, Layer layer);
    std::map<std::string, Value> values_;
};

// Typed readings of settings.
Quality qualityOf(const Settings& settings);     ///< the preset with the knobs that are set
nlohmann::json knobsOf(const Quality& quality);  ///< as the settings anti_aliasing, gbuffer_bits, ...
LoadOptions loadOptionsOf(const Settings& settings);
std::vector<ParameterOverride> parametersOf(const Settings& settings);  ///< of brdf_set
AovSet aovsOf(const Settings& settings);
ToneMapping toneMappingOf(const Settings& settings);
NormalsMode normalsOf(const Settings& settings);
struct Background {
    bool transparent = false;
    float color[3] = {0.0f, 0.0f, 0.0f};  ///< linear
};
Background backgroundOf(const Settings& settings);

}  // namespace lobe::app
