/// What is wrong with a file is said in one line that names the property, the value and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "gltf_builder.hpp"
#include "import/uri.hpp"

namespace lobe::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Changes a sound triangle by a JSON merge patch or pointer, and tells how it is refused.
std::string refusedWith(const std::string& pointer, const json& value) {
    Gltf gltf = triangle();
    gltf.doc["buffers"] =
        json::array({{{"byteLength", gltf.bytes.size()}, {"uri", "data:;base64," + base64(gltf.bytes)}}});
    gltf.doc[json::json_pointer(pointer)] = value;
    return gltf.refusal();
}

TEST(Refusal, NamesPropertyValueAndExpectation) {
    struct Case {
        std::string pointer;
        json value;
        std::string message;
    };
    const std::vector<Case> cases{
        {"/asset", json::object(), "asset.version: missing; expected a text"},
        {"/asset/version", "1.0", "asset.version: 1.0; expected 2.0"},
        {"/asset/minVersion", "2.1", "asset.minVersion: 2.1; expected 2.0"},
        {"/accessors/0/count", 4,
         "accessors[0]: 4 elements end at byte 48 of bufferViews[0]; expected at most its"},
        {"/accessors/0/count", int64_t{1} << 40,
         "accessors[0].count: 1099511627776; expected an integer of at least 1"},
        {"/accessors/0/count", 4294967295U, "accessors[0]: 4294967295 elements end at byte 51539607540"},
        {"/accessors/0/count", 0, "accessors[0].count: 0; expected"},
        {"/accessors/0/count", -1, "accessors[0].count: -1; expected"},
        {"/accessors/0/count", 2.5, "accessors[0].count: 2.5; expected an integer"},
        {"/accessors/0/count", "3", "accessors[0].count: \"3\"; expected an integer"},
        {"/accessors/0/byteOffset", 4, "accessors[0]: 3 elements end at byte 40"},
        {"/accessors/0/byteOffset", int64_t{1} << 52,
         "accessors[0]: 3 elements end at byte 4503599627370532"},
        {"/accessors/0/componentType", 5130, "accessors[0].componentType: 5130; expected one of 5120, 5121"},
        {"/accessors/0/type", "VEC5", "accessors[0].type: \"VEC5\"; expected one of \"SCALAR\""},
        {"/accessors/0/bufferView", 99,
         "accessors[0].bufferView: 99; expected an index into bufferViews, which has 4 elements"},
        {"/accessors/0/type", "VEC2",
         "meshes[0].primitives[0].attributes.POSITION: accessors[0] is a vec2 of float; expected one of vec3 "
         "of float"},
        {"/accessors/1/count", 2,
         "meshes[0].primitives[0].attributes.NORMAL: 2 elements; expected as many as POSITION, 3"},
        {"/accessors/3/componentType", 5122,
         "meshes[0].primitives[0].indices: accessors[3] is a scalar of int16; expected one of scalar of"},
        {"/bufferViews/0/byteLength", 400,
         "bufferViews[0]: bytes 0 to 400; expected bytes inside its buffer"},
        {"/bufferViews/0/byteOffset", 9007199254740992, "bufferViews[0]: bytes 9007199254740992 to"},
        {"/bufferViews/0/byteStride", 6, "bufferViews[0].byteStride: 6; expected a multiple of 4"},
        {"/bufferViews/0/byteStride", 8, "bufferViews[0].byteStride: 8; expected at least the 12 bytes"},
        {"/bufferViews/0/byteStride", 256, "bufferViews[0].byteStride: 256; expected"},
        {"/buffers/0/byteLength", 1000,
         "buffers[0].byteLength: 1000; expected at most the 102 bytes that there are"},
        {"/buffers/0/uri", "data:;base64,!!!!", "buffers[0].uri: data:;base64,!!!!; expected valid base64"},
        {"/buffers/0/uri", "data:nothing", "buffers[0].uri: data:nothing; expected a comma"},
        {"/meshes/0/primitives/0/attributes/POSITION", 9,
         "meshes[0].primitives[0].attributes.POSITION: 9; expected"},
        {"/meshes/0/primitives/0/mode", 7,
         "meshes[0].primitives[0].mode: 7; expected an integer of at least 0 and"},
        {"/meshes/0/primitives/0/material", 0,
         "meshes[0].primitives[0].material: 0; expected an index into materials"},
        {"/meshes/0/primitives", json::array(),
         "meshes[0].primitives: 0 elements; expected an array of at least 1"},
        {"/meshes/0/weights",
         {1, 2},
         "meshes[0].primitives[0].targets: 0 targets; expected one for each of 2 weights"},
        {"/nodes/0/mesh", 5, "nodes[0].mesh: 5; expected an index into meshes, which has 1 elements"},
        {"/nodes/0/children", {0}, "nodes[0].children: a cycle; expected a tree"},
        {"/nodes/0/rotation", {0, 0, 0, 0}, "nodes[0].rotation: [0,0,0,0]; expected a unit quaternion"},
        {"/nodes/0/rotation", {0, 0, 1}, "nodes[0].rotation: 3 elements; expected an array of 4 elements"},
        {"/nodes/0/translation",
         {0, 1e39, 0},
         "nodes[0].translation[1]: 1e+39; expected a number that a float can hold"},
        {"/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "nodes[0].matrix: [1,0,0,1,"},
        {"/scene", 1, "scene: 1; expected an index into scenes, which has 1 elements"},
        {"/scenes/0/nodes", {3}, "scenes[0].nodes[0]: 3; expected an index into nodes"},
        {"/scenes", json::object(), "scenes: {}; expected an array"},
        {"/extensionsRequired",
         {"EXT_meshopt_compression"},
         "extensionsRequired[0]: EXT_meshopt_compression; expected none but those that are supported: "
         "EXT_lights_area"},
        {"/materials",
         {{{"pbrMetallicRoughness", {{"roughnessFactor", 1.5}}}}},
         "materials[0].pbrMetallicRoughness.roughnessFactor: 1.5; expected a number in 0..1"},
        {"/materials", {{{"emissiveFactor", {0, 0, -1}}}}, "materials[0].emissiveFactor[2]: -1; expected"},
        {"/materials",
         {{{"normalTexture", {{"index", 0}}}}},
         "materials[0].normalTexture.index: 0; expected an index"},
        {"/materials",
         {{{"alphaMode", "GLASS"}}},
         "materials[0].alphaMode: \"GLASS\"; expected one of \"OPAQUE\""},
        {"/skins", {{{"joints", {7}}}}, "skins[0].joints[0]: 7; expected an index into nodes"},
        {"/samplers", {{{"wrapS", 1}}}, "samplers[0].wrapS: 1; expected one of 33071, 33648, 10497"},
    };
    for (const Case& c : cases) {
        EXPECT_THAT(refusedWith(c.pointer, c.value), StartsWith(c.message)) << c.pointer << " = " << c.value;
    }
    EXPECT_EQ(triangle().refusal(), "") << "the unchanged file is sound";
}

TEST(Refusal, NodesWithTwoParentsAndCycles) {
    Gltf gltf = triangle();
    gltf.doc["nodes"] = {{{"mesh", 0}}, {{"children", {0}}}, {{"children", {0}}}};
    EXPECT_THAT(gltf.refusal(),
                StartsWith("nodes[2].children[0]: 0; expected a node without another parent"));
    gltf.doc["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {3}}}, {{"children", {1}}}};
    EXPECT_THAT(gltf.refusal(), StartsWith("nodes[1].children: a cycle"));
    gltf.doc["nodes"] = {{{"mesh", 0}, {"children", {1, 1}}}, json::object()};
    EXPECT_THAT(gltf.refusal(),
                StartsWith("nodes[0].children[1]: 1; expected a node without another parent"));
}

TEST(Refusal, TransformsThatOverflow) {
    Gltf gltf = triangle();
    gltf.doc["nodes"] = {{{"mesh", 0}}};
    for (size_t i = 1; i <= 12; ++i) {
        gltf.doc["nodes"].push_back({{"children", {i - 1}}, {"scale", {1e38, 1e38, 1e38}}});
    }
    gltf.doc["scenes"][0]["nodes"] = {12};
    EXPECT_THAT(gltf.refusal(), HasSubstr("its place in the world is not finite"));
}

TEST(Refusal, IndicesBeyondTheVertices) {
    for (const uint16_t index : {uint16_t{3}, uint16_t{65535}}) {
        Gltf gltf = triangle();
        gltf.doc["meshes"][0]["primitives"][0]["indices"] =
            gltf.accessor(std::vector<uint16_t>{0, 1, index}, "SCALAR", kUint16);
        EXPECT_EQ(gltf.refusal(), "meshes[0].primitives[0].indices, accessors[4] element [2]: " +
                                      std::to_string(index) + "; expected a vertex below 3");
    }
}

TEST(Refusal, SparseIndicesBeyondTheCount) {
    Gltf gltf = triangle();
    gltf.doc["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", gltf.view(std::vector<uint16_t>{3})}, {"componentType", kUint16}}},
        {"values", {{"bufferView", gltf.view(std::vector<float>{5, 6, 7})}}}};
    EXPECT_THAT(gltf.refusal(), HasSubstr("sparse.indices[0]: 3; expected an index below count 3"));
    gltf.doc["accessors"][0]["sparse"]["count"] = 4;
    EXPECT_THAT(gltf.refusal(), HasSubstr("accessors[0].sparse.count: 4; expected at most count 3"));
    gltf.doc["accessors"][0]["sparse"]["count"] = 2;
    EXPECT_THAT(gltf.refusal(), HasSubstr("accessors[0].sparse.indices: 2 elements end at byte 4"));
}

