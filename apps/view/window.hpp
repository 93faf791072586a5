/// The window with its OpenGL context and Dear ImGui.
#pragma once

#include <functional>
#include <string>
#include <vector>

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

    void beginFrame();
    void endFrame();

    float scale() const { return scale_; }  ///< of text and spacing against 96 dots an inch
    float pixelsPerPoint() const;           ///< framebuffer pixels a unit of ImGui
    GLFWwindow* handle() const { return window_; }

    /// What is shown, 8-bit RGB, top row first. Width and height in framebuffer pixels.
    std::vector<unsigned char> pixels(int& width, int& height) const;

private:
    void startImGui();
    GLFWwindow* window_ = nullptr;
    float scale_ = 1.0F;
};

}  // namespace lobe::view
