/// Every GL error with its place, in debug contexts.
#pragma once

#include <string>

namespace lobe::gl {

/// Reports each error of the current context as it happens, on standard error, with the scopes that it
/// happened in; checkErrors() then throws with the first message. Needs KHR_debug.
void enableDebugOutput();

/// Names what runs until the end of the block: "light.point". Costs nothing in contexts without debug output.
class DebugScope {
public:
    explicit DebugScope(const std::string& name);
    ~DebugScope();
    DebugScope(const DebugScope&) = delete;
    DebugScope& operator=(const DebugScope&) = delete;
};

/// The first error reported since the last call, or nothing.
std::string takeDebugError();

}  // namespace lobe::gl
