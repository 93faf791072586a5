// The pieces that hand pictures from thread to thread, and the scenes they share.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <thread>
#include <vector>

#include "bounded_queue.hpp"
#include "in_order.hpp"
#include "picture_writer.hpp"
#include "scene_cache.hpp"
#include "stage.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;

TEST(BoundedQueue, NeverHoldsMoreThanItsCapacity) {
    BoundedQueue<int> queue(2);
    std::atomic<int> pushed = 0;
    std::jthread producer([&] {
        for (int i = 0; i < 100; ++i) {
            queue.push(i);
            ++pushed;
        }
        queue.close();
    });
    int expected = 0;
    while (const auto value = queue.pop()) {
        EXPECT_EQ(*value, expected++);
        EXPECT_LE(pushed.load(), expected + 3);  // popped, two inside, one about to be counted
    }
    EXPECT_EQ(expected, 100);
}

TEST(BoundedQueue, ClosingEndsWhoeverWaits) {
    BoundedQueue<int> queue(1);
    EXPECT_TRUE(queue.push(1));
    std::atomic<bool> refused = false;
    std::jthread producer([&] { refused = !queue.push(2); });
    queue.close();
    producer.join();
    EXPECT_TRUE(refused);
    EXPECT_EQ(queue.pop(), 1) << "what was inside is still handed out";
    EXPECT_FALSE(queue.pop().has_value());
}

TEST(InOrder, ManyThreadsComeOutInOrderAndOnce) {
    std::vector<size_t> taken;
    InOrder<size_t> inOrder([&](size_t value) { taken.push_back(value); });
    constexpr size_t kThreads = 4;
    constexpr size_t kEach = 500;
    std::vector<std::jthread> threads;
    for (size_t t = 0; t < kThreads; ++t)
        threads.emplace_back([&, t] {
            for (size_t i = kEach; i-- > 0;)  // each thread backwards
                inOrder.add(i * kThreads + t, i * kThreads + t);
        });
    threads.clear();
    ASSERT_EQ(taken.size(), kThreads * kEach);
    for (size_t i = 0; i < taken.size(); ++i)
        EXPECT_EQ(taken[i], i);
}

TEST(Stages, WhatTheWorkThrowsReachesWhoWaits) {
    bool ended = false;
    Stage stage([] { throw InputError("no helper"); }, [&] { ended = true; });
    EXPECT_THROW(stage.finish(), InputError);
    EXPECT_TRUE(ended);
}

TEST(ConstantPictures, AreToldByColourAlone) {
    Image image(4, 3, {"R", "G", "B", "A", "depth.Z"});
    EXPECT_TRUE(isConstant(image));
    image.pixel(1, 1)[4] = 7.0f;
    EXPECT_TRUE(isConstant(image)) << "depth varies where nothing is lit";
    image.pixel(3, 2)[1] = 1e-6f;
    EXPECT_FALSE(isConstant(image));
    Image depth(4, 3, {"depth.Z"});
    EXPECT_TRUE(isConstant(depth));
    depth.pixel(3, 2)[0] = 1.0f;
    EXPECT_FALSE(isConstant(depth)) << "without colour all channels count";
    EXPECT_FALSE(isConstant(Image(1, 1, {"R", "G", "B"}))) << "one pixel says nothing";
}

/// Files with one triangle each.
class SceneCaches : public testing::Test {
protected:
    SceneCaches() { fs::create_directories(folder_); }
    ~SceneCaches() override { fs::remove_all(folder_); }

    Shot shot(const std::string& name, const nlohmann::json& settings = nlohmann::json::object()) const {
        Settings own;
        own.setAll(settings, "test");
        return {folder_ / name, std::make_shared<const Settings>(own), 1, 0, {}};
    }
    void write(const std::string& name) const {
        std::ofstream(folder_ / name) << R"({"asset": {"version": "2.0", "generator": ")" << name << R"("},
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}},
            "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
                                      << "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
                                      << R"("}]})";
    }
    fs::path folder_ = fs::path(testing::TempDir()) / ("lobe-scenes-" + std::to_string(getpid()));
};

TEST_F(SceneCaches, LoadAFileOnceAndOnceForEachChange) {
    write("a.gltf");
    SceneCache cache;
    const auto plain = cache.get(shot("a.gltf"));
    EXPECT_EQ(cache.get(shot("a.gltf", {{"exposure", 1}, {"resolution", {8, 8}}})), plain);
    const auto phong = cache.get(shot("a.gltf", {{"brdf", "phong"}}));
    EXPECT_NE(phong, plain);
    EXPECT_EQ(cache.get(shot("a.gltf", {{"brdf", "phong"}, {"quality", "high"}})), phong);
    EXPECT_EQ(cache.get(shot("a.gltf")), plain);
    EXPECT_NE(cache.get(shot("a.gltf", {{"normals", "smooth"}})), plain);
    EXPECT_EQ(cache.size(), 3u);
}

TEST_F(SceneCaches, DropWhatWasNotUsedForLongest) {
    for (const char* name : {"a.gltf", "b.gltf", "c.gltf"})
        write(name);
    const size_t one = bytesOf(*SceneCache().get(shot("a.gltf")));
    SceneCache cache(one * 2 + one / 2);
    const auto a = cache.get(shot("a.gltf"));
    const auto b = cache.get(shot("b.gltf"));
    EXPECT_EQ(cache.get(shot("a.gltf")), a);
    cache.get(shot("c.gltf"));
    EXPECT_EQ(cache.size(), 2u);
    EXPECT_EQ(cache.get(shot("a.gltf")), a) << "used more recently than b";
    EXPECT_NE(cache.get(shot("b.gltf")), b);
    SceneCache tiny(1);
    EXPECT_EQ(tiny.get(shot("a.gltf")), tiny.get(shot("a.gltf"))) << "the last one stays whatever it takes";
    EXPECT_EQ(tiny.size(), 1u);
}

TEST_F(SceneCaches, AFileThatCannotBeLoadedIsNotTriedAgain) {
    SceneCache cache;
    EXPECT_THROW(cache.get(shot("late.gltf")), InputError);
    write("late.gltf");
    EXPECT_THROW(cache.get(shot("late.gltf")), InputError) << "a batch says the same of all frames";
    EXPECT_NO_THROW(SceneCache().get(shot("late.gltf")));
}

}  // namespace
}  // namespace lobe::app
