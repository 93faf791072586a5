#include "gl/objects.hpp"

#include <map>
#include <string>

#include "base/error.hpp"
#include "gl/debug.hpp"

namespace lobe::gl {
namespace {

std::string hex(GLenum value) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%04x", value);
    return text;
}

std::string errorName(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY:
            return "GL_OUT_OF_MEMORY";
        default:
            return hex(error);
    }
}

std::string statusName(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_UNDEFINED:
            return "GL_FRAMEBUFFER_UNDEFINED";
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT";
        case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER:
            return "GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER";
        case GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER:
            return "GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER";
        case GL_FRAMEBUFFER_UNSUPPORTED:
            return "GL_FRAMEBUFFER_UNSUPPORTED";
        case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
            return "GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE";
        default:
            return hex(status);
    }
}

}  // namespace

GLuint BufferTraits::create() {
    GLuint id = 0;
    glGenBuffers(1, &id);
    return id;
}
void BufferTraits::destroy(GLuint id) {
    glDeleteBuffers(1, &id);
}
GLuint TextureTraits::create() {
    GLuint id = 0;
    glGenTextures(1, &id);
    return id;
}
void TextureTraits::destroy(GLuint id) {
    glDeleteTextures(1, &id);
}
GLuint SamplerTraits::create() {
    GLuint id = 0;
    glGenSamplers(1, &id);
    return id;
}
void SamplerTraits::destroy(GLuint id) {
    glDeleteSamplers(1, &id);
}
GLuint VertexArrayTraits::create() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    return id;
}
void VertexArrayTraits::destroy(GLuint id) {
    glDeleteVertexArrays(1, &id);
}
GLuint FramebufferTraits::create() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    return id;
}
void FramebufferTraits::destroy(GLuint id) {
    glDeleteFramebuffers(1, &id);
}
GLuint QueryTraits::create() {
    GLuint id = 0;
    glGenQueries(1, &id);
    return id;
}
void QueryTraits::destroy(GLuint id) {
    glDeleteQueries(1, &id);
}

PixelFormat pixelFormat(GLenum internalFormat) {
    static const std::map<GLenum, PixelFormat> formats = {
        {GL_R8, {GL_RED, GL_UNSIGNED_BYTE}},
        {GL_RG8, {GL_RG, GL_UNSIGNED_BYTE}},
        {GL_RGB8, {GL_RGB, GL_UNSIGNED_BYTE}},
        {GL_RGBA8, {GL_RGBA, GL_UNSIGNED_BYTE}},
        {GL_SRGB8, {GL_RGB, GL_UNSIGNED_BYTE}},
        {GL_SRGB8_ALPHA8, {GL_RGBA, GL_UNSIGNED_BYTE}},
        {GL_RGB10_A2, {GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV}},
        {GL_R16, {GL_RED, GL_UNSIGNED_SHORT}},
        {GL_RG16, {GL_RG, GL_UNSIGNED_SHORT}},
        {GL_RGB16, {GL_RGB, GL_UNSIGNED_SHORT}},
        {GL_RGBA16, {GL_RGBA, GL_UNSIGNED_SHORT}},
        {GL_R16F, {GL_RED, GL_FLOAT}},
        {GL_RG16F, {GL_RG, GL_FLOAT}},
        {GL_RGBA16F, {GL_RGBA, GL_FLOAT}},
        {GL_R32F, {GL_RED, GL_FLOAT}},
        {GL_RG32F, {GL_RG, GL_FLOAT}},
        {GL_RGB32F, {GL_RGB, GL_FLOAT}},
        {GL_RGBA32F, {GL_RGBA, GL_FLOAT}},
        {GL_R8UI, {GL_RED_INTEGER, GL_UNSIGNED_BYTE}},
        {GL_R16UI, {GL_RED_INTEGER, GL_UNSIGNED_SHORT}},
        {GL_R32UI, {GL_RED_INTEGER, GL_UNSIGNED_INT}},
        {GL_RG32UI, {GL_RG_INTEGER, GL_UNSIGNED_INT}},
        {GL_RGBA32UI, {GL_RGBA_INTEGER, GL_UNSIGNED_INT}},
        {GL_DEPTH_COMPONENT24, {GL_DEPTH_COMPONENT, GL_UNSIGNED_INT}},
        {GL_DEPTH_COMPONENT32F, {GL_DEPTH_COMPONENT, GL_FLOAT}},
        {GL_DEPTH24_STENCIL8, {GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8}},
        {GL_DEPTH32F_STENCIL8, {GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV}}};
    const auto found = formats.find(internalFormat);
    if (found == formats.end())
        throw std::logic_error("no pixel format for internal format " + hex(internalFormat));
    return found->second;
}

Texture makeTarget(GLenum internalFormat, int width, int height) {
    Texture texture = Texture::make();
    const PixelFormat format = pixelFormat(internalFormat);
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internalFormat), width, height, 0, format.format,
                 format.type, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

Framebuffer makeFramebuffer(const std::vector<GLuint>& colors, GLuint depth, GLenum depthAttachment) {
    Framebuffer framebuffer = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    std::vector<GLenum> buffers;
    for (size_t i = 0; i < colors.size(); ++i) {
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, colors[i], 0);
    }
    if (depth != 0) glFramebufferTexture2D(GL_FRAMEBUFFER, depthAttachment, GL_TEXTURE_2D, depth, 0);
    if (buffers.empty()) {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    } else {
        glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
    }
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw ContextError("the driver refuses a framebuffer of " + std::to_string(colors.size()) +
                           " colour targets: " + statusName(status));
    return framebuffer;
}

TextureBuffer makeTextureBuffer(GLenum internalFormat, const void* data, size_t bytes) {
    TextureBuffer result{Buffer::make(), Texture::make()};
    glBindBuffer(GL_TEXTURE_BUFFER, result.buffer.id());
    glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
    glBindTexture(GL_TEXTURE_BUFFER, result.texture.id());
    glTexBuffer(GL_TEXTURE_BUFFER, internalFormat, result.buffer.id());
    return result;
}

void checkErrors(const char* place) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    while (glGetError() != GL_NO_ERROR) {
    }
    const std::string reported = takeDebugError();
    throw ContextError(std::string(place) + ": " + errorName(error) +
                       (reported.empty() ? "" : " (" + reported + ")"));
}

}  // namespace lobe::gl
