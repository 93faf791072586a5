#include "window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/error.hpp"
#include "style.hpp"
#include "window_gl.hpp"

namespace lobe::view {
namespace {

std::string lastError;
std::vector<std::string> dropped;
bool input = false;

[[noreturn]] void refuse(const std::string& what) {
    throw ContextError("no window: " + what + (lastError.empty() ? "" : ": " + lastError) +
                       "; pictures without a display are made by: lobe render SCENE -o picture.png");
}

bool hasDisplay() {
    return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

void noteInput(GLFWwindow*) {
    input = true;
}

}  // namespace

Window::Window(const std::string& title, int width, int height) {
    glfwSetErrorCallback([](int, const char* text) { lastError = text; });
    if (!hasDisplay()) refuse("neither DISPLAY nor WAYLAND_DISPLAY is set");
    if (glfwInit() == GLFW_FALSE) refuse("the display cannot be opened");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        glfwTerminate();
        refuse("the display gives no OpenGL 3.3 context");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    float other = 1.0F;
    glfwGetWindowContentScale(window_, &scale_, &other);
    scale_ = std::clamp(scale_, 0.5F, 4.0F);
    startImGui();
}

void Window::startImGui() {
    // Before ImGui, whose backend calls those that are there.
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        dropped.insert(dropped.end(), paths, paths + count);
        noteInput(window);
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { noteInput(window); });
    glfwSetWindowRefreshCallback(window_, noteInput);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int, int, int, int) { noteInput(window); });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned) { noteInput(window); });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int, int, int) { noteInput(window); });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double) { noteInput(window); });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double, double) { noteInput(window); });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int) { noteInput(window); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int) { noteInput(window); });
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // places follow from the window
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    setStyle(scale_);
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(window_) != GLFW_FALSE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

std::vector<std::string> Window::wait(double seconds) {
    if (seconds > 0.0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    return std::exchange(dropped, {});
}

void Window::wake() {
    glfwPostEmptyEvent();
}

bool Window::takeInput() {
    return std::exchange(input, false);
}

void Window::beginFrame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::endFrame() {
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const WindowGl& gl = windowGl();
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.0F, 0.0F, 0.0F, 1.0F);
    gl.clear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window_);
}

float Window::pixelsPerPoint() const {
    int width = 0, height = 0, pixels = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixels, &height);
    return width > 0 && pixels > 0 ? static_cast<float>(pixels) / static_cast<float>(width) : 1.0F;
}

std::vector<unsigned char> Window::pixels(int& width, int& height) const {
    glfwGetFramebufferSize(window_, &width, &height);
    const WindowGl& gl = windowGl();
    const size_t row = 3 * static_cast<size_t>(width);
    std::vector<unsigned char> bottomUp(row * static_cast<size_t>(height)), result(bottomUp.size());
    gl.pixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.readBuffer(GL_FRONT);
    gl.readPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bottomUp.data());
    for (size_t y = 0; y < static_cast<size_t>(height); ++y)
        std::copy_n(bottomUp.data() + y * row, row,
                    result.data() + (static_cast<size_t>(height) - 1 - y) * row);
    return result;
}

}  // namespace lobe::view
