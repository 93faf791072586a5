// What goes wrong with OpenGL is said, with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.hpp"
#include "drawing.hpp"
#include "gl/backends.hpp"
#include "gl/debug.hpp"

namespace lobe::gl {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The message that `action` throws.
template<class Failure, class Action>
std::string messageOf(Action action) {
    try {
        action();
    } catch (const Failure& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

class GlErrorTest : public testing::TestWithParam<Backend> {
protected:
    static std::unique_ptr<Context> make(bool debug) {
        return Context::create({.backend = GetParam(), .debug = debug});
    }
};

TEST_P(GlErrorTest, CheckErrorsNamesPlaceAndErrorAndForgetsIt) {
    const auto context = make(false);
    glEnable(GL_TEXTURE_MAG_FILTER);
    EXPECT_THAT(messageOf<ContextError>([] { checkErrors("light.point"); }),
                HasSubstr("light.point: GL_INVALID_ENUM"));
    EXPECT_NO_THROW(checkErrors("light.point"));
}

TEST_P(GlErrorTest, ADebugContextNamesTheScopesOfAnError) {
    const auto context = make(true);
    ASSERT_TRUE(context->info().debugOutput) << "every Mesa has GL_KHR_debug";
    takeDebugError();
    {
        const DebugScope frame("frame");
        const DebugScope pass("light.point");
        glBindFramebuffer(GL_FRAMEBUFFER, 4711);
    }
    EXPECT_THAT(
        messageOf<ContextError>([] { checkErrors("after the frame"); }),
        AllOf(HasSubstr("after the frame: GL_INVALID_OPERATION"), HasSubstr("frame > light.point: error")));
    EXPECT_EQ(takeDebugError(), "") << "it is told once";
}

TEST_P(GlErrorTest, AnErrorOutsideAllScopesDoesNotKeepOlderOnes) {
    const auto context = make(true);
    takeDebugError();
    { const DebugScope over("over"); }
    glBindFramebuffer(GL_FRAMEBUFFER, 4711);
    EXPECT_THAT(takeDebugError(), AllOf(HasSubstr("OpenGL: error"), testing::Not(HasSubstr("over:"))));
    EXPECT_THROW(checkErrors("here"), ContextError);
}

TEST_P(GlErrorTest, ACorrectFrameReportsNothing) {
    const auto context = make(true);
    takeDebugError();
    test::drawPicture();
    EXPECT_EQ(takeDebugError(), "");
}

TEST_P(GlErrorTest, AnIncompleteFramebufferIsNamed) {
    const auto context = make(false);
    const Texture small = makeTarget(GL_RGBA8, 4, 4);
    const Texture depth = makeTarget(GL_DEPTH_COMPONENT24, 4, 4);
    const auto depthAsColor = [&] { makeFramebuffer({small.id(), depth.id()}, 0, GL_DEPTH_ATTACHMENT); };
    EXPECT_THAT(messageOf<ContextError>(depthAsColor),
                AllOf(HasSubstr("framebuffer of 2 colour targets"),
                      HasSubstr("GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT")));
    const auto nothing = [] { makeFramebuffer({}, 0, GL_DEPTH_ATTACHMENT); };
    EXPECT_THAT(messageOf<ContextError>(nothing), HasSubstr("GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT"));
}

TEST_P(GlErrorTest, AFormatWithoutDescriptionIsAMistakeOfTheProgram) {
    const auto context = make(false);
    EXPECT_THAT(messageOf<std::logic_error>([] { makeTarget(GL_TEXTURE_2D, 4, 4); }), HasSubstr("0x0de1"));
}

INSTANTIATE_TEST_SUITE_P(, GlErrorTest, testing::Values(Backend::egl, Backend::osmesa), test::backendOf);

/// In a process of its own: the libraries are opened once a process. Prints what create() throws, exits with
/// its code.
[[noreturn]] void createWithoutLibraries(const ContextRequest& request,
                                         const char* without = "EGL OSMESA GLFW") {
    for (const char* library : {"EGL", "OSMESA", "GLFW"})
        if (std::string(without).find(library) != std::string::npos) {
            const std::string variable = std::string("LOBE_") + library + "_LIBRARY";
            setenv(variable.c_str(), ("/nowhere/" + std::string(library) + ".so").c_str(), 1);
        }
    try {
        const auto context = Context::create(request);
        std::fprintf(stderr, "made %s", context->info().backend.c_str());
        std::_Exit(0);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s", error.what());
        std::_Exit(static_cast<int>(error.exitCode()));
    }
}

class NoContextTest : public testing::Test {
protected:
    void SetUp() override { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};
using NoContextDeathTest = NoContextTest;

TEST_F(NoContextDeathTest, WithoutAnyLibraryEverythingTriedIsListedWithItsReason) {
    // One line, in the order of the attempts, each with the loader's reason.
    EXPECT_EXIT(createWithoutLibraries({}), testing::ExitedWithCode(static_cast<int>(ExitCode::noContext)),
                "^no OpenGL 3.3 context; tried EGL devices: [^\n]*/nowhere/EGL.so[^\n]*No such file[^\n]*; "
                "egl surfaceless: [^\n]*/nowhere/EGL.so[^\n]*; egl pbuffer: [^\n]*/nowhere/EGL.so[^\n]*; "
                "osmesa memory: [^\n]*/nowhere/OSMESA.so[^\n]*; glfw window: "
                "[^\n]*/nowhere/GLFW.so[^\n]*libosmesa6[^\n]*$");
}

TEST_F(NoContextDeathTest, AskedForOneBackendOnlyThatOneIsTried) {
    EXPECT_EXIT(
        createWithoutLibraries({.backend = Backend::osmesa}),
        testing::ExitedWithCode(static_cast<int>(ExitCode::noContext)),
        "^no OpenGL 3.3 context; tried osmesa memory: [^\n]*/nowhere/OSMESA.so: [^;\n]*; on Debian[^\n]*$");
}

TEST_F(NoContextDeathTest, WithoutEglOsmesaIsTaken) {
    EXPECT_EXIT(createWithoutLibraries({}, "EGL"), testing::ExitedWithCode(0), "made osmesa");
}

/// Mesa, told to offer OpenGL 3.0 only, as old drivers do; then told nothing, in the same process.
[[noreturn]] void createOnOldDriver(Backend backend) {
    setenv("MESA_GL_VERSION_OVERRIDE", "3.0", 1);
    try {
        Context::create({.backend = backend});
    } catch (const ContextError& error) {
        std::fprintf(stderr, "%s", error.what());
        std::_Exit(currentContext() == nullptr ? 4 : 1);
    }
    std::_Exit(0);
}

TEST_F(NoContextDeathTest, AnOldDriverIsRefusedAndLeavesNothingCurrent) {
    EXPECT_EXIT(createOnOldDriver(Backend::egl), testing::ExitedWithCode(4), "no OpenGL 3.3 context; tried ");
    EXPECT_EXIT(createOnOldDriver(Backend::osmesa), testing::ExitedWithCode(4), "osmesa memory: ");
}

TEST_F(NoContextDeathTest, ADeviceAskedForWithoutEglSaysWhyThereIsNone) {
    EXPECT_EXIT(createWithoutLibraries({.device = 0}),
                testing::ExitedWithCode(static_cast<int>(ExitCode::noContext)), "/nowhere/EGL.so");
}

}  // namespace
}  // namespace lobe::gl
