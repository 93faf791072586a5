#include "shading/brdf_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "base/byte_order_mark.hpp"
#include "base/error.hpp"
#include "shading/brdf_header.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostBytes = size_t{1} << 20;
constexpr size_t kMostParameters = 64;
/// Sharper than any normal format resolves: the planner then takes the finest.
constexpr double kUnknownSharpness = 1e9;

/// Comments as spaces, so that places in the text stay.
std::string withoutComments(std::string text) {
    for (size_t i = 0; i + 1 < text.size();) {
        const bool line = text.compare(i, 2, "//") == 0;
        if (!line && text.compare(i, 2, "/*") != 0) {
            ++i;
            continue;
        }
        const size_t close = text.find(line ? "\n" : "*/", i + 2);
        const size_t end = close == std::string::npos ? text.size() : close + (line ? 0 : 2);
        for (; i < end; ++i)
            if (text[i] != '\n') text[i] = ' ';
    }
    return text;
}

/// A word or a mark, and the line that it stands on.
struct Token {
    std::string_view text;
    int line = 1;
};

/// By hand: std::regex recurses once a letter, which long texts turn into a crash.
std::vector<Token> tokensOf(std::string_view code) {
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    std::vector<Token> tokens;
    int line = 1;
    for (size_t i = 0; i < code.size();) {
        size_t end = i + 1;
        if (isWord(code[i]))
            while (end < code.size() && isWord(code[end]))
                ++end;
        if (code[i] == '\n') ++line;
        if (std::isspace(static_cast<unsigned char>(code[i])) == 0)
            tokens.push_back({code.substr(i, end - i), line});
        i = end;
    }
    return tokens;
}

struct Field {
    std::string type, name;
    int line = 0;
};

/// What stands from `token`, behind a struct's opening brace, to the closing one; "vec3 a, b;" as two.
std::vector<Field> fieldsFrom(const std::vector<Token>& tokens, size_t token) {
    std::vector<Field> fields;
    std::string type;
    for (; token < tokens.size() && tokens[token].text != "}"; ++token) {
        const Token& t = tokens[token];
        if (t.text == ";")
            type.clear();
        else if (type.empty())
            type = t.text;
        else if (t.text != ",")
            fields.push_back({type, std::string(t.text), t.line});
    }
    return fields;
}

class Loader {
public:
    explicit Loader(const BrdfSource& source)
        : source_(source),
          code_(withoutComments(source.text)),
          tokens_(tokensOf(code_)),
          header_(parseBrdfHeader(source.text, source.file)) {
        brdf_.name = fs::path(source.file).stem().string();
        if (!std::regex_match(brdf_.name, std::regex("[a-z][a-z0-9]*(_[a-z0-9]+)*")) ||
            brdf_.name.size() > 64)
            throw InputError(
                source.file + ": '" + brdf_.name +
                "' is no name for a model; expected a file name of small letters, digits and single "
                "underscores, as my_model.glsl");
    }

