/// SceneLoader: scenes through the worker, and files that mean harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "gltf_builder.hpp"
#include "scene/load.hpp"

namespace lobe::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A picture of one pixel, (255, 0, 0).
const char* const kRedPng =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";

Gltf textured() {
    Gltf gltf = triangle({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                          {"occlusionTexture", {{"index", 1}}},
                          {"emissiveTexture", {{"index", 2}}},
                          {"emissiveFactor", {1, 1, 1}}});
    for (int i = 0; i < 3; ++i) {
        gltf.push("images", {{"uri", kRedPng}});
        gltf.push("textures", {{"source", i}});
    }
    return gltf;
}

std::string refusalOf(SceneLoader& loader, const std::filesystem::path& file) {
    try {
        (void)loader.load(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(SceneLoader, DecodesAllImages) {
    const TemporaryFolder folder;
    SceneLoader loader;
    const Scene scene = loader.load(folder.write("red.gltf", textured().text()));
    EXPECT_EQ(scene.name, "red");
    ASSERT_EQ(scene.images.size(), 3U);
    for (const Bitmap& image : scene.images) {
        EXPECT_EQ(image.width, 1);
        ASSERT_EQ(image.channels, 3);
        EXPECT_THAT(image.data, ElementsAre(std::byte{255}, std::byte{0}, std::byte{0}));
    }
    EXPECT_EQ(scene.primitives.at(0).positions.size(), 3U);
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
}

TEST(SceneLoader, NamesImagesThatCannotBeDecoded) {
    const TemporaryFolder folder;
    SceneLoader loader;
    Gltf gltf = textured();
    gltf.doc["images"][1] = {{"uri", "broken.png"}};
    folder.write("broken.png", "\x89PNG\r\n\x1a\n and nothing more");
    const auto file = folder.write("scene.gltf", gltf.text());
    EXPECT_THAT(refusalOf(loader, file), StartsWith(file.string() + ": images[1] (broken.png)"));
    folder.write("broken.png", "text");
    EXPECT_THAT(refusalOf(loader, file), StartsWith(file.string() + ": images[1] (broken.png)"));
}

TEST(SceneLoader, TakesFallbacks) {
    const TemporaryFolder folder;
    SceneLoader loader;
    Gltf gltf = textured();
    gltf.push("images", {{"uri", "data:image/webp;base64," + base64("RIFF....WEBPdamaged")}});
    gltf.doc["textures"][1]["extensions"]["EXT_texture_webp"]["source"] = 3;
    const Scene scene = loader.load(folder.write("scene.gltf", gltf.text()));
    ASSERT_EQ(scene.images.size(), 4U);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("images[3]: taken from images[1]")));
    const auto used = static_cast<size_t>(scene.textures.at(1).image);
    EXPECT_EQ(scene.images.at(used).width, 1);
}

TEST(SceneLoader, RefusalsNameTheFileOnce) {
    const TemporaryFolder folder;
    SceneLoader loader;
    const auto file = folder.write("bad.gltf", "{}");
    EXPECT_EQ(refusalOf(loader, file), file.string() + ": asset: missing; expected an object");
}

TEST(SceneLoader, PassesOptionsOn) {
    const TemporaryFolder folder;
    SceneLoader loader;
    Gltf gltf = triangle();
    gltf.doc["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        gltf.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
    const int input = gltf.floats({0, 2}, "SCALAR");
    const int output = gltf.floats({0, 0, 0, 2, 0, 0}, "VEC3");
    gltf.push("animations",
              {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
               {"samplers", {{{"input", input}, {"output", output}}}}});
    const auto file = folder.write("a b\xc3\xa4.gltf", gltf.text());
    const Scene scene = loader.load(file, {1.0, NormalsMode::flat});
    EXPECT_EQ(scene.instances.at(0).worldFromLocal[3][0], 1.0);
    EXPECT_EQ(scene.primitives.at(0).normals.at(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(loader.load(file).primitives.at(0).normals.at(0), glm::vec3(1, 0, 0));
}

/// Truncations at every length: whatever is not refused must be a whole scene.
TEST(HostileFiles, TruncatedAtEveryLength) {
    const TemporaryFolder folder;
    SceneLoader loader;
    for (const std::string& whole : {triangle().glb(), triangle().text()}) {
        ASSERT_EQ(refusalOf(loader, folder.write("whole", whole)), "");
        for (size_t length = 0; length < whole.size(); ++length) {
            const auto file = folder.write("cut", whole.substr(0, length));
            EXPECT_THAT(refusalOf(loader, file), StartsWith(file.string() + ": ")) << length;
        }
    }
}

bool isSound(const Scene& scene) {
    const auto finite = [](const auto& vectors) {
        return std::all_of(vectors.begin(), vectors.end(),
                           [](const auto& v) { return std::isfinite(glm::dot(v, v)); });
    };
    return std::all_of(scene.primitives.begin(), scene.primitives.end(), [&](const Primitive& p) {
        const size_t count = p.positions.size();
        return finite(p.normals) && finite(p.tangents) && p.normals.size() == count &&
               (p.tangents.empty() || p.tangents.size() == count) &&
               (p.uvs[0].empty() || p.uvs[0].size() == count) &&
               (p.colors.empty() || p.colors.size() == count) && p.indices.size() % 3 == 0 &&
               p.material >= 0 && p.material < static_cast<int>(scene.materials.size()) &&
               std::all_of(p.indices.begin(), p.indices.end(), [&](uint32_t index) { return index < count; });
    });
}

TEST(HostileFiles, FlippedBytes) {
    const TemporaryFolder folder;
    SceneLoader loader;
    Gltf gltf = textured();
    gltf.doc["materials"][0]["normalTexture"]["index"] = 0;
    const std::string whole = gltf.glb();
    std::mt19937 random(20240607);  // fixed, so that a failure can be seen again
    int loaded = 0;
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string damaged = whole;
        for (uint32_t flips = 1 + random() % 3; flips > 0; --flips) {
            char& byte = damaged[random() % damaged.size()];
            byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << random() % 8));
        }
        const auto file = folder.write("flipped.glb", damaged);
        try {
            EXPECT_TRUE(isSound(loader.load(file))) << i;
            ++loaded;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), StartsWith(file.string() + ": ")) << i;
            ++refused;
        }
    }
    EXPECT_GT(loaded, 100);
    EXPECT_GT(refused, 100);
}

