// Contexts through EGL: on a device, without any surface, or with a pbuffer on the default display.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>

#include "base/error.hpp"
#include "gl/backends.hpp"
#include "gl/dynamic_library.hpp"

namespace lobe::gl {
namespace {

using Proc = void (*)();

/// The library's functions. EGL's own loader finds the vendor's driver.
struct Egl {
    DynamicLibrary library{{"libEGL.so.1", "libEGL.so"}, "LOBE_EGL_LIBRARY"};
    decltype(&eglGetProcAddress) getProcAddress =
        library.function<decltype(&eglGetProcAddress)>("eglGetProcAddress");
    decltype(&eglInitialize) initialize = library.function<decltype(&eglInitialize)>("eglInitialize");
    decltype(&eglTerminate) terminate = library.function<decltype(&eglTerminate)>("eglTerminate");
    decltype(&eglBindAPI) bindApi = library.function<decltype(&eglBindAPI)>("eglBindAPI");
    decltype(&eglChooseConfig) chooseConfig = library.function<decltype(&eglChooseConfig)>("eglChooseConfig");
    decltype(&eglCreateContext) createContext =
        library.function<decltype(&eglCreateContext)>("eglCreateContext");
    decltype(&eglDestroyContext) destroyContext =
        library.function<decltype(&eglDestroyContext)>("eglDestroyContext");
    decltype(&eglCreatePbufferSurface) createPbuffer =
        library.function<decltype(&eglCreatePbufferSurface)>("eglCreatePbufferSurface");
    decltype(&eglDestroySurface) destroySurface =
        library.function<decltype(&eglDestroySurface)>("eglDestroySurface");
    decltype(&eglMakeCurrent) makeCurrent = library.function<decltype(&eglMakeCurrent)>("eglMakeCurrent");
    decltype(&eglGetDisplay) getDisplay = library.function<decltype(&eglGetDisplay)>("eglGetDisplay");
    decltype(&eglQueryString) queryString = library.function<decltype(&eglQueryString)>("eglQueryString");
    decltype(&eglGetError) getError = library.function<decltype(&eglGetError)>("eglGetError");

    template<class Function>
    Function extension(const char* name) const {
        const auto address = reinterpret_cast<Function>(getProcAddress(name));
        if (address == nullptr) throw ContextError(std::string("EGL lacks ") + name);
        return address;
    }
    bool hasClientExtension(const char* name) const {
        const char* all = queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
        return all != nullptr && std::strstr(all, name) != nullptr;
    }
    [[noreturn]] void fail(const char* function) const {
        char code[16];
        std::snprintf(code, sizeof code, "0x%04x", getError());
        throw ContextError(std::string(function) + " failed (" + code + ")");
    }
};

Egl& egl() {
    static Egl instance;
    return instance;
}

std::vector<EGLDeviceEXT> deviceHandles() {
    if (!egl().hasClientExtension("EGL_EXT_device_enumeration") &&
        !egl().hasClientExtension("EGL_EXT_device_base"))
        throw ContextError("EGL lists no devices (EGL_EXT_device_enumeration is absent)");
    const auto query = egl().extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (query(0, nullptr, &count) == EGL_FALSE) egl().fail("eglQueryDevicesEXT");
    std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
    if (count > 0 && query(count, devices.data(), &count) == EGL_FALSE) egl().fail("eglQueryDevicesEXT");
    return devices;
}

enum class Surface { none, pbuffer };

class EglContext final : public ContextBase {
public:
    EglContext(const ContextRequest& request, EGLDisplay display, Surface kind, const std::string& platform)
        : ContextBase(request), display_(display) {
        if (display_ == EGL_NO_DISPLAY) egl().fail("eglGetDisplay");
        EGLint major = 0, minor = 0;
        if (egl().initialize(display_, &major, &minor) == EGL_FALSE) egl().fail("eglInitialize");
        try {
            open(kind);
            makeCurrent();
            initialise("egl", platform, procAddress);
        } catch (...) {
            close();
            throw;
        }
    }
    ~EglContext() override { close(); }

