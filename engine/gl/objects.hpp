/// Move-only owners of OpenGL objects.
#pragma once

#include <glad/gl.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace lobe::gl {

/// Owns one object name; `Traits::create()` and `Traits::destroy(GLuint)`.
template<class Traits>
class Object {
public:
    Object() = default;
    static Object make() {
        Object object;
        object.id_ = Traits::create();
        return object;
    }
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0);
        }
        return *this;
    }
    ~Object() { reset(); }
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    void reset() {
        if (id_ != 0) Traits::destroy(std::exchange(id_, 0));
    }

private:
    GLuint id_ = 0;
};

struct BufferTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct TextureTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct SamplerTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct VertexArrayTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct FramebufferTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct QueryTraits {
    static GLuint create();
    static void destroy(GLuint id);
};

using Buffer = Object<BufferTraits>;
using Texture = Object<TextureTraits>;
using Sampler = Object<SamplerTraits>;
using VertexArray = Object<VertexArrayTraits>;
using Framebuffer = Object<FramebufferTraits>;
using Query = Object<QueryTraits>;

/// A 2D texture of a sized internal format, without mip levels, nearest filter: a render target.
Texture makeTarget(GLenum internalFormat, int width, int height);
/// Attaches the colour targets 0.. and the depth(-stencil) target (0: none) and checks completeness; throws
/// ContextError with the status's name.
Framebuffer makeFramebuffer(const std::vector<GLuint>& colors, GLuint depth, GLenum depthAttachment);

/// Format and type that describe a sized internal format's data to glTexImage2D and glReadPixels.
struct PixelFormat {
    GLenum format;
    GLenum type;
};
PixelFormat pixelFormat(GLenum internalFormat);

/// A texture buffer: `data` as texels of `internalFormat` (RGBA32F, RG32UI, R32UI).
struct TextureBuffer {
    Buffer buffer;
    Texture texture;
};
TextureBuffer makeTextureBuffer(GLenum internalFormat, const void* data, size_t bytes);

/// Throws ContextError "PLACE: GL_INVALID_..." if an error is pending. For use after groups of calls; in
/// debug contexts each error is reported as it happens.
void checkErrors(const char* place);

}  // namespace lobe::gl
