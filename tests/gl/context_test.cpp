// Contexts of each backend: what they offer, that they agree bit for bit, and that they can take turns.
#include "gl/context.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <thread>

#include "base/error.hpp"
#include "drawing.hpp"
#include "gl/backends.hpp"

namespace lobe::gl {
namespace {

using test::drawPicture;
using testing::HasSubstr;

/// Index of the first float whose bits differ, -1 if none does.
long firstDifference(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size()) return 0;
    for (size_t i = 0; i < a.size(); ++i)
        if (std::memcmp(&a[i], &b[i], sizeof(float)) != 0) return static_cast<long>(i);
    return -1;
}

class ContextTest : public testing::TestWithParam<Backend> {};

TEST_P(ContextTest, SaysWhatItOffers) {
    const auto context = Context::create({.backend = GetParam()});
    const ContextInfo& info = context->info();
    EXPECT_EQ(info.backend, backendNames()[static_cast<size_t>(GetParam())]);
    EXPECT_NE(info.renderer, "");
    EXPECT_NE(info.vendor, "");
    EXPECT_TRUE(GLAD_GL_VERSION_3_3);
    // The least that OpenGL 3.3 allows.
    EXPECT_GE(info.maxTextureSize, 1024);
    EXPECT_GE(info.maxColorAttachments, 8);
    EXPECT_GE(info.maxDrawBuffers, 8);
    EXPECT_GE(info.maxTextureBufferTexels, 65536);
    EXPECT_GE(info.maxUniformBlockSize, 16384);
    EXPECT_GE(info.maxSamples, 4);
    EXPECT_GE(info.maxArrayLayers, 256);
    EXPECT_GE(info.maxFragmentUniformComponents, 1024);
    EXPECT_FALSE(info.extensions.empty());
    if (info.software) {
        EXPECT_FALSE(info.reliableTimers);
    }
}

TEST_P(ContextTest, IsACoreProfile) {
    const auto context = Context::create({.backend = GetParam()});
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
}

TEST_P(ContextTest, DrawsAPictureWithSomethingInIt) {
    const auto context = Context::create({.backend = GetParam()});
    const std::vector<float> picture = drawPicture();
    const auto covered = static_cast<size_t>(std::count_if(
        picture.begin(), picture.end(), [](float value) { return value > 0.1f && value < 60000.0f; }));
    EXPECT_GT(covered, picture.size() / 2);
    EXPECT_TRUE(
        std::all_of(picture.begin(), picture.end(), [](float value) { return std::isfinite(value); }));
    EXPECT_EQ(firstDifference(picture, drawPicture()), -1) << "the same picture, drawn twice";
}

TEST_P(ContextTest, BehavesAsIfAMaskedExtensionWereAbsent) {
    const char* const masked = "GL_ARB_clip_control";
    const auto plain = Context::create({.backend = GetParam()});
    ASSERT_TRUE(plain->info().clipControl) << "every Mesa has it";
    const auto without = Context::create({.backend = GetParam(), .maskedExtensions = {masked}});
    EXPECT_FALSE(without->info().clipControl);
    EXPECT_THAT(without->info().extensions, testing::Not(testing::Contains(masked)));
    EXPECT_FALSE(GLAD_GL_ARB_clip_control);
    plain->makeCurrent();
    EXPECT_TRUE(GLAD_GL_ARB_clip_control);
    without->makeCurrent();
    EXPECT_FALSE(GLAD_GL_ARB_clip_control);
}

TEST_P(ContextTest, MasksEachExtensionThatTheEngineAsksFor) {
    const auto context =
        Context::create({.backend = GetParam(),
                         .maskedExtensions = {"GL_KHR_debug", "GL_EXT_texture_filter_anisotropic",
                                              "GL_ARB_texture_filter_anisotropic", "GL_ARB_timer_query"}});
    EXPECT_FALSE(context->info().debugOutput);
    EXPECT_FALSE(context->info().anisotropicFilter);
    EXPECT_FALSE(GLAD_GL_KHR_debug);
    EXPECT_FALSE(GLAD_GL_EXT_texture_filter_anisotropic);
    EXPECT_FALSE(GLAD_GL_ARB_texture_filter_anisotropic);
    EXPECT_FALSE(GLAD_GL_ARB_timer_query);
}

TEST_P(ContextTest, MovesToAnotherThreadAfterRelease) {
    const auto context = Context::create({.backend = GetParam()});
    const std::vector<float> here = drawPicture();
    context->release();
    EXPECT_EQ(currentContext(), nullptr);
    std::vector<float> there;
    std::thread([&] {
        context->makeCurrent();
        there = drawPicture();
        context->release();
    }).join();
    EXPECT_EQ(firstDifference(here, there), -1);
    context->makeCurrent();
    EXPECT_EQ(firstDifference(here, drawPicture()), -1);
}

TEST_P(ContextTest, CanBeMadeAndEndedManyTimes) {
    for (int i = 0; i < 20; ++i) {
        const auto context = Context::create({.backend = GetParam()});
        EXPECT_EQ(currentContext(), context.get());
    }
    EXPECT_EQ(currentContext(), nullptr);
}

TEST_P(ContextTest, EndingOneLeavesAnotherCurrent) {
    const auto stays = Context::create({.backend = GetParam()});
    auto goes = Context::create({.backend = GetParam()});
    stays->makeCurrent();
    goes.reset();
    EXPECT_EQ(currentContext(), stays.get());
    EXPECT_FALSE(drawPicture().empty());
}

INSTANTIATE_TEST_SUITE_P(, ContextTest, testing::Values(Backend::egl, Backend::osmesa), test::backendOf);

TEST(Contexts, EglAndOsmesaGiveTheSameBitsForTheSameMesa) {
    std::string renderers[2];
    std::vector<float> pictures[2];
    const Backend backends[] = {Backend::egl, Backend::osmesa};
    for (size_t i = 0; i < 2; ++i) {
        const auto context = Context::create({.backend = backends[i]});
        renderers[i] = context->info().renderer + " " + context->info().version;
        pictures[i] = drawPicture();
    }
    if (renderers[0] != renderers[1])
        GTEST_SKIP() << "two drivers: " << renderers[0] << " and " << renderers[1];
    const long at = firstDifference(pictures[0], pictures[1]);
    EXPECT_EQ(at, -1) << pictures[0][static_cast<size_t>(std::max(at, 0L))] << " and "
                      << pictures[1][static_cast<size_t>(std::max(at, 0L))];
}

TEST(Contexts, TakeTurnsOnOneThread) {
    const auto egl = Context::create({.backend = Backend::egl});
    const auto osmesa = Context::create({.backend = Backend::osmesa});
    Context* const order[] = {egl.get(), osmesa.get(), osmesa.get(), egl.get(), egl.get(), osmesa.get()};
    std::vector<std::pair<Context*, std::vector<float>>> drawn;
    for (Context* context : order) {
        context->makeCurrent();
        EXPECT_EQ(currentContext(), context);
        EXPECT_EQ(reinterpret_cast<const char*>(glGetString(GL_RENDERER)), context->info().renderer);
        std::vector<float> picture = drawPicture();
        for (const auto& [by, earlier] : drawn)
            EXPECT_TRUE(by != context || firstDifference(picture, earlier) == -1);
        drawn.emplace_back(context, std::move(picture));
    }
}

TEST(Contexts, EachKeepsItsOwnObjects) {
    const auto egl = Context::create({.backend = Backend::egl});
    std::vector<float> value = {1.0f, 2.0f, 3.0f, 4.0f};
    const TextureBuffer kept = makeTextureBuffer(GL_RGBA32F, value.data(), 16);
    const auto osmesa = Context::create({.backend = Backend::osmesa});
    drawPicture();
    egl->makeCurrent();
    std::vector<float> back(4);
    glBindBuffer(GL_TEXTURE_BUFFER, kept.buffer.id());
    glGetBufferSubData(GL_TEXTURE_BUFFER, 0, 16, back.data());
    EXPECT_EQ(back, value);
}

TEST(Contexts, RefuseADeviceThatIsNotThere) {
    for (const Backend backend : {Backend::automatic, Backend::egl, Backend::osmesa, Backend::glfw}) {
        try {
            Context::create({.backend = backend, .device = 4711});
            ADD_FAILURE();
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), HasSubstr("device 4711; expected"));
        }
    }
}

