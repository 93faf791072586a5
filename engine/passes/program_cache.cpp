#include "passes/program_cache.hpp"

namespace lobe {

const gl::Program& ProgramCache::get(const std::string& vertex, const std::string& fragment,
                                     const gl::Defines& defines, const std::string& material) {
    std::string name = fragment;
    for (const auto& [key, value] : defines)
        name += " " + key + (value == "1" ? "" : "=" + value);
    const std::string key = vertex + "\n" + name + "\n" + material;
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
    if (onCompile_) onCompile_(name);
    const std::map<std::string, std::string> generated = {{"generated/material.glsl", material}};
    gl::Program program(library_.source(vertex, defines, generated),
                        library_.source(fragment, defines, generated), name);
    return programs_.emplace(key, std::move(program)).first->second;
}

}  // namespace lobe