TEST(Refusal, NonFiniteVertexData) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        std::vector<float> positions = kTrianglePositions;
        positions[4] = bad;
        for (const char* attribute : {"POSITION", "TEXCOORD_0", "COLOR_0"}) {
            Gltf gltf = triangle();
            const bool flat = std::string(attribute) == "TEXCOORD_0";
            positions.resize(flat ? 6 : 9);
            gltf.doc["meshes"][0]["primitives"][0]["attributes"][attribute] =
                gltf.floats(positions, flat ? "VEC2" : "VEC3");
            EXPECT_THAT(gltf.refusal(), StartsWith(std::string("meshes[0].primitives[0].attributes.") +
                                                   attribute + ", vertex " + (flat ? "2" : "1") + ": "));
        }
    }
}

TEST(Refusal, ZerosWithoutABufferViewAreBounded) {
    Gltf gltf = triangle();
    for (json& accessor : gltf.doc["accessors"]) {
        accessor.erase("bufferView");
        accessor["count"] = 4000000000U;
    }
    EXPECT_THAT(gltf.refusal(), HasSubstr("accessors[0].count: 4000000000; expected at most"));
}

TEST(Refusal, InstancesAreBounded) {
    Gltf gltf = triangle();
    const json primitive = gltf.doc["meshes"][0]["primitives"][0];
    for (int i = 0; i < 3000; ++i) {
        gltf.doc["meshes"][0]["primitives"].push_back(primitive);
        gltf.showNode({{"mesh", 0}});
    }
    EXPECT_THAT(gltf.refusal(), HasSubstr("more than 4194304 drawn primitives"));
}