    void makeCurrent() override {
        // With another backend's context current, EGL reports success and changes nothing: release that one
        // first.
        if (Context* other = currentContext(); other != nullptr && other != this) other->release();
        if (egl().makeCurrent(display_, surface_, surface_, context_) == EGL_FALSE)
            egl().fail("eglMakeCurrent");
        noteCurrent(this);
        if (loaded_) loadFunctions(procAddress);
        loaded_ = true;
    }
    void release() override {
        egl().makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (currentContext() == this) noteCurrent(nullptr);
    }

private:
    static Proc procAddress(const char* name) { return egl().getProcAddress(name); }

    void open(Surface kind) {
        if (egl().bindApi(EGL_OPENGL_API) == EGL_FALSE) egl().fail("eglBindAPI(EGL_OPENGL_API)");
        const EGLint wanted[] = {EGL_SURFACE_TYPE, kind == Surface::pbuffer ? EGL_PBUFFER_BIT : 0,
                                 EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (egl().chooseConfig(display_, wanted, &config, 1, &count) == EGL_FALSE)
            egl().fail("eglChooseConfig");
        if (count == 0) throw ContextError("no EGL configuration offers OpenGL");
        // EGL 1.4 knows no EGL_CONTEXT_OPENGL_DEBUG: the flag of EGL_KHR_create_context serves both.
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION_KHR,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                     EGL_CONTEXT_FLAGS_KHR,
                                     request_.debug ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0,
                                     EGL_NONE};
        context_ = egl().createContext(display_, config, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) egl().fail("eglCreateContext for OpenGL 3.3 core");
        if (kind == Surface::none) return;
        const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
        surface_ = egl().createPbuffer(display_, config, size);
        if (surface_ == EGL_NO_SURFACE) egl().fail("eglCreatePbufferSurface");
    }

    void close() {
        if (currentContext() == this) release();
        if (surface_ != EGL_NO_SURFACE) egl().destroySurface(display_, surface_);
        if (context_ != EGL_NO_CONTEXT) egl().destroyContext(display_, context_);
        // The display is shared by every context on it and costs nothing: it is not terminated.
    }

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
    bool loaded_ = false;
};

EGLDisplay platformDisplay(EGLenum platform, void* native) {
    return egl().extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT")(platform, native,
                                                                                        nullptr);
}

}  // namespace

std::vector<EglDevice> eglDevices() {
    std::vector<EglDevice> result;
    const std::vector<EGLDeviceEXT> handles = deviceHandles();
    const auto queryString = egl().extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    for (size_t i = 0; i < handles.size(); ++i) {
        EglDevice device;
        device.index = static_cast<int>(i);
        const char* extensions = queryString(handles[i], EGL_EXTENSIONS);
        device.software =
            extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
        const bool hasFile =
            extensions != nullptr && std::strstr(extensions, "EGL_EXT_device_drm") != nullptr;
        const char* file = hasFile ? queryString(handles[i], EGL_DRM_DEVICE_FILE_EXT) : nullptr;
        device.name = file != nullptr ? file : device.software ? "software" : "no device file";
        result.push_back(device);
    }
    return result;
}

std::unique_ptr<Context> makeEglDeviceContext(const ContextRequest& request, int index) {
    const std::vector<EGLDeviceEXT> handles = deviceHandles();
    if (index < 0 || static_cast<size_t>(index) >= handles.size()) throw ContextError("no such EGL device");
    return std::make_unique<EglContext>(
        request, platformDisplay(EGL_PLATFORM_DEVICE_EXT, handles[static_cast<size_t>(index)]), Surface::none,
        "device " + std::to_string(index) + " (" + eglDevices()[static_cast<size_t>(index)].name + ")");
}

std::unique_ptr<Context> makeEglSurfacelessContext(const ContextRequest& request) {
    if (!egl().hasClientExtension("EGL_MESA_platform_surfaceless"))
        throw ContextError("EGL_MESA_platform_surfaceless is absent");
    return std::make_unique<EglContext>(request, platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr),
                                        Surface::none, "surfaceless");
}

std::unique_ptr<Context> makeEglPbufferContext(const ContextRequest& request) {
    return std::make_unique<EglContext>(request, egl().getDisplay(EGL_DEFAULT_DISPLAY), Surface::pbuffer,
                                        "pbuffer");
}

}  // namespace lobe::gl
