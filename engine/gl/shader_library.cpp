#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "gl/program.hpp"

namespace lobe::gl {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 32;

/// Expands includes, remembering where each line came from.
class Expansion {
public:
    Expansion(const std::filesystem::path& root, const std::map<std::string, std::string>& generated,
              const std::map<std::string, ShaderLibrary::Mounted>& mounted, ShaderSource& out)
        : root_(root), generated_(generated), mounted_(mounted), out_(out) {}

    void emit(const std::string& line, const std::string& file, int number) {
        out_.text += line + "\n";
        out_.places.push_back({file, number});
    }

    /// `folder`: of the mounted file that the include stands in; empty in the library.
    void expand(const std::string& name, const std::string& from, const fs::path& folder = {}) {
        const Found found = find(name, from, folder);
        const std::string& file = found.name;
        if (chain_.size() >= kMaxDepth)
            throw ShaderError(from + ": includes nest deeper than " + std::to_string(kMaxDepth));
        for (const std::string& open : chain_)
            if (open == file)
                throw ShaderError(from + ": " + file + " includes itself, by way of " + chain_.back());
        if (!taken_.insert(file).second) return;
        chain_.push_back(file);
        std::istringstream lines(found.text);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            if (!line.empty() && line.back() == '\r') line.pop_back();
            const std::string place = file + ":" + std::to_string(number);
            const std::string included = includeOf(line, place);
            if (included.empty())
                emit(line, file, number);
            else
                expand(included, place, found.folder);
            inComment_ = commentAfter(line);
        }
        if (inComment_) throw ShaderError(file + ": a block comment is not closed");
        chain_.pop_back();
    }

private:
    struct Found {
        std::string name;  ///< for messages; tells files apart
        std::string text;
        fs::path folder;  ///< that its own includes are looked for in first
    };

    Found find(const std::string& name, const std::string& from, const fs::path& folder) const {
        const fs::path normal = fs::path(name).lexically_normal();
        const std::string file = normal.generic_string();
        if (const auto found = generated_.find(file); found != generated_.end())
            return {file, found->second, {}};
        if (const auto found = mounted_.find(file); found != mounted_.end())
            return {found->second.file.generic_string(), found->second.text, folderOf(found->second.file)};
        if (normal.is_absolute() || file.starts_with(".."))
            throw ShaderError(from + ": #include \"" + name + "\" leads out of the " +
                              (folder.empty() ? "library" : "file's folder and the library") +
                              "; expected a file below");
        if (std::error_code ignored; !folder.empty() && fs::exists(folder / normal, ignored)) {
            const fs::path real = fs::canonical(folder / normal, ignored);
            const fs::path below = real.lexically_relative(fs::canonical(folder, ignored));
            if (ignored || below.empty() || below.generic_string().starts_with(".."))
                throw ShaderError(from + ": #include \"" + name +
                                  "\" leads out of the file's folder by a link; expected a file below");
            if (std::optional<std::string> text = readFile(real))
                return {(folder / normal).generic_string(), std::move(*text), folder};
        }
        if (std::optional<std::string> text = readFile(root_ / normal)) return {file, std::move(*text), {}};
        throw ShaderError(from + ": shader file " + file + " not found in " +
                          (folder.empty() ? "" : folder.string() + " or ") + root_.string());
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
        return text.str();
    }

    /// The name in `#include "NAME"`, or nothing. Lines within a block comment do not count.
    std::string includeOf(const std::string& line, const std::string& place) const {
        if (inComment_) return {};
        size_t at = line.find_first_not_of(" \t");
        if (at == std::string::npos || line[at] != '#') return {};
        at = line.find_first_not_of(" \t", at + 1);
        if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
        const size_t open = line.find('"', at + 7);
        const size_t close = open == std::string::npos ? open : line.find('"', open + 1);
        if (close == std::string::npos || close == open + 1)
            throw ShaderError(place + ": " + line + "; expected #include \"FILE\"");
        return line.substr(open + 1, close - open - 1);
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

    const fs::path& root_;
    const std::map<std::string, std::string>& generated_;
    const std::map<std::string, ShaderLibrary::Mounted>& mounted_;
    ShaderSource& out_;
    std::set<std::string> taken_;
    std::vector<std::string> chain_;
    bool inComment_ = false;
};

}  // namespace

ShaderLibrary::ShaderLibrary(std::filesystem::path root) : root_(std::move(root)) {}

void ShaderLibrary::mount(const std::string& name, const fs::path& file, const std::string& text) {
    mounted_[name] = {file, text};
}

ShaderSource ShaderLibrary::source(const std::string& file, const Defines& defines,
                                   const std::map<std::string, std::string>& generated) const {
    ShaderSource result;
    Expansion expansion(root_, generated, mounted_, result);
    expansion.emit("#version 330 core", "(version)", 1);
    int number = 0;
    for (const auto& [key, value] : defines)
        expansion.emit("#define " + key + " " + value, "(defines)", ++number);
    expansion.expand(file, "(program)");
    return result;
}

}  // namespace lobe::gl
