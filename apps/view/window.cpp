#include "window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <utility>

#include "base/error.hpp"
#include "style.hpp"
#include "window_gl.hpp"

namespace lobe::view {
namespace {

std::string lastError;
std::vector<std::string> dropped;
std::deque<Window::Key> keys;
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
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
        const bool modifier = key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
        // Letters that are typed into a field come as such.
        const bool typed =
            ImGui::GetIO().WantTextInput && key < GLFW_KEY_ESCAPE && (mods & GLFW_MOD_CONTROL) == 0;
        if (action == GLFW_PRESS && key >= 0 && !modifier && !typed)
            keys.push_back({key, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0});
        noteInput(window);
    });
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

bool Window::hasKeys() const {
    return !keys.empty();
}

void Window::beginFrame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    // Keys that were pressed and released since the last frame would be missed.
    ImGuiIO& io = ImGui::GetIO();
    const auto setModifiers = [&](bool control, bool shift) {
        io.KeyCtrl = control;
        io.KeyShift = shift;
    };
    if (key_ && glfwGetKey(window_, key_->key) == GLFW_RELEASE) {
        io.KeysDown[key_->key] = false;
        const auto held = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
        setModifiers(held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
                     held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT));
    }
    key_.reset();
    if (!keys.empty()) {
        key_ = keys.front();
        keys.pop_front();
        io.KeysDown[key_->key] = true;
        setModifiers(key_->control, key_->shift);
    }
    ImGui::NewFrame();
}

void Window::endFrame(bool keepPixels) {
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const WindowGl& gl = windowGl();
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.0F, 0.0F, 0.0F, 1.0F);
    gl.clear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (keepPixels) readPixels(width, height);
    glfwSwapBuffers(window_);
}

std::pair<int, int> Window::size() const {
    std::pair<int, int> size;
    glfwGetWindowSize(window_, &size.first, &size.second);
    return size;
}

float Window::pixelsPerPoint() const {
    int width = 0, height = 0, pixels = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixels, &height);
    return width > 0 && pixels > 0 ? static_cast<float>(pixels) / static_cast<float>(width) : 1.0F;
}

void Window::readPixels(int width, int height) {
    const WindowGl& gl = windowGl();
    const size_t row = 3 * static_cast<size_t>(width);
    std::vector<std::byte> bottomUp(row * static_cast<size_t>(height));
    gl.pixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.readBuffer(GL_BACK);
    gl.readPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bottomUp.data());
    pixels_ = {width, height, 3, ComponentType::u8, std::vector<std::byte>(bottomUp.size())};
    for (size_t y = 0; y < static_cast<size_t>(height); ++y)
        std::copy_n(bottomUp.data() + y * row, row,
                    pixels_.data.data() + (static_cast<size_t>(height) - 1 - y) * row);
}

}  // namespace lobe::view
