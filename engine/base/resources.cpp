#include "base/resources.hpp"

#include <cstdlib>
#include <vector>

#include "base/error.hpp"
#include "lobe_paths.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;

fs::path programFolder() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    return failed ? fs::path() : program.parent_path();
}

fs::path firstThatExists(const std::string& what, const std::vector<fs::path>& places) {
    std::string tried;
    for (const fs::path& place : places) {
        std::error_code ignored;
        if (!place.empty() && fs::exists(place, ignored)) return place;
        if (!place.empty()) tried += (tried.empty() ? "" : ", ") + place.string();
    }
    throw InputError(what + " not found; tried " + tried + "; is the installation complete?");
}

fs::path fromEnvironment(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr ? fs::path(value) : fs::path();
}

}  // namespace

fs::path shaderDirectory() {
    const fs::path asked = fromEnvironment("LOBE_SHADER_DIR");
    if (!asked.empty()) return firstThatExists("LOBE_SHADER_DIR", {asked});
    return firstThatExists("GLSL library", {programFolder() / ".." / "share" / "lobe" / "glsl",
                                            fs::path(paths::kInstalledShaders), fs::path(paths::kSourceShaders)});
}

fs::path workerProgram(const std::string& name) {
    const fs::path asked = fromEnvironment("LOBE_WORKER_DIR");
    if (!asked.empty()) return firstThatExists(name + " (LOBE_WORKER_DIR)", {asked / name});
    return firstThatExists("helper program " + name,
                           {programFolder() / name, programFolder() / ".." / "libexec" / "lobe" / name,
                            fs::path(paths::kInstalledWorkers) / name, fs::path(paths::kBuiltWorkers) / name});
}

}  // namespace lobe
