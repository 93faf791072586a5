/// Where the files that belong to Lobe are: shaders, workers, the parts of report pages; and those that it
/// keeps. Never by the working directory.
#pragma once

#include <filesystem>
#include <string>

namespace lobe {

/// The folder of the GLSL library ("shaders/glsl"). Looked for in this order: $LOBE_SHADER_DIR;
/// ../share/lobe/glsl beside the running program; the installed package that it was built with; the folder it
/// was installed to; the source tree it was built from. Throws InputError that names every place tried.
std::filesystem::path shaderDirectory();

/// The folder of the parts of report.html: frame, style, scripts, chart library. Looked for in:
/// $LOBE_PAGE_DIR; ../share/lobe/page beside the running program; the package; the folder it was installed
/// to; the build tree. Throws InputError as above.
std::filesystem::path pageDirectory();

/// A helper program (NAME without folder). Looked for in: $LOBE_WORKER_DIR; beside the running program;
/// ../libexec/lobe beside it; the package; the installed libexec folder; the build tree. Throws InputError as
/// above.
std::filesystem::path workerProgram(const std::string& name);

/// Where results are kept that take time to make: $XDG_CACHE_HOME/lobe/PART, else ~/.cache/lobe/PART; empty
/// without a home. The folder need not exist.
std::filesystem::path cacheFolder(const std::string& part);

}  // namespace lobe
