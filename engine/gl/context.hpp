/// OpenGL 3.3 core contexts without a window: EGL (devices, surfaceless, pbuffer), OSMesa, GLFW; libraries
/// opened at run time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lobe::gl {

enum class Backend { automatic, egl, osmesa, glfw };
Backend parseBackend(const std::string& name);  ///< "auto", "egl", "osmesa", "glfw"; throws UsageError
const std::vector<std::string>& backendNames();

/// What a made context says of itself.
struct ContextInfo {
    std::string backend;   ///< "egl", "osmesa", "glfw"
    std::string platform;  ///< "device 0 (/dev/dri/card0)", "surfaceless", "pbuffer", "memory", "window"
    std::string vendor, renderer, version, glslVersion;
    bool software = false;  ///< llvmpipe, softpipe, swrast
    bool clipControl = false, anisotropicFilter = false, debugOutput = false;
    bool reliableTimers = false;
    int maxTextureSize = 0, maxColorAttachments = 0, maxDrawBuffers = 0, maxTextureBufferTexels = 0;
    int maxUniformBlockSize = 0, maxSamples = 0, maxArrayLayers = 0, maxFragmentUniformComponents = 0;
    std::vector<std::string> extensions;
};

/// One way to a context, tried or not.
struct Candidate {
    Backend backend;
    std::string platform;
    int device = -1;                  ///< EGL device index for --device
    std::optional<ContextInfo> info;  ///< if a context could be made
    std::string failure;              ///< otherwise why not, one line
};

struct ContextRequest {
    Backend backend = Backend::automatic;
    int device = -1;  ///< EGL device index; -1: any
#ifdef NDEBUG
    static constexpr bool kDebugByDefault = false;
#else
    static constexpr bool kDebugByDefault = true;
#endif
    bool debug = kDebugByDefault;  ///< report every GL error with its place; on in debug builds
    std::vector<std::string> maskedExtensions = {};  ///< behave as if these were absent (tests)
};

/// A context that is current on the thread that made it. One thread at a time; release() before another
/// thread, or another context, takes over.
class Context {
public:
    /// `automatic`: EGL on a hardware device, EGL surfaceless, OSMesa, GLFW. Throws ContextError that names
    /// everything tried and why each failed.
    static std::unique_ptr<Context> create(const ContextRequest& request = {});

    virtual ~Context() = default;
    virtual void
    makeCurrent() = 0;  ///< also reloads the function table, which differs from backend to backend
    virtual void release() = 0;
    const ContextInfo& info() const { return info_; }

protected:
    ContextInfo info_;
};

/// Everything that could be tried here, each with its outcome: `lobe info`.
std::vector<Candidate> probe();

}  // namespace lobe::gl
