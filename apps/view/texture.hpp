/// A picture on the window's context.
#pragma once

#include <imgui.h>

#include "image/image.hpp"

namespace lobe::view {

class WindowTexture {
public:
    WindowTexture() = default;
    ~WindowTexture();
    WindowTexture(WindowTexture&& other) noexcept;
    WindowTexture& operator=(WindowTexture&& other) noexcept;

    /// 8-bit RGB or RGBA. `smooth`: larger on the screen than it is.
    void set(const Bitmap& bitmap, bool smooth);
    explicit operator bool() const { return id_ != 0; }
    ImTextureID id() const;
    int width() const { return width_; }
    int height() const { return height_; }

private:
    unsigned id_ = 0;
    int width_ = 0, height_ = 0;
};

}  // namespace lobe::view