TEST(HostileFiles, HugeCountsCostNothing) {
    const TemporaryFolder folder;
    SceneLoader loader;
    Gltf gltf = triangle();
    for (json& accessor : gltf.doc["accessors"]) {
        accessor["count"] = int64_t{1} << 40;
    }
    EXPECT_THAT(refusalOf(loader, folder.write("huge.gltf", gltf.text())), HasSubstr("accessors[0].count"));
    for (json& accessor : gltf.doc["accessors"]) {
        accessor["count"] = 20000000;
        accessor.erase("bufferView");
    }
    // Zeros within the bound for one accessor, asked for a thousand times: refused before any is made.
    const json primitive = gltf.doc["meshes"][0]["primitives"][0];
    for (int i = 0; i < 1000; ++i) {
        gltf.doc["meshes"][0]["primitives"].push_back(primitive);
    }
    const auto file = folder.write("many.gltf", gltf.text());
    EXPECT_THAT(refusalOf(loader, file),
                StartsWith(file.string() + ": meshes[0]: brings the scene's geometry to"));
    EXPECT_EQ(refusalOf(loader, folder.write("sound.gltf", triangle().text())), "")
        << "the next one is served";
}

TEST(HostileFiles, AManyPartsMeshOnOneVertexEnds) {
    const TemporaryFolder folder;
    SceneLoader loader;
    Gltf gltf;
    std::vector<float> positions{0, 0, 0};
    std::vector<uint32_t> indices;
    constexpr uint32_t kFacets = 20000;
    for (uint32_t i = 0; i < kFacets; ++i) {
        const float angle = static_cast<float>(i) * 0.01f;
        positions.insert(positions.end(), {std::cos(angle), std::sin(angle), static_cast<float>(i % 7)});
        indices.insert(indices.end(), {0, i + 1, i + 2 > kFacets ? 1 : i + 2});
    }
    gltf.show({{"attributes", {{"POSITION", gltf.floats(positions, "VEC3")}}},
               {"indices", gltf.accessor(indices, "SCALAR", kUint32)}});
    const Scene scene = loader.load(folder.write("hub.gltf", gltf.text()), {0.0, NormalsMode::smooth});
    EXPECT_TRUE(isSound(scene));
}

/// Whether a child has ended, with all its threads: only then are its sockets closed.
bool hasEnded(pid_t process) {
    const std::string folder = "/proc/" + std::to_string(process);
    std::error_code gone;
    const auto threads = std::distance(std::filesystem::directory_iterator(folder + "/task", gone), {});
    std::ifstream file(folder + "/stat");
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const size_t name = text.rfind(") ");
    return name == std::string::npos || (text.at(name + 2) == 'Z' && threads <= 1);
}

/// Sends a signal to each child process of this one that serves scenes; killed ones have ended when this
/// returns.
int signalSceneWorkers(int signal) {
    int reached = 0;
    std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
    for (pid_t child = 0; children >> child;) {
        std::string name;
        std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), name);
        if (name.starts_with("lobe-scene")) {
            reached += kill(child, signal) == 0 ? 1 : 0;
            while (signal == SIGKILL && !hasEnded(child)) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        }
    }
    return reached;
}

TEST(HostileFiles, AKilledWorkerIsReplaced) {
    const TemporaryFolder folder;
    SceneLoader loader;
    const auto file = folder.write("scene.gltf", triangle().text());
    ASSERT_EQ(refusalOf(loader, file), "");
    ASSERT_GE(signalSceneWorkers(SIGKILL), 1);
    EXPECT_EQ(refusalOf(loader, file), "") << "it died idle, which is nobody's fault";
    // In the middle of work: stopped so that it can't answer, then killed.
    ASSERT_GE(signalSceneWorkers(SIGSTOP), 1);
    std::thread killer([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        signalSceneWorkers(SIGKILL);
    });
    const std::string message = refusalOf(loader, file);
    killer.join();
    EXPECT_THAT(message, StartsWith(file.string() + ": the decoder was killed (signal 9"));
    EXPECT_EQ(refusalOf(loader, file), "");
}

TEST(Assets, AllLoad) {
    const char* assets = std::getenv("LOBE_ASSETS");
    if (assets == nullptr) {
        GTEST_SKIP() << "LOBE_ASSETS is not set";
    }
    SceneLoader loader;
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets)) {
        if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") {
            continue;
        }
        try {
            const Scene scene = loader.load(entry.path());
            EXPECT_TRUE(isSound(scene)) << entry.path();
            EXPECT_FALSE(scene.instances.empty()) << entry.path();
            for (const Texture& texture : scene.textures) {
                EXPECT_GT(scene.images.at(static_cast<size_t>(texture.image)).width, 0) << entry.path();
            }
            ++count;
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
        }
    }
    EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace lobe::test