TEST(Refusal, NoJson) {
    for (const char* content :
         {"", "{", "nonsense", "[]", "3", "{\"asset\":{\"version\":\"2.0\"}", "\xff\xfe",
          "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"name\":\"\xc3\x28\"}]}",
          "{\"asset\":{\"version\":\"2.0\"},\"x\":1e999}"}) {
        EXPECT_THAT(Gltf::refusalOf(content), StartsWith("JSON text: ")) << content;
    }
    EXPECT_THAT(Gltf::refusalOf("[]"), HasSubstr("expected an object"));
}

TEST(Refusal, DeepJson) {
    const std::string open = R"({"asset":{"version":"2.0"},"extras":)";
    EXPECT_EQ(Gltf::refusalOf(open + std::string(60, '[') + std::string(60, ']') + "}"), "");
    EXPECT_THAT(Gltf::refusalOf(open + std::string(100, '[') + std::string(100, ']') + "}"),
                HasSubstr("nested deeper"));
    EXPECT_THAT(Gltf::refusalOf(open + std::string(10000000, '[')), HasSubstr("nested deeper than 64"));
    EXPECT_EQ(Gltf::refusalOf(open + "\"" + std::string(100, '[') + "\\\"" + "\"}"), "")
        << "brackets in a text";
}

TEST(Refusal, BinaryContainers) {
    const std::string sound = triangle().glb();
    EXPECT_EQ(Gltf::refusalOf(sound), "");
    std::string file = sound;
    file[4] = 1;
    EXPECT_EQ(Gltf::refusalOf(file), "GLB version: 1; expected 2");
    EXPECT_THAT(Gltf::refusalOf(sound.substr(0, sound.size() - 1)),
                AllOf(StartsWith("GLB length: "), HasSubstr("cut off")));
    EXPECT_THAT(Gltf::refusalOf(sound.substr(0, 15)), StartsWith("file length: 15"));
    file = sound;
    file[15] = '\x7f';
    EXPECT_THAT(Gltf::refusalOf(file), StartsWith("GLB chunk[0] length: "));
    file = sound;
    file[16] = 'B';
    EXPECT_THAT(Gltf::refusalOf(file), StartsWith("GLB chunk[0] type: "));
}

TEST(Refusal, LongAndStrangeValuesStayOnOneLine) {
    const std::string message = refusedWith("/accessors/0/type", std::string(5000, 'x') + "\n\x1b[31m");
    EXPECT_LT(message.size(), 400U);
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    EXPECT_THAT(refusedWith("/extensionsRequired", {"a\nb\x1b[31m"}),
                StartsWith("extensionsRequired[0]: a b [31m; "));
}

