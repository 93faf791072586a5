/// Tests that need OpenGL run once on every backend that this machine has.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "gl/context.hpp"
#include "gl/program.hpp"

namespace lobe::test {

/// The parameter is a backend's name. A backend that this machine lacks is skipped with the reason; that at
/// least one exists is a test of its own (registry_test.cpp).
class OnContext : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        gl::ContextRequest request;
        request.backend = gl::parseBackend(GetParam());
        try {
            context_ = gl::Context::create(request);
        } catch (const ContextError& error) {
            GTEST_SKIP() << error.what();
        }
        // Set by softpipe_test.cpp: a run that was to be on another driver must not pass on this one.
        if (const char* expected = std::getenv("LOBE_TEST_RENDERER")) {
            ASSERT_NE(context_->info().renderer.find(expected), std::string::npos)
                << context_->info().renderer;
        }
        library_ = std::make_unique<gl::ShaderLibrary>(shaderDirectory());
    }

    const gl::ShaderLibrary& library() const { return *library_; }
    const gl::ContextInfo& info() const { return context_->info(); }

private:
    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<gl::ShaderLibrary> library_;
};

inline std::string backendTestName(const testing::TestParamInfo<std::string>& info) {
    return info.param;
}

/// Smaller tables on slow drivers.
inline int tableScale(int full) {
    const char* divisor = std::getenv("LOBE_TEST_DIVISOR");
    return divisor == nullptr ? full : std::max(1, full / std::atoi(divisor));
}

}  // namespace lobe::test

#define LOBE_ON_EVERY_BACKEND(suite) \
    INSTANTIATE_TEST_SUITE_P(, suite, testing::Values("egl", "osmesa"), ::lobe::test::backendTestName)
