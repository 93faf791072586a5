#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "gl/program.hpp"

namespace lobe::gl {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 32;
constexpr int kVersion = 330;

/// The word after '#' and what follows it.
struct Directive {
    std::string word, rest;
};

Directive directiveIn(const std::string& line) {
    size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') return {};
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos) return {};
    const size_t end = std::min(line.find_first_not_of("abcdefghijklmnopqrstuvwxyz", at), line.size());
    return {line.substr(at, end - at), line.substr(end)};
}

/// As people would name it.
std::string shownPath(const fs::path& path) {
    std::error_code failed;
    const fs::path relative = fs::relative(path, failed);
    const bool below = !failed && !relative.empty() && *relative.begin() != "..";
    return (below ? relative : path).generic_string();
}

/// Expands includes, remembering where each line came from.
class Expansion {
public:
    Expansion(const std::vector<fs::path>& folders, bool ofFiles,
              const std::map<std::string, std::string>& generated, ShaderSource& out)
        : folders_(folders), ofFiles_(ofFiles), generated_(generated), out_(out) {}

    void emit(const std::string& line, const std::string& file, int number) {
        out_.text += line + "\n";
        out_.places.push_back({file, number});
    }

    void expand(const std::string& name, const std::string& from, const fs::path& includer = {}) {
        const Found found = find(name, from, includer);
        if (chain_.size() >= kMaxDepth)
            throw ShaderError(from + ": includes nest deeper than " + std::to_string(kMaxDepth));
        for (const std::string& open : chain_)
            if (open == found.name)
                throw ShaderError(from + ": " + found.name + " includes itself, by way of " + chain_.back());
        if (!taken_.insert(found.name).second) return;
        chain_.push_back(found.name);
        std::istringstream lines(read(found));
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            if (!line.empty() && line.back() == '\r') line.pop_back();
            const std::string place = found.name + ":" + std::to_string(number);
            const Directive directive = inComment_ ? Directive{} : directiveIn(line);
            if (directive.word == "include")
                expand(includedBy(line, directive, place), place, found.path.parent_path());
            else if (!ofFiles_ || !hoist(directive, line, found.name, number))
                emit(line, found.name, number);
            inComment_ = commentAfter(line);
        }
        if (inComment_) throw ShaderError(found.name + ": a block comment is not closed");
        chain_.pop_back();
    }

    /// Puts the version, the extensions and the defines before what was expanded.
    void finish(const Defines& defines) {
        ShaderSource body = std::move(out_);
        out_ = {};
        emit("#version " + std::to_string(version_) + " core", "(version)", 1);
        for (const auto& [line, place] : extensions_)
            emit(line, place.file, place.line);
        int number = 0;
        for (const auto& [key, value] : defines)
            emit("#define " + key + " " + value, "(defines)", ++number);
        out_.text += body.text;
        out_.places.insert(out_.places.end(), body.places.begin(), body.places.end());
        out_.files = std::move(body.files);
    }

private:
    struct Found {
        std::string name;  ///< for messages; one a file
        fs::path path;     ///< empty if generated
    };

    Found find(const std::string& name, const std::string& from, const fs::path& includer) const {
        const std::string normal = fs::path(name).lexically_normal().generic_string();
        if (generated_.contains(normal)) return {normal, {}};
        std::vector<fs::path> places;
        if (ofFiles_ && (!includer.empty() || fs::path(name).is_absolute())) places.push_back(includer);
        places.insert(places.end(), folders_.begin(), folders_.end());
        std::string tried;
        std::error_code ignored;
        for (const fs::path& place : places) {
            const fs::path path = place / normal;
            if (fs::is_regular_file(path, ignored)) {
                if (!ofFiles_) return {normal, path};
                const fs::path canonical = fs::canonical(path, ignored);
                return {shownPath(canonical.empty() ? path : canonical), path};
            }
            tried += (tried.empty() ? "" : ", ") + place.string();
        }
        throw ShaderError(from + ": shader file " + normal + " not found in " + tried);
    }

    std::string read(const Found& found) {
        if (found.path.empty()) return generated_.at(found.name);
        std::ifstream stream(found.path, std::ios::binary);
        if (!stream) throw ShaderError(found.name + ": can't be read");
        std::ostringstream text;
        text << stream.rdbuf();
        out_.files.push_back(found.path);
        return text.str();
    }

    /// The name in `#include "NAME"`.
    static std::string includedBy(const std::string& line, const Directive& directive,
                                  const std::string& place) {
        const size_t open = directive.rest.find('"');
        const size_t close = open == std::string::npos ? open : directive.rest.find('"', open + 1);
        if (close == std::string::npos || close == open + 1)
            throw ShaderError(place + ": " + line + "; expected #include \"FILE\"");
        return directive.rest.substr(open + 1, close - open - 1);
    }

    /// Whether the line was one that has its place at the top, or none.
    bool hoist(const Directive& directive, const std::string& line, const std::string& file, int number) {
        if (directive.word == "extension") {
            const bool includes = line.find("include") != std::string::npos;  // done here
            if (!includes) extensions_.push_back({line, {file, number}});
        } else if (directive.word == "version") {
            std::istringstream words(directive.rest);
            int version = 0;
            std::string profile;
            words >> version >> profile;
            if (version < 100 || (!profile.empty() && profile != "core" && !profile.starts_with("//")))
                throw ShaderError(file + ":" + std::to_string(number) + ": " + line +
                                  "; expected a version of desktop GLSL's core profile, such as 330");
            version_ = std::max(version_, version);
        } else if (directive.word != "line") {
            return false;
        }
        emit("", file, number);
        return true;
    }

    bool commentAfter(const std::string& line) const {
        bool inside = inComment_;
        for (size_t i = 0; i + 1 < line.size(); ++i) {
            if (!inside && line.compare(i, 2, "//") == 0) return false;
            if (line.compare(i, 2, inside ? "*/" : "/*") == 0) {
                inside = !inside;
                ++i;  // "/*/" opens and does not close
            }
        }
        return inside;
    }

    const std::vector<fs::path>& folders_;
    bool ofFiles_;
    const std::map<std::string, std::string>& generated_;
    ShaderSource& out_;
    std::set<std::string> taken_;
    std::vector<std::string> chain_;
    std::vector<std::pair<std::string, ShaderSource::Place>> extensions_;
    int version_ = kVersion;
    bool inComment_ = false;
};

}  // namespace

ShaderLibrary::ShaderLibrary(fs::path root) : folders_{std::move(root)} {}

ShaderLibrary ShaderLibrary::ofFiles(std::vector<fs::path> folders) {
    ShaderLibrary library{fs::path()};
    library.folders_ = std::move(folders);
    library.ofFiles_ = true;
    return library;
}

ShaderSource ShaderLibrary::source(const std::string& file, const Defines& defines,
                                   const std::map<std::string, std::string>& generated) const {
    ShaderSource result;
    Expansion expansion(folders_, ofFiles_, generated, result);
    expansion.expand(file, "(program)");
    expansion.finish(defines);
    return result;
}

}  // namespace lobe::gl
