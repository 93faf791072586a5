// A context made by GLFW needs a display: CTest runs this under Xvfb (gl.display); elsewhere without a
// display it is refused with GLFW's own reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.hpp"
#include "drawing.hpp"

namespace lobe::gl {
namespace {

bool hasDisplay() {
    return std::getenv("DISPLAY") != nullptr;
}

TEST(GlfwDisplay, DrawsTheSamePictureAsOsmesaAndTakesTurnsWithIt) {
    if (!hasDisplay()) GTEST_SKIP() << "no display; CTest's gl.display has one";
    const auto glfw = Context::create({.backend = Backend::glfw});
    EXPECT_EQ(glfw->info().backend, "glfw");
    const std::vector<float> picture = test::drawPicture();
    const auto osmesa = Context::create({.backend = Backend::osmesa});
    const std::vector<float> other = test::drawPicture();
    glfw->makeCurrent();
    EXPECT_EQ(picture, test::drawPicture());
    if (glfw->info().renderer == osmesa->info().renderer) {
        EXPECT_EQ(picture, other);
    }
}

TEST(GlfwDisplay, IsMadeAndEndedManyTimes) {
    if (!hasDisplay()) GTEST_SKIP() << "no display; CTest's gl.display has one";
    for (int i = 0; i < 5; ++i)
        EXPECT_FALSE(Context::create({.backend = Backend::glfw})->info().renderer.empty());
}

TEST(Glfw, WithoutADisplayIsRefusedWithItsReason) {
    if (hasDisplay()) GTEST_SKIP() << "there is a display";
    try {
        Context::create({.backend = Backend::glfw});
        ADD_FAILURE();
    } catch (const ContextError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("glfw window: glfw"));
    }
}

}  // namespace
}  // namespace lobe::gl
