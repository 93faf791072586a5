/// The ways to a context. Each function throws ContextError with one reason.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/context.hpp"

namespace lobe::gl {

/// What all contexts do once they are current.
class ContextBase : public Context {
public:
    explicit ContextBase(const ContextRequest& request) : request_(request) {}

protected:
    using GetProc = void (*(*)(const char*))();
    /// Reads the function table, which differs from backend to backend, through `getProc`.
    void loadFunctions(GetProc getProc) const;
    /// To be called once, current: fills info_, refuses versions below 3.3, turns on debug output.
    void initialise(const std::string& backend, const std::string& platform, GetProc getProc);
    ContextRequest request_;
};

struct EglDevice {
    int index = -1;    ///< for --device
    std::string name;  ///< "/dev/dri/card0", "software"
    bool software = false;
};

/// Devices in the order of their index. Throws if the library or its device extensions are absent.
std::vector<EglDevice> eglDevices();
std::unique_ptr<Context> makeEglDeviceContext(const ContextRequest& request, int device);
std::unique_ptr<Context> makeEglSurfacelessContext(const ContextRequest& request);
/// The default display with a pbuffer: what is left where neither devices nor surfaceless contexts exist.
std::unique_ptr<Context> makeEglPbufferContext(const ContextRequest& request);
std::unique_ptr<Context> makeOsmesaContext(const ContextRequest& request);
std::unique_ptr<Context> makeGlfwContext(const ContextRequest& request);

/// The context that is current through this program, so that another one can release it first. One thread at
/// a time.
void noteCurrent(Context* context);
Context* currentContext();

}  // namespace lobe::gl
