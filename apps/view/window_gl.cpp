#include "window_gl.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace lobe::view {
namespace {

template<class Function>
void get(Function& function, const char* name) {
    function = reinterpret_cast<Function>(glfwGetProcAddress(name));
}

}  // namespace

const WindowGl& windowGl() {
    static const WindowGl functions = [] {
        WindowGl gl{};
        get(gl.genTextures, "glGenTextures");
        get(gl.deleteTextures, "glDeleteTextures");
        get(gl.bindTexture, "glBindTexture");
        get(gl.texParameteri, "glTexParameteri");
        get(gl.texImage2D, "glTexImage2D");
        get(gl.pixelStorei, "glPixelStorei");
        get(gl.viewport, "glViewport");
        get(gl.clearColor, "glClearColor");
        get(gl.clear, "glClear");
        get(gl.readBuffer, "glReadBuffer");
        get(gl.readPixels, "glReadPixels");
        get(gl.getString, "glGetString");
        return gl;
    }();
    return functions;
}

}  // namespace lobe::view
