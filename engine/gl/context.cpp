#include "gl/context.hpp"

#include <glad/gl.h>
#include <malloc.h>

#include <algorithm>
#include <functional>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "gl/backends.hpp"
#include "gl/debug.hpp"

namespace lobe::gl {
namespace {

std::string text(GLenum name) {
    const auto* value = reinterpret_cast<const char*>(glGetString(name));
    return value != nullptr ? value : "";
}

int integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

bool isSoftware(const std::string& renderer) {
    static constexpr const char* kRasterisers[] = {"llvmpipe", "softpipe", "swrast", "SWR"};
    return std::any_of(std::begin(kRasterisers), std::end(kRasterisers),
                       [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

thread_local Context* current = nullptr;

/// One way to a context, by name.
struct Way {
    Backend backend;
    std::string platform;
    int device;
    std::function<std::unique_ptr<Context>(const ContextRequest&)> make;
};

/// All ways, best first. `failures` gets what kept devices from being listed.
std::vector<Way> ways(const ContextRequest& request, std::vector<std::string>& failures) {
    std::vector<Way> result;
    const auto wants = [&](Backend backend) {
        return request.backend == Backend::automatic || request.backend == backend;
    };
    if (wants(Backend::egl)) {
        std::vector<EglDevice> devices;
        try {
            devices = eglDevices();
        } catch (const ContextError& error) {
            failures.push_back(std::string("EGL devices: ") + error.what());
        }
        const auto add = [&](const EglDevice& device) {
            result.push_back(
                {Backend::egl, "device " + std::to_string(device.index) + " (" + device.name + ")",
                 device.index,
                 [index = device.index](const ContextRequest& r) { return makeEglDeviceContext(r, index); }});
        };
        if (request.device >= 0) {
            for (const EglDevice& device : devices)
                if (device.index == request.device) add(device);
            if (!failures.empty())
                throw ContextError("device " + std::to_string(request.device) + ": " + failures.back());
            if (result.empty())
                throw UsageError("device " + std::to_string(request.device) + "; expected " +
                                 (devices.empty() ? "none: EGL lists no devices"
                                                  : "0 to " + std::to_string(devices.size() - 1) +
                                                        " (lobe info lists them)"));
            return result;
        }
        for (const EglDevice& device : devices)
            if (!device.software) add(device);
        result.push_back({Backend::egl, "surfaceless", -1, makeEglSurfacelessContext});
        for (const EglDevice& device : devices)
            if (device.software) add(device);
        result.push_back({Backend::egl, "pbuffer", -1, makeEglPbufferContext});
    } else if (request.device >= 0) {
        throw UsageError("device " + std::to_string(request.device) +
                         "; expected none with this backend: devices are EGL's");
    }
    if (wants(Backend::osmesa)) result.push_back({Backend::osmesa, "memory", -1, makeOsmesaContext});
    if (wants(Backend::glfw)) result.push_back({Backend::glfw, "window", -1, makeGlfwContext});
    return result;
}

}  // namespace

const std::vector<std::string>& backendNames() {
    static const std::vector<std::string> names = {"auto", "egl", "osmesa", "glfw"};
    return names;
}

Backend parseBackend(const std::string& name) {
    const auto& names = backendNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw UsageError("backend '" + name + "'; expected auto, egl, osmesa or glfw" +
                         didYouMean(name, names));
    return static_cast<Backend>(found - names.begin());
}

void noteCurrent(Context* context) {
    current = context;
}
Context* currentContext() {
    return current;
}

void ContextBase::loadFunctions(GetProc getProc) const {
    if (gladLoadGL(getProc) == 0) throw ContextError("the driver gives no OpenGL functions");
    const std::pair<const char*, int*> flags[] = {
        {"GL_ARB_clip_control", &GLAD_GL_ARB_clip_control},
        {"GL_KHR_debug", &GLAD_GL_KHR_debug},
        {"GL_ARB_timer_query", &GLAD_GL_ARB_timer_query},
        {"GL_EXT_texture_filter_anisotropic", &GLAD_GL_EXT_texture_filter_anisotropic},
        {"GL_ARB_texture_filter_anisotropic", &GLAD_GL_ARB_texture_filter_anisotropic}};
    for (const std::string& extension : request_.maskedExtensions)
        for (const auto& [name, flag] : flags)
            if (extension == name) *flag = 0;
}

void ContextBase::initialise(const std::string& backend, const std::string& platform, GetProc getProc) {
    loadFunctions(getProc);
    info_.backend = backend;
    info_.platform = platform;
    info_.vendor = text(GL_VENDOR);
    info_.renderer = text(GL_RENDERER);
    info_.version = text(GL_VERSION);
    info_.glslVersion = text(GL_SHADING_LANGUAGE_VERSION);
    if (!GLAD_GL_VERSION_3_3)
        throw ContextError("OpenGL " + info_.version + " of " + info_.renderer + "; expected 3.3 or newer");
    info_.software = isSoftware(info_.renderer);
    const int count = integer(GL_NUM_EXTENSIONS);
    for (int i = 0; i < count; ++i) {
        const std::string extension =
            reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
        const auto& masked = request_.maskedExtensions;
        if (std::find(masked.begin(), masked.end(), extension) == masked.end())
            info_.extensions.push_back(extension);
    }
    const auto has = [this](const char* name) {
        return std::find(info_.extensions.begin(), info_.extensions.end(), name) != info_.extensions.end();
    };
    info_.clipControl = has("GL_ARB_clip_control");
    info_.anisotropicFilter =
        has("GL_EXT_texture_filter_anisotropic") || has("GL_ARB_texture_filter_anisotropic");
    info_.debugOutput = has("GL_KHR_debug");
    info_.reliableTimers = !info_.software;
    info_.maxTextureSize = integer(GL_MAX_TEXTURE_SIZE);
    info_.maxColorAttachments = integer(GL_MAX_COLOR_ATTACHMENTS);
    info_.maxDrawBuffers = integer(GL_MAX_DRAW_BUFFERS);
    info_.maxTextureBufferTexels = integer(GL_MAX_TEXTURE_BUFFER_SIZE);
    info_.maxUniformBlockSize = integer(GL_MAX_UNIFORM_BLOCK_SIZE);
    info_.maxSamples = integer(GL_MAX_SAMPLES);
    info_.maxArrayLayers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
    info_.maxFragmentUniformComponents = integer(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS);
    // Software drivers allocate each frame's bins anew; letting glibc give the memory back between draws
    // costs more than the draws themselves.
    if (info_.software) mallopt(M_TRIM_THRESHOLD, 256 << 20);
    if (request_.debug && info_.debugOutput) enableDebugOutput();
}

std::unique_ptr<Context> Context::create(const ContextRequest& request) {
    std::vector<std::string> failures;
    for (const Way& way : ways(request, failures)) {
        try {
            return way.make(request);
        } catch (const ContextError& error) {
            failures.push_back(backendNames()[static_cast<size_t>(way.backend)] + " " + way.platform + ": " +
                               error.what());
        }
    }
    std::string message = "no OpenGL 3.3 context; tried ";
    for (size_t i = 0; i < failures.size(); ++i)
        message += (i ? "; " : "") + failures[i];
    throw ContextError(message +
                       "; on Debian, libegl1 with libgl1-mesa-dri, or libosmesa6, give a software renderer");
}

std::vector<Candidate> probe() {
    std::vector<Candidate> candidates;
    std::vector<std::string> failures;
    for (const Way& way : ways({}, failures)) {
        Candidate candidate{way.backend, way.platform, way.device, {}, {}};
        try {
            candidate.info = way.make({})->info();
        } catch (const ContextError& error) {
            candidate.failure = error.what();
        }
        candidates.push_back(std::move(candidate));
    }
    for (const std::string& failure : failures)
        candidates.push_back({Backend::egl, "devices", -1, {}, failure});
    return candidates;
}

}  // namespace lobe::gl