    Brdf load() {
        brdf_.file = source_.file;
        brdf_.glsl = source_.text;
        brdf_.title = header_.title.empty() ? brdf_.name : header_.title;
        brdf_.source = header_.keys["source"];
        brdf_.traits.usesTangent = header_.keys["frame"].find("x = tangent") != std::string::npos;
        // Nothing is known of these, so nothing is claimed.
        brdf_.traits.reciprocal = brdf_.traits.energyConserving = brdf_.traits.anglesOnly = false;
        takeParameters();
        checkStruct();
        addFunctions();
        const double sharpness = header_.sharpness.value_or(kUnknownSharpness);
        brdf_.lobeSharpness = [sharpness](std::span<const double>) { return sharpness; };
        setImitation();
        return std::move(brdf_);
    }

private:
    [[noreturn]] void refuse(const std::string& what, int line = 0) const {
        throw InputError(source_.file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
    }

    void takeParameters() {
        if (header_.parameters.empty())
            refuse(
                "no header that declares parameters; expected lines such as \"/// params diffuse  0..1  per "
                "channel, no "
                "unit: reflectance\" at its start");
        if (header_.parameters.size() > kMostParameters)
            refuse(std::to_string(header_.parameters.size()) + " params; expected at most " +
                   std::to_string(kMostParameters));
        std::set<std::string> names{"model", "extras", "extensions"};
        std::set<std::string> taken;
        for (const HeaderParameter& declared : header_.parameters) {
            const Parameter& parameter = declared.parameter;
            if (parameter.kind == ParameterKind::table)
                refuse("params: " + parameter.glslName + ": only models that come with Lobe read tables",
                       declared.line);
            if (!names.insert(parameter.name).second ||
                (parameter.mayBeTextured && !names.insert(parameter.name + "Texture").second))
                refuse("params: " + parameter.glslName + ": the scene format's " + parameter.name +
                           " is taken; expected another name",
                       declared.line);
            if (!declared.takes.empty() && !taken.insert(declared.takes).second)
                refuse("params: " + parameter.glslName + ": another one takes " + declared.takes + " already",
                       declared.line);
            if (declared.takes == "base colour") brdf_.baseColorParameter = parameter.name;
            brdf_.parameters.push_back(parameter);
        }
        groupFresnel();
    }

    /// The four parameters of common/fresnel.glsl are the scene format's object "fresnel".
    void groupFresnel() {
        const auto kindOf = [&](const char* name) {
            const int index = brdf_.parameterIndex(name);
            return index < 0 ? std::optional<ParameterKind>()
                             : brdf_.parameters[static_cast<size_t>(index)].kind;
        };
        for (const char* name : {"f0", "eta", "k"})
            if (kindOf(name) != ParameterKind::rgb) return;
        const int type = brdf_.parameterIndex("fresnel");
        if (type < 0 || brdf_.parameters[static_cast<size_t>(type)].choices !=
                            std::vector<std::string>{"schlick", "dielectric", "conductor"})
            return;
        for (Parameter& parameter : brdf_.parameters)
            for (const char* name : {"fresnel", "f0", "eta", "k"})
                if (parameter.name == name) parameter.group = "fresnel";
    }

    void checkStruct() const {
        const std::string type = glslParameterType(brdf_);
        const size_t start = find({"struct", type, "{"});
        if (start == tokens_.size()) refuse("no struct " + type + "; expected " + glslParameterStruct(brdf_));
        const std::vector<Field> fields = fieldsFrom(tokens_, start + 3);
        for (size_t i = 0; i < fields.size(); ++i) {
            const std::string field = fields[i].type + " " + fields[i].name;
            const auto declares = [&](const Parameter& p) { return p.glslName == fields[i].name; };
            if (std::none_of(brdf_.parameters.begin(), brdf_.parameters.end(), declares))
                refuse("struct " + type + ": '" + field + "' is not among the header's params",
                       fields[i].line);
            if (i >= brdf_.parameters.size() ||
                field != std::string(glslType(brdf_.parameters[i].kind)) + " " + brdf_.parameters[i].glslName)
                refuse("struct " + type + ": '" + field + "' does not say what the header says; expected " +
                           glslParameterStruct(brdf_),
                       fields[i].line);
        }
        if (fields.size() < brdf_.parameters.size())
            refuse("struct " + type + " ends before the header's '" +
                       brdf_.parameters[fields.size()].glslName + "'; expected " + glslParameterStruct(brdf_),
                   tokens_[start].line);
    }

    /// Index of the first of these tokens where they follow each other; the number of tokens if nowhere.
    size_t find(const std::vector<std::string_view>& wanted) const {
        const auto found =
            std::search(tokens_.begin(), tokens_.end(), wanted.begin(), wanted.end(),
                        [](const Token& token, std::string_view text) { return token.text == text; });
        return static_cast<size_t>(found - tokens_.begin());
    }

    bool defines(const std::string& type, const std::string& function) const {
        return find({type, function, "("}) < tokens_.size();
    }

    const HeaderParameter* taking(const std::string& what) const {
        const auto found = std::find_if(header_.parameters.begin(), header_.parameters.end(),
                                        [&](const HeaderParameter& p) { return p.takes == what; });
        return found == header_.parameters.end() ? nullptr : &*found;
    }

    void addFunctions() {
        const std::string type = glslParameterType(brdf_);
        const std::string& name = brdf_.name;
        if (!defines("vec3", name + "_f_cos"))
            refuse("no function " + name + "_f_cos; expected vec3 " + name + "_f_cos(Dirs d, " + type +
                   " p)");
        if (!defines("vec3", name + "_ambient")) {
            const HeaderParameter* color = taking("base colour");
            brdf_.glslSubstitutes += "vec3 " + name + "_ambient(" + type + " p) { return " +
                                     (color != nullptr ? "p." + color->parameter.glslName : "vec3(0.0)") +
                                     "; }\n";
        }
        if (!defines("float", name + "_roughness")) {
            const HeaderParameter* roughness = taking("roughness");
            brdf_.glslSubstitutes +=
                "float " + name + "_roughness(" + type + " p) { return " +
                (roughness != nullptr ? "clamp(p." + roughness->parameter.glslName + ", 0.0, 1.0)" : "0.5") +
                "; }\n";
        }
    }

    /// The defaults, with what the header says is taken from glTF's surface, moved into the parameter's
    /// range.
    void setImitation() {
        struct Take {
            size_t offset;
            std::string what;
            double minimum, maximum;
        };
        std::vector<Take> takes;
        for (size_t i = 0; i < header_.parameters.size(); ++i)
            if (const HeaderParameter& p = header_.parameters[i]; !p.takes.empty())
                takes.push_back({static_cast<size_t>(brdf_.valueOffset(static_cast<int>(i))), p.takes,
                                 p.parameter.minimum, p.parameter.maximum});
        brdf_.fromMetallicRoughness = [takes, defaults = brdf_.defaults()](const MetallicRoughness& surface) {
            ParameterValues values = defaults;
            for (const Take& take : takes) {
                if (take.what != "base colour") {
                    const double value = take.what == "metallic" ? surface.metallic : surface.roughness;
                    values[take.offset] = std::clamp(value, take.minimum, take.maximum);
                    continue;
                }
                for (int c = 0; c < 3; ++c)
                    values[take.offset + static_cast<size_t>(c)] =
                        std::clamp(surface.baseColor[c], take.minimum, take.maximum);
            }
            return values;
        };
    }

    const BrdfSource& source_;
    std::string code_;
    std::vector<Token> tokens_;  ///< of code_
    BrdfHeader header_;
    Brdf brdf_;
};

}  // namespace

BrdfSource readBrdfSource(const fs::path& file) {
    std::error_code failed;
    const fs::file_status status = fs::status(file, failed);
    if (!fs::exists(status))
        throw InputError(file.string() + ": no such file; expected a reflectance model in GLSL");
    if (!fs::is_regular_file(status))
        throw InputError(file.string() + ": is no regular file; expected a reflectance model in GLSL");
    std::ifstream stream(file, std::ios::binary);
    BrdfSource source{file.string(), {}};
    if (stream && fs::file_size(file, failed) <= kMostBytes && !failed)
        source.text = withoutByteOrderMark({std::istreambuf_iterator<char>(stream), {}});
    else
        throw InputError(file.string() + (stream ? ": is larger than 1 MiB" : ": cannot be read") +
                         "; expected a reflectance model in GLSL");
    return source;
}

Brdf brdfFromSource(const BrdfSource& source) {
    return Loader(source).load();
}

}  // namespace lobe
