// Contexts through OSMesa: Mesa's software rasteriser into memory. Its six names are declared here, so that
// building needs no package of it (it left Mesa with release 25.1).
#include "base/error.hpp"
#include "gl/backends.hpp"
#include "gl/dynamic_library.hpp"

namespace lobe::gl {
namespace {

using OsmesaHandle = struct OsmesaContextTag*;
using Proc = void (*)();

constexpr int kFormat = 0x22, kDepthBits = 0x30, kProfile = 0x33, kCoreProfile = 0x34, kMajor = 0x36,
              kMinor = 0x37;
constexpr unsigned kRgba = 0x1908, kUnsignedByte = 0x1401;

struct Osmesa {
    DynamicLibrary library{{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, "LOBE_OSMESA_LIBRARY"};
    OsmesaHandle (*createContext)(const int*, OsmesaHandle) =
        library.function<OsmesaHandle (*)(const int*, OsmesaHandle)>("OSMesaCreateContextAttribs");
    void (*destroyContext)(OsmesaHandle) = library.function<void (*)(OsmesaHandle)>("OSMesaDestroyContext");
    unsigned char (*makeCurrent)(OsmesaHandle, void*, unsigned, int, int) =
        library.function<unsigned char (*)(OsmesaHandle, void*, unsigned, int, int)>("OSMesaMakeCurrent");
    Proc (*getProcAddress)(const char*) = library.function<Proc (*)(const char*)>("OSMesaGetProcAddress");
};

Osmesa& osmesa() {
    static Osmesa instance;
    return instance;
}

class OsmesaContext final : public ContextBase {
public:
    explicit OsmesaContext(const ContextRequest& request) : ContextBase(request) {
        const int attributes[] = {
            kFormat, static_cast<int>(kRgba), kDepthBits, 0, kProfile, kCoreProfile, kMajor, 3, kMinor, 3, 0};
        context_ = osmesa().createContext(attributes, nullptr);
        if (context_ == nullptr)
            throw ContextError("OSMesaCreateContextAttribs gives no OpenGL 3.3 core context");
        try {
            makeCurrent();
            initialise("osmesa", "memory", procAddress);
        } catch (...) {
            close();
            throw;
        }
    }
    ~OsmesaContext() override { close(); }
    void makeCurrent() override {
        if (Context* other = currentContext(); other != nullptr && other != this) other->release();
        if (osmesa().makeCurrent(context_, buffer_, kUnsignedByte, kSide, kSide) == 0)
            throw ContextError("OSMesaMakeCurrent failed");
        noteCurrent(this);
        if (loaded_) loadFunctions(procAddress);
        loaded_ = true;
    }
    void release() override {
        osmesa().makeCurrent(nullptr, nullptr, 0, 0, 0);
        if (currentContext() == this) noteCurrent(nullptr);
    }

private:
    void close() {
        if (currentContext() == this) release();
        osmesa().destroyContext(context_);
    }
    static Proc procAddress(const char* name) { return osmesa().getProcAddress(name); }
    static constexpr int kSide = 16;
    OsmesaHandle context_ = nullptr;
    unsigned char buffer_[kSide * kSide * 4] =
        {};  ///< OSMesa wants a default framebuffer; nothing is drawn to it
    bool loaded_ = false;
};

}  // namespace

std::unique_ptr<Context> makeOsmesaContext(const ContextRequest& request) {
    return std::make_unique<OsmesaContext>(request);
}

}  // namespace lobe::gl
