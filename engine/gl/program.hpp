/// Programs from files of the GLSL library, with includes, variants, and messages that name file and line.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace lobe::gl {

/// A variant key: sorted defines. "KEY" -> value ("1" for a flag).
using Defines = std::map<std::string, std::string>;

/// GLSL text with the place that each line came from.
struct ShaderSource {
    std::string text;
    struct Place {
        std::string file;
        int line;
    };
    std::vector<Place> places;                 ///< one a line of text
    std::vector<std::filesystem::path> files;  ///< all that were read
};

/// Reads shader files. `#include "brdf/ward.glsl"` is rooted at the library; each file is taken once. Names
/// in `generated` are taken before files ("generated/material.glsl"). No include leads out of the library,
/// or, in a mounted file, out of the folder of that file; but see ofFiles().
class ShaderLibrary {
public:
    explicit ShaderLibrary(std::filesystem::path root);
    /// For files that need not be Lobe's: what they include is looked for beside the including file, then in
    /// each of `folders`; places name paths, relative where they are below the working directory. Any
    /// `#version` in them is taken out, and the highest, 330 at least, is the whole text's (those of other
    /// profiles are refused); `#extension` lines move to the top; `#line` lines are taken out.
    static ShaderLibrary ofFiles(std::vector<std::filesystem::path> folders);

    /// The whole text: "#version 330 core", the defines, then `file` with its includes. Throws ShaderError
    /// (missing file, include cycle or depth) naming file and line.
    ShaderSource source(const std::string& file, const Defines& defines,
                        const std::map<std::string, std::string>& generated = {}) const;
    /// The first folder.
    const std::filesystem::path& root() const { return folders_.front(); }

    /// A file from elsewhere takes the place `name` in the library, with the text that is given. What it
    /// includes is looked for in its own folder before the library. Messages name it as `file` does.
    void mount(const std::string& name, const std::filesystem::path& file, const std::string& text);

    struct Mounted {
        std::filesystem::path file;
        std::string text;
    };

private:
    std::vector<std::filesystem::path> folders_;
    bool ofFiles_ = false;
    std::map<std::string, Mounted> mounted_;
};

/// A linked program. Move-only.
class Program {
public:
    Program() = default;
    /// Throws ShaderError: "pass/light.frag:41: message", with three lines of source, for each of the
    /// driver's lines that can be placed.
    /// `captured`: outputs of the vertex stage that transform feedback writes, interleaved.
    Program(const ShaderSource& vertex, const ShaderSource& fragment, const std::string& name,
            const std::vector<std::string>& captured = {});
    Program(Program&&) noexcept;
    Program& operator=(Program&&) noexcept;
    ~Program();

    void use() const;
    unsigned id() const { return id_; }
    /// Location, -1 if the program does not use that name. Cached.
    int uniform(const std::string& name) const;
    void set(const std::string& name, int value) const;  // the program must be in use
    void set(const std::string& name, float value) const;
    void set(const std::string& name, const glm::vec2& value) const;
    void set(const std::string& name, const glm::vec3& value) const;
    void set(const std::string& name, const glm::vec4& value) const;
    void set(const std::string& name, const glm::mat3& value) const;
    void set(const std::string& name, const glm::mat4& value) const;
    void set(const std::string& name, const glm::ivec2& value) const;

private:
    unsigned id_ = 0;
    mutable std::map<std::string, int> locations_;
};

}  // namespace lobe::gl