TEST(Contexts, OnADeviceSayWhichOne) {
    const std::vector<EglDevice> devices = eglDevices();
    ASSERT_FALSE(devices.empty());
    const EglDevice& last = devices.back();
    const auto context = Context::create({.device = last.index});
    EXPECT_EQ(context->info().backend, "egl");
    EXPECT_EQ(context->info().platform, "device " + std::to_string(last.index) + " (" + last.name + ")");
}

TEST(Contexts, ThatAreWantedNowhereAreRefused) {
    try {
        parseBackend("osmessa");
        ADD_FAILURE();
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(),
                    testing::AllOf(HasSubstr("osmessa"), HasSubstr("expected auto, egl, osmesa or glfw")));
    }
    EXPECT_EQ(parseBackend("auto"), Backend::automatic);
    EXPECT_EQ(parseBackend("glfw"), Backend::glfw);
}

TEST(Contexts, AreAllProbedAndNoneStaysCurrent) {
    const auto mine = Context::create({.backend = Backend::egl});
    const std::vector<Candidate> candidates = probe();
    const auto works = [&](Backend backend) {
        return std::any_of(candidates.begin(), candidates.end(),
                           [&](const Candidate& c) { return c.backend == backend && c.info.has_value(); });
    };
    EXPECT_TRUE(works(Backend::egl));
    EXPECT_TRUE(works(Backend::osmesa));
    for (const Candidate& candidate : candidates)
        EXPECT_NE(candidate.info.has_value(), !candidate.failure.empty()) << candidate.platform;
    mine->makeCurrent();
    EXPECT_FALSE(drawPicture().empty());
}

}  // namespace
}  // namespace lobe::gl
