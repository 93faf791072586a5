#include "gl/debug.hpp"

#include <glad/gl.h>
#include <spdlog/spdlog.h>

#include <utility>
#include <vector>

namespace lobe::gl {
namespace {

// The callback is called on the thread that made the faulty call (synchronous output).
thread_local std::vector<std::string> scopes;
thread_local std::string firstError;

void GLAD_API_PTR report(GLenum, GLenum type, GLuint id, GLenum, GLsizei, const GLchar* message,
                         const void*) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    std::string place;
    for (const std::string& scope : scopes)
        place += (place.empty() ? "" : " > ") + scope;
    const std::string text =
        (place.empty() ? "OpenGL" : place) + ": error " + std::to_string(id) + ": " + message;
    spdlog::error(text);
    if (firstError.empty()) firstError = text;
}

}  // namespace

void enableDebugOutput() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(report, nullptr);
}

DebugScope::DebugScope(const std::string& name) {
    scopes.push_back(name);
}
DebugScope::~DebugScope() {
    scopes.pop_back();
}

std::string takeDebugError() {
    return std::exchange(firstError, {});
}

}  // namespace lobe::gl
