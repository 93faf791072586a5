/// A shared library opened at run time.
#pragma once

#include <string>
#include <vector>

namespace lobe::gl {

class DynamicLibrary {
public:
    /// The first of `names` that opens. `overrideVariable` names an environment variable whose value, if set,
    /// is the only name tried. Throws ContextError with the loader's own reason.
    DynamicLibrary(const std::vector<std::string>& names, const char* overrideVariable);
    ~DynamicLibrary();
    DynamicLibrary(const DynamicLibrary&) = delete;
    DynamicLibrary& operator=(const DynamicLibrary&) = delete;

    /// Throws ContextError if the library has no such function.
    template<class Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(symbol(name));
    }

private:
    void* symbol(const char* name) const;
    void* handle_ = nullptr;
    std::string name_;
};

}  // namespace lobe::gl
