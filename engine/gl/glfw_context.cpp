// Contexts through GLFW: a hidden window. Needs a display; the library is opened at run time, so programs
// that never ask for it do not load X11.
#include "base/error.hpp"
#include "gl/backends.hpp"
#include "gl/dynamic_library.hpp"

namespace lobe::gl {
namespace {

using GlfwWindow = struct GlfwWindowTag*;
using Proc = void (*)();

constexpr int kVisible = 0x00020004, kContextMajor = 0x00022002, kContextMinor = 0x00022003,
              kForwardCompatible = 0x00022006, kDebugContext = 0x00022007, kProfile = 0x00022008,
              kCoreProfile = 0x00032001, kTrue = 1, kFalse = 0;

struct Glfw {
    DynamicLibrary library{{"libglfw.so.3"}, "LOBE_GLFW_LIBRARY"};
    int (*init)() = library.function<int (*)()>("glfwInit");
    int (*getError)(const char**) = library.function<int (*)(const char**)>("glfwGetError");
    void (*windowHint)(int, int) = library.function<void (*)(int, int)>("glfwWindowHint");
    GlfwWindow (*createWindow)(int, int, const char*, void*, GlfwWindow) =
        library.function<GlfwWindow (*)(int, int, const char*, void*, GlfwWindow)>("glfwCreateWindow");
    void (*destroyWindow)(GlfwWindow) = library.function<void (*)(GlfwWindow)>("glfwDestroyWindow");
    void (*makeContextCurrent)(GlfwWindow) = library.function<void (*)(GlfwWindow)>("glfwMakeContextCurrent");
    Proc (*getProcAddress)(const char*) = library.function<Proc (*)(const char*)>("glfwGetProcAddress");

    [[noreturn]] void fail(const char* function) const {
        const char* description = nullptr;
        getError(&description);
        throw ContextError(std::string(function) + " failed" +
                           (description != nullptr ? std::string(": ") + description : ""));
    }
};

Glfw& glfw() {
    static Glfw instance;
    return instance;
}

class GlfwContext final : public ContextBase {
public:
    explicit GlfwContext(const ContextRequest& request) : ContextBase(request) {
        if (glfw().init() == kFalse) glfw().fail("glfwInit");
        glfw().windowHint(kVisible, kFalse);
        glfw().windowHint(kContextMajor, 3);
        glfw().windowHint(kContextMinor, 3);
        glfw().windowHint(kProfile, kCoreProfile);
        glfw().windowHint(kForwardCompatible, kTrue);
        glfw().windowHint(kDebugContext, request.debug ? kTrue : kFalse);
        window_ = glfw().createWindow(16, 16, "lobe", nullptr, nullptr);
        if (window_ == nullptr) glfw().fail("glfwCreateWindow");
        try {
            makeCurrent();
            initialise("glfw", "window", procAddress);
        } catch (...) {
            close();
            throw;
        }
    }
    ~GlfwContext() override { close(); }
    void makeCurrent() override {
        if (Context* other = currentContext(); other != nullptr && other != this) other->release();
        glfw().makeContextCurrent(window_);
        noteCurrent(this);
        if (loaded_) loadFunctions(procAddress);
        loaded_ = true;
    }
    void release() override {
        glfw().makeContextCurrent(nullptr);
        if (currentContext() == this) noteCurrent(nullptr);
    }

private:
    void close() {
        if (currentContext() == this) release();
        glfw().destroyWindow(window_);
    }
    static Proc procAddress(const char* name) { return glfw().getProcAddress(name); }
    GlfwWindow window_ = nullptr;
    bool loaded_ = false;
};

}  // namespace

std::unique_ptr<Context> makeGlfwContext(const ContextRequest& request) {
    return std::make_unique<GlfwContext>(request);
}

}  // namespace lobe::gl
