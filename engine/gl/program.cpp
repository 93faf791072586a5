#include "gl/program.hpp"

#include <glad/gl.h>

#include <glm/gtc/type_ptr.hpp>
#include <regex>
#include <sstream>

#include "base/error.hpp"
#include "gl/objects.hpp"

namespace lobe::gl {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

/// Puts the file and line of the library in the place of the driver's own: "0:41(12): error" (Mesa),
/// "0(41) : error" (NVIDIA), "ERROR: 0:41:" (AMD, Apple).
std::string translated(const std::string& log, const ShaderSource& source) {
    static const std::regex number(R"(^(?:ERROR: |WARNING: )?\d+(?::(\d+)|\((\d+)\)))");
    const std::vector<std::string> text = linesOf(source.text);
    std::string result;
    for (const std::string& message : linesOf(log)) {
        if (message.empty()) continue;
        std::smatch match;
        const bool placed = std::regex_search(message, match, number);
        const size_t line = placed ? std::stoul(match[1].matched ? match[1].str() : match[2].str()) : 0;
        if (line < 1 || line > source.places.size()) {
            result += "\n" + message;
            continue;
        }
        const ShaderSource::Place& place = source.places[line - 1];
        result +=
            "\n" + place.file + ":" + std::to_string(place.line) + ": " + message.substr(match[0].length());
        for (size_t shown = line > 1 ? line - 1 : 1; shown <= std::min(line + 1, text.size()); ++shown) {
            const ShaderSource::Place& at = source.places[shown - 1];
            if (at.file == place.file)
                result += "\n  " + std::string(shown == line ? "> " : "  ") + std::to_string(at.line) +
                          " | " + text[shown - 1];
        }
    }
    return result;
}

GLuint compile(GLenum kind, const ShaderSource& source, const std::string& name) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    log.resize(log.find_last_not_of(std::string("\0\n ", 3)) + 1);
    glDeleteShader(shader);
    throw ShaderError(std::string(kind == GL_VERTEX_SHADER ? "vertex" : "fragment") + " shader of " + name +
                      " does not compile:" + translated(log, source));
}

}  // namespace

Program::Program(const ShaderSource& vertex, const ShaderSource& fragment, const std::string& name,
                 const std::vector<std::string>& captured) {
    const GLuint vertexShader = compile(GL_VERTEX_SHADER, vertex, name);
    GLuint fragmentShader = 0;
    try {
        fragmentShader = compile(GL_FRAGMENT_SHADER, fragment, name);
    } catch (...) {
        glDeleteShader(vertexShader);
        throw;
    }
    id_ = glCreateProgram();
    glAttachShader(id_, vertexShader);
    glAttachShader(id_, fragmentShader);
    std::vector<const char*> names;
    for (const std::string& output : captured)
        names.push_back(output.c_str());
    if (!names.empty())
        glTransformFeedbackVaryings(id_, static_cast<GLsizei>(names.size()), names.data(),
                                    GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(id_);
    glDeleteShader(vertexShader);
    glDeleteShader(fragmentShader);
    GLint linked = GL_FALSE;
    glGetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return;
    char log[4096] = "";
    glGetProgramInfoLog(id_, sizeof log, nullptr, log);
    glDeleteProgram(std::exchange(id_, 0));
    throw ShaderError("program " + name + " does not link: " + log);
}

Program::Program(Program&& other) noexcept
    : id_(std::exchange(other.id_, 0)), locations_(std::move(other.locations_)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(locations_, other.locations_);
    return *this;
}

Program::~Program() {
    if (id_ != 0) glDeleteProgram(id_);
}

void Program::use() const {
    glUseProgram(id_);
}

int Program::uniform(const std::string& name) const {
    const auto [place, isNew] = locations_.try_emplace(name, -1);
    if (isNew) place->second = glGetUniformLocation(id_, name.c_str());
    return place->second;
}

void Program::set(const std::string& name, int value) const {
    glUniform1i(uniform(name), value);
}
void Program::set(const std::string& name, float value) const {
    glUniform1f(uniform(name), value);
}
void Program::set(const std::string& name, const glm::vec2& value) const {
    glUniform2fv(uniform(name), 1, glm::value_ptr(value));
}
void Program::set(const std::string& name, const glm::vec3& value) const {
    glUniform3fv(uniform(name), 1, glm::value_ptr(value));
}
void Program::set(const std::string& name, const glm::vec4& value) const {
    glUniform4fv(uniform(name), 1, glm::value_ptr(value));
}
void Program::set(const std::string& name, const glm::mat3& value) const {
    glUniformMatrix3fv(uniform(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const std::string& name, const glm::mat4& value) const {
    glUniformMatrix4fv(uniform(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const std::string& name, const glm::ivec2& value) const {
    glUniform2iv(uniform(name), 1, glm::value_ptr(value));
}

}  // namespace lobe::gl
