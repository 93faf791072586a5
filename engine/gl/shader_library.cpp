#include <fstream>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "gl/program.hpp"

namespace lobe::gl {
namespace {

constexpr int kMaxDepth = 32;

/// Expands includes, remembering where each line came from.
class Expansion {
public:
    Expansion(const std::filesystem::path& root, const std::map<std::string, std::string>& generated,
              ShaderSource& out)
        : root_(root), generated_(generated), out_(out) {}

    void emit(const std::string& line, const std::string& file, int number) {
        out_.text += line + "\n";
        out_.places.push_back({file, number});
    }

    void expand(const std::string& name, const std::string& from) {
        const std::string file = std::filesystem::path(name).lexically_normal().generic_string();
        if (chain_.size() >= kMaxDepth)
            throw ShaderError(from + ": includes nest deeper than " + std::to_string(kMaxDepth));
        for (const std::string& open : chain_)
            if (open == file)
                throw ShaderError(from + ": " + file + " includes itself, by way of " + chain_.back());
        if (!taken_.insert(file).second) return;
        chain_.push_back(file);
        std::istringstream lines(read(file, from));
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            if (!line.empty() && line.back() == '\r') line.pop_back();
            const std::string place = file + ":" + std::to_string(number);
            const std::string included = includeOf(line, place);
            if (included.empty())
                emit(line, file, number);
            else
                expand(included, place);
            inComment_ = commentAfter(line);
        }
        if (inComment_) throw ShaderError(file + ": a block comment is not closed");
        chain_.pop_back();
    }

private:
    std::string read(const std::string& file, const std::string& from) const {
        if (const auto found = generated_.find(file); found != generated_.end()) return found->second;
        std::error_code ignored;
        std::ifstream stream(root_ / file, std::ios::binary);
        if (!stream || !std::filesystem::is_regular_file(root_ / file, ignored))
            throw ShaderError(from + ": shader file " + file + " not found in " + root_.string());
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

    const std::filesystem::path& root_;
    const std::map<std::string, std::string>& generated_;
    ShaderSource& out_;
    std::set<std::string> taken_;
    std::vector<std::string> chain_;
    bool inComment_ = false;
};

}  // namespace

ShaderLibrary::ShaderLibrary(std::filesystem::path root) : root_(std::move(root)) {}

ShaderSource ShaderLibrary::source(const std::string& file, const Defines& defines,
                                   const std::map<std::string, std::string>& generated) const {
    ShaderSource result;
    Expansion expansion(root_, generated, result);
    expansion.emit("#version 330 core", "(version)", 1);
    int number = 0;
    for (const auto& [key, value] : defines)
        expansion.emit("#define " + key + " " + value, "(defines)", ++number);
    expansion.expand(file, "(program)");
    return result;
}

}  // namespace lobe::gl
