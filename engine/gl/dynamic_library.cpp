#include "gl/dynamic_library.hpp"

#include <dlfcn.h>

#include <cstdlib>

#include "base/error.hpp"

namespace lobe::gl {

DynamicLibrary::DynamicLibrary(const std::vector<std::string>& names, const char* overrideVariable) {
    std::vector<std::string> candidates = names;
    if (const char* only = std::getenv(overrideVariable)) candidates = {only};
    std::string reason;
    for (const std::string& name : candidates) {
        handle_ = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
        name_ = name;
        if (handle_ != nullptr) return;
        reason = dlerror();
    }
    throw ContextError(reason);
}

// Never closed: drivers leave threads and exit handlers behind that outlive their contexts.
DynamicLibrary::~DynamicLibrary() = default;

void* DynamicLibrary::symbol(const char* name) const {
    void* address = dlsym(handle_, name);
    if (address == nullptr) throw ContextError(name_ + " has no function " + name);
    return address;
}

}  // namespace lobe::gl
