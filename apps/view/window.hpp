/// The window with its OpenGL context and Dear ImGui.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image.hpp"

struct GLFWwindow;

namespace lobe::view {

class Window {
public:
    /// Points, which high-DPI displays make larger. Throws ContextError that names the batch tool where there
    /// is no display or no driver.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool shouldClose() const;
    void close();
    void setTitle(const std::string& title);

    /// Waits for input, another thread's wake(), or `seconds`. Returns the files dropped meanwhile.
    std::vector<std::string> wait(double seconds);
    static void wake();
    /// Whether there was input since the last call, after which ImGui needs some frames to settle.
    bool takeInput();

    /// A key that was pressed, with what was held.
    struct Key {
        int key;  ///< GLFW's
        bool control, shift;
    };
    /// The one that this frame is for: one a frame, however fast they come. ImGui sees it down.
    const std::optional<Key>& key() const { return key_; }
    bool hasKeys() const;  ///< more to come

    void beginFrame();
    void endFrame(bool keepPixels);

    std::pair<int, int> size() const;       ///< points
    float scale() const { return scale_; }  ///< of text and spacing against 96 dots an inch
    float pixelsPerPoint() const;           ///< framebuffer pixels a unit of ImGui
    GLFWwindow* handle() const { return window_; }

    /// What was shown by the last frame whose pixels were kept: 8-bit RGB, framebuffer pixels.
    const Bitmap& pixels() const { return pixels_; }

private:
    void startImGui();
    void readPixels(int width, int height);
    GLFWwindow* window_ = nullptr;
    float scale_ = 1.0F;
    std::optional<Key> key_;
    Bitmap pixels_;
};

}  // namespace lobe::view
