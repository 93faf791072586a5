/// Shaders and a picture for the tests of contexts.
#pragma once

#include <glad/gl.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gl/context.hpp"
#include "gl/objects.hpp"
#include "gl/program.hpp"

namespace lobe::gl::test {

inline ShaderSource glsl(const std::string& file, const std::string& text, const Defines& defines = {}) {
    return ShaderLibrary("/nowhere").source(file, defines, {{file, text}});
}

inline std::string backendOf(const testing::TestParamInfo<Backend>& parameter) {
    return backendNames()[static_cast<size_t>(parameter.param)];
}

inline constexpr int kWidth = 160, kHeight = 120;

/// Everything that a driver may round in its own way: triangles in perspective that cross the near plane, a
/// texture with linear filter, pow, exp and sin, and additive blending into half floats. 4 floats a pixel.
std::vector<float> drawPicture();

}  // namespace lobe::gl::test
