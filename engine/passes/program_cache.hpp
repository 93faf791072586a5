/// Compiled programs, kept as long as the context: a scene that needs the same variant again gets the same
/// program.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "gl/program.hpp"

namespace lobe {

class ProgramCache {
public:
    explicit ProgramCache(gl::ShaderLibrary library) : library_(std::move(library)) {}

    /// `material` becomes "generated/material.glsl". The reference stays valid for the cache's life. Throws
    /// ShaderError.
    const gl::Program& get(const std::string& vertex, const std::string& fragment, const gl::Defines& defines,
                           const std::string& material);

    /// Called with a program's name before it is compiled, which may take a second.
    void onCompile(std::function<void(const std::string&)> callback) { onCompile_ = std::move(callback); }

private:
    gl::ShaderLibrary library_;
    std::map<std::string, gl::Program> programs_;
    std::function<void(const std::string&)> onCompile_;
};

}  // namespace lobe