TEST(Refusal, MissingFilesAndFolders) {
    const TemporaryFolder folder;
    const auto refusal = [](const std::filesystem::path& file) -> std::string {
        try {
            (void)importGltf(file, {});
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const std::filesystem::path missing = folder.path() / "missing.gltf";
    EXPECT_EQ(refusal(missing), missing.string() +
                                    ": can't be read (No such file or directory); expected a .gltf or "
                                    ".glb file");
    EXPECT_THAT(refusal(folder.path()), HasSubstr("is a folder"));
    EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is no regular file"));
}

/// A triangle whose buffer is said to be at a URI, in a folder with files inside and outside.
class Uris : public testing::Test {
protected:
    Uris() {
        gltf_ = triangle();
        folder_.write("scene/inside.bin", gltf_.bytes);
        folder_.write("scene/sub/deeper.bin", gltf_.bytes);
        folder_.write("outside.bin", gltf_.bytes);
        std::filesystem::create_symlink("../outside.bin", folder_.path() / "scene/link-out.bin");
        std::filesystem::create_symlink("inside.bin", folder_.path() / "scene/link-in.bin");
        std::filesystem::create_symlink("..", folder_.path() / "scene/up");
    }

    std::string refusal(const std::string& uri) {
        gltf_.doc["buffers"] = json::array({{{"byteLength", gltf_.bytes.size()}, {"uri", uri}}});
        const auto file = folder_.write("scene/scene.gltf", gltf_.text());
        try {
            (void)importGltf(file, {});
        } catch (const InputError& error) {
            return std::string(error.what()).substr(file.string().size() + 2);
        }
        return "";
    }

    TemporaryFolder folder_;
    Gltf gltf_;
};

TEST_F(Uris, InsideTheFolder) {
    for (const char* uri : {"inside.bin", "./inside.bin", "sub/deeper.bin", "sub/../inside.bin",
                            "inside%2Ebin", "sub%2Fdeeper.bin", "link-in.bin"}) {
        EXPECT_EQ(refusal(uri), "") << uri;
    }
}

TEST_F(Uris, OutsideTheFolder) {
    for (const char* uri :
         {"../outside.bin", "sub/../../outside.bin", "%2e%2e/outside.bin", "..%2foutside.bin", "/etc/passwd",
          "%2Fetc%2Fpasswd", "link-out.bin", "up/outside.bin", "..", "sub/../.."}) {
        EXPECT_THAT(refusal(uri), AllOf(StartsWith(std::string("buffers[0].uri: ") + uri +
                                                   "; expected a path inside "
                                                   "the scene's folder")))
            << uri;
    }
}

TEST_F(Uris, OtherProtocols) {
    for (const char* uri : {"http://example.org/a.bin", "https://example.org/a.bin", "file:///etc/passwd",
                            "FILE:inside.bin", "ftp:x", "http%3A//example.org/a.bin", "javascript:1"}) {
        EXPECT_THAT(refusal(uri), HasSubstr("no other protocol")) << uri;
    }
    EXPECT_THAT(refusal("..\\outside.bin"), HasSubstr("with / between"));
}

TEST_F(Uris, NoFiles) {
    EXPECT_THAT(refusal("sub"), StartsWith("buffers[0].uri: sub; expected a readable file (is a folder)"));
    EXPECT_THAT(refusal("."), HasSubstr("is a folder"));
    EXPECT_THAT(refusal(""), HasSubstr("the name of a file"));
    EXPECT_THAT(refusal("a%00b"), HasSubstr("the name of a file"));
    EXPECT_THAT(refusal("a%zz"), HasSubstr("two hexadecimal digits"));
    EXPECT_THAT(refusal("a%2"), HasSubstr("two hexadecimal digits"));
    EXPECT_THAT(refusal("missing.bin"), HasSubstr("No such file or directory"));
}

TEST(DataUris, Base64AndPercent) {
    const auto decoded = [](const std::string& uri) {
        const std::vector<std::byte> bytes = decodeDataUri(uri, "file", "property");
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    EXPECT_EQ(decoded("data:application/octet-stream;base64,Zm9vYmFy"), "foobar");
    EXPECT_EQ(decoded("DATA:;base64,Zm9vYg=="), "foob");
    EXPECT_EQ(decoded("data:;base64,Zm9vYg"), "foob");
    EXPECT_EQ(decoded("data:;base64,Zm9vYmE%3D"), "fooba");
    EXPECT_EQ(decoded("data:text/plain,a%20b"), "a b");
    EXPECT_EQ(decoded("data:,"), "");
    for (size_t length = 0; length < 9; ++length) {
        const std::string bytes = std::string("\x00\xff\x10\x80zQ~\n+", 9).substr(0, length);
        EXPECT_EQ(decoded("data:;base64," + base64(bytes)), bytes);
    }
    EXPECT_THROW((void)decoded("data:;base64,Zm9vY"), InputError);
    EXPECT_THROW((void)decoded("data:;base64,Zm9v YmFy"), InputError);
}

}  // namespace
}  // namespace lobe::test
