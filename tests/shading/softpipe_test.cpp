/// The same checks on Mesa's other software driver, whose transcendentals are nearly exact and whose
/// denormals are kept: what fails on llvmpipe and passes here is the built-in's fault. Drivers are chosen
/// once a process, so a child runs them.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "gl/context.hpp"

extern char** environ;

namespace lobe {
namespace {

/// Exit status of this program run with `filter` and more environment variables.
int runSelf(const std::string& filter, const std::vector<std::string>& variables) {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe");
    std::vector<std::string> arguments{self, "--gtest_filter=" + filter, "--gtest_brief=1"};
    std::vector<std::string> environment = variables;
    for (char** variable = environ; *variable != nullptr; ++variable)
        // A test runner's sharding and report files are not for the child.
        if (std::string(*variable).rfind("GTEST_", 0) != 0) environment.emplace_back(*variable);
    std::vector<char*> argv, envp;
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    for (std::string& variable : environment)
        envp.push_back(variable.data());
    argv.push_back(nullptr);
    envp.push_back(nullptr);
    pid_t child = 0;
    if (posix_spawn(&child, self.c_str(), nullptr, nullptr, argv.data(), envp.data()) != 0) return -1;
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Softpipe, PassesTheSameChecks) {
    gl::ContextRequest request;
    request.backend = gl::Backend::egl;
    try {
        const auto context = gl::Context::create(request);
        if (!context->info().software)
            GTEST_SKIP() << "EGL gave a hardware device: " << context->info().renderer;
    } catch (const ContextError& error) {
        GTEST_SKIP() << error.what();
    }
    EXPECT_EQ(runSelf("BrdfTwin.*/egl:Punctual.*/egl:Octahedral.*/egl:GlslBasics.*/egl:GlslNumeric.*/egl",
                      {"GALLIUM_DRIVER=softpipe", "LOBE_TEST_RENDERER=softpipe", "LOBE_TEST_DIVISOR=20"}),
              0);
}

}  // namespace
}  // namespace lobe
