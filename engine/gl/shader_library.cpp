#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "base/byte_order_mark.hpp"
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
              const std::map<std::string, std::string>& generated,
              const std::map<std::string, ShaderLibrary::Mounted>& mounted, ShaderSource& out)
        : folders_(folders), ofFiles_(ofFiles), generated_(generated), mounted_(mounted), out_(out) {}

    void emit(const std::string& line, const std::string& file, int number) {
        out_.text += line + "\n";
        out_.places.push_back({file, number});
    }

    /// `folder`: that the include's own file is looked for in first; empty in the library.
    void expand(const std::string& name, const std::string& from, const fs::path& folder = {}) {
        const Found found = find(name, from, folder);
        if (chain_.size() >= kMaxDepth)
            throw ShaderError(from + ": includes nest deeper than " + std::to_string(kMaxDepth));
        for (const std::string& open : chain_)
            if (open == found.name)
                throw ShaderError(from + ": " + found.name + " includes itself, by way of " + chain_.back());
        if (taken_.contains(found.name)) return;
        if (!found.path.empty()) out_.files.push_back(found.path);
        // Whether a file under #if was taken in is for the preprocessor to say.
        const bool perhaps = conditions_ > 0;
        if (!perhaps) taken_.insert(found.name);
        const bool guarded = perhaps || perhapsTaken_.contains(found.name);
        if (!guarded) return lines(found);
        const auto guard = perhapsTaken_.try_emplace(found.name, perhapsTaken_.size()).first->second;
        const std::string macro = "LOBE_TAKEN_" + std::to_string(guard);
        emit("#ifndef " + macro, found.name, 1);
        emit("#define " + macro, found.name, 1);
        ++conditions_;
        lines(found);
        --conditions_;
        emit("#endif", found.name, 1);
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
        std::string name;  ///< for messages; tells files apart
        std::string text;
        fs::path folder;  ///< that its own includes are looked for in first
        fs::path path;    ///< empty if generated or mounted
    };

    void lines(const Found& found) {
        chain_.push_back(found.name);
        std::istringstream lines(found.text);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            if (!line.empty() && line.back() == '\r') line.pop_back();
            const std::string place = found.name + ":" + std::to_string(number);
            const Directive directive = inComment_ ? Directive{} : directiveIn(line);
            if (directive.word == "include")
                expand(includedBy(line, directive, place), place, found.folder);
            else if (!ofFiles_ || !hoist(directive, line, found.name, number))
                emit(line, found.name, number);
            conditions_ += directive.word.starts_with("if") ? 1 : directive.word == "endif" ? -1 : 0;
            inComment_ = commentAfter(line);
        }
        if (inComment_) throw ShaderError(found.name + ": a block comment is not closed");
        chain_.pop_back();
    }

    Found find(const std::string& name, const std::string& from, const fs::path& folder) const {
        const fs::path normal = fs::path(name).lexically_normal();
        const std::string file = normal.generic_string();
        if (const auto found = generated_.find(file); found != generated_.end())
            return {file, found->second, {}, {}};
        if (const auto found = mounted_.find(file); found != mounted_.end())
            return {
                found->second.file.generic_string(), found->second.text, folderOf(found->second.file), {}};
        return ofFiles_ ? findAnywhere(normal, from, folder) : findBelow(normal, from, folder);
    }

    Found findBelow(const fs::path& normal, const std::string& from, const fs::path& folder) const {
        const std::string file = normal.generic_string();
        const fs::path& root = folders_.front();
        if (normal.is_absolute() || file.starts_with(".."))
            throw ShaderError(from + ": #include \"" + file + "\" leads out of the " +
                              (folder.empty() ? "library" : "file's folder and the library") +
                              "; expected a file below");
        if (std::error_code ignored; !folder.empty() && fs::exists(folder / normal, ignored)) {
            const fs::path real = fs::canonical(folder / normal, ignored);
            const fs::path below = real.lexically_relative(fs::canonical(folder, ignored));
            if (ignored || below.empty() || below.generic_string().starts_with(".."))
                throw ShaderError(from + ": #include \"" + file +
                                  "\" leads out of the file's folder by a link; expected a file below");
            if (std::optional<std::string> text = readFile(real))
                return {(folder / normal).generic_string(), std::move(*text), folder, real};
        }
        if (std::optional<std::string> text = readFile(root / normal))
            return {file, std::move(*text), {}, root / normal};
        throw ShaderError(from + ": shader file " + file + " not found in " +
                          (folder.empty() ? "" : folder.string() + " or ") + root.string());
    }

    Found findAnywhere(const fs::path& normal, const std::string& from, const fs::path& folder) const {
        std::vector<fs::path> places = folders_;
        if (!folder.empty() || normal.is_absolute()) places.insert(places.begin(), folder);
        std::string tried;
        for (const fs::path& place : places) {
            const fs::path path = place / normal;
            if (std::optional<std::string> text = readFile(path)) {
                std::error_code failed;
                const fs::path canonical = fs::canonical(path, failed);
                return {shownPath(failed ? path : canonical), std::move(*text), folderOf(path), path};
            }
            tried += (tried.empty() ? "" : ", ") + shownPath(place.empty() ? "/" : place);
        }
        throw ShaderError(from + ": shader file " + normal.generic_string() + " not found in " + tried);
    }

    static fs::path folderOf(const fs::path& file) {
        return file.parent_path().empty() ? "." : file.parent_path();
    }

    /// Nothing if it is no regular file that can be read, or above 1 MiB.
    static std::optional<std::string> readFile(const fs::path& file) {
        constexpr uintmax_t kMostBytes = uintmax_t{1} << 20;
        std::error_code failed;
        if (!fs::is_regular_file(file, failed) || fs::file_size(file, failed) > kMostBytes || failed)
            return {};
        std::ifstream stream(file, std::ios::binary);
        if (!stream) return {};
        std::ostringstream text;
        text << stream.rdbuf();
        return withoutByteOrderMark(text.str());
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
    const std::map<std::string, ShaderLibrary::Mounted>& mounted_;
    ShaderSource& out_;
    std::set<std::string> taken_;                 ///< for certain
    std::map<std::string, size_t> perhapsTaken_;  ///< under some #if -> number of its guard
    int conditions_ = 0;                          ///< #if that are open
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

void ShaderLibrary::mount(const std::string& name, const fs::path& file, const std::string& text) {
    mounted_[name] = {file, text};
}

ShaderSource ShaderLibrary::source(const std::string& file, const Defines& defines,
                                   const std::map<std::string, std::string>& generated) const {
    ShaderSource result;
    Expansion expansion(folders_, ofFiles_, generated, mounted_, result);
    expansion.expand(file, "(program)");
    expansion.finish(defines);
    return result;
}

}  // namespace lobe::gl
