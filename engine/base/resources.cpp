#include "base/resources.hpp"

#include <cstdlib>
#include <vector>

#include "base/error.hpp"
#include "lobe_paths.hpp"

// Where the installed package has them. Its CMake file adds a source that defines these to programs built
// with it (cmake/lobe_place.cpp.in); other programs have none.
extern "C" __attribute__((weak)) const char* lobePackageShaders();
extern "C" __attribute__((weak)) const char* lobePackageWorkers();
extern "C" __attribute__((weak)) const char* lobePackagePage();

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
    const fs::path package = lobePackageShaders != nullptr ? lobePackageShaders() : "";
    return firstThatExists("GLSL library",
                           {programFolder() / ".." / "share" / "lobe" / "glsl", package,
                            fs::path(paths::kInstalledShaders), fs::path(paths::kSourceShaders)});
}

fs::path pageDirectory() {
    const fs::path asked = fromEnvironment("LOBE_PAGE_DIR");
    if (!asked.empty()) return firstThatExists("LOBE_PAGE_DIR", {asked});
    const fs::path package = lobePackagePage != nullptr ? lobePackagePage() : "";
    return firstThatExists("report page", {programFolder() / ".." / "share" / "lobe" / "page", package,
                                           fs::path(paths::kInstalledPage), fs::path(paths::kBuiltPage)});
}

fs::path workerProgram(const std::string& name) {
    const fs::path asked = fromEnvironment("LOBE_WORKER_DIR");
    if (!asked.empty()) return firstThatExists(name + " (LOBE_WORKER_DIR)", {asked / name});
    const fs::path package =
        lobePackageWorkers != nullptr ? fs::path(lobePackageWorkers()) / name : fs::path();
    return firstThatExists(
        "helper program " + name,
        {programFolder() / name, programFolder() / ".." / "libexec" / "lobe" / name, package,
         fs::path(paths::kInstalledWorkers) / name, fs::path(paths::kBuiltWorkers) / name});
}

fs::path cacheFolder(const std::string& part) {
    if (const fs::path cache = fromEnvironment("XDG_CACHE_HOME"); !cache.empty())
        return cache / "lobe" / part;
    if (const fs::path home = fromEnvironment("HOME"); !home.empty()) return home / ".cache" / "lobe" / part;
    return {};
}

}  // namespace lobe
