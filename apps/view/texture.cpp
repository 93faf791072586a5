#include "texture.hpp"

#include <utility>

#include "window_gl.hpp"

namespace lobe::view {

WindowTexture::~WindowTexture() {
    if (id_ != 0) windowGl().deleteTextures(1, &id_);
}

WindowTexture::WindowTexture(WindowTexture&& other) noexcept
    : id_(std::exchange(other.id_, 0)), width_(other.width_), height_(other.height_) {}

WindowTexture& WindowTexture::operator=(WindowTexture&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    return *this;
}

void WindowTexture::set(const Bitmap& bitmap, bool smooth) {
    const WindowGl& gl = windowGl();
    if (id_ == 0) gl.genTextures(1, &id_);
    gl.bindTexture(GL_TEXTURE_2D, id_);
    const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
    gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.pixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const GLenum format = bitmap.channels == 4 ? GL_RGBA : GL_RGB;
    const GLint stored = bitmap.channels == 4 ? GL_RGBA8 : GL_RGB8;
    gl.texImage2D(GL_TEXTURE_2D, 0, stored, bitmap.width, bitmap.height, 0, format, GL_UNSIGNED_BYTE,
                  bitmap.data.data());
    width_ = bitmap.width;
    height_ = bitmap.height;
}

ImTextureID WindowTexture::id() const {
    return reinterpret_cast<ImTextureID>(static_cast<intptr_t>(id_));  // as ImGui's backend has it
}

}  // namespace lobe::view
