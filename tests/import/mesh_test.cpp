/// Vertex data: every kind of accessor and of triangle topology.
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Primitive& only(const Imported& imported) {
    EXPECT_EQ(imported.scene.primitives.size(), 1U);
    return imported.scene.primitives.at(0);
}

Primitive importWith(Gltf gltf, const json& primitive) {
    gltf.show(primitive);
    return only(gltf.import());
}

TEST(Mesh, ReadsATriangle) {
    const Imported imported = triangle().import();
    const Primitive& primitive = only(imported);
    EXPECT_THAT(primitive.positions, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
    EXPECT_THAT(primitive.normals, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)));
    EXPECT_THAT(primitive.uvs[0], ElementsAre(glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(0, 0)));
    EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2));
    EXPECT_THAT(primitive.tangents, IsEmpty());
    EXPECT_THAT(imported.scene.warnings, IsEmpty());
    EXPECT_EQ(imported.scene.name, "scene");
    EXPECT_EQ(imported.scene.materials.size(), 1U);
    EXPECT_EQ(imported.scene.triangleCount(), 1U);
}

TEST(Mesh, GlbAndGltfHoldTheSame) {
    const TemporaryFolder folder;
    const Gltf gltf = triangle();
    const Imported binary = importGltf(folder.write("a.glb", gltf.glb()), {});
    const Imported text = importGltf(folder.write("a.gltf", gltf.text()), {});
    EXPECT_EQ(only(binary).positions, only(text).positions);
    EXPECT_EQ(only(binary).indices, only(text).indices);
    EXPECT_EQ(binary.scene.contentHash.size(), 16U);
    EXPECT_NE(binary.scene.contentHash, text.scene.contentHash);
    EXPECT_EQ(binary.scene.contentHash, importGltf(folder.path() / "a.glb", {}).scene.contentHash);
}

TEST(Mesh, ContentHashCoversReferencedFiles) {
    const TemporaryFolder folder;
    Gltf gltf = triangle();
    gltf.bytes += "tail";  // that no accessor reads
    gltf.doc["buffers"] = json::array({{{"byteLength", gltf.bytes.size()}, {"uri", "sub/a%20b.bin"}}});
    folder.write("sub/a b.bin", gltf.bytes);
    const auto file = folder.write("a.gltf", gltf.text());
    const std::string before = importGltf(file, {}).scene.contentHash;
    gltf.bytes.back() = 'L';
    folder.write("sub/a b.bin", gltf.bytes);
    EXPECT_NE(importGltf(file, {}).scene.contentHash, before);
}

TEST(Mesh, ReadsIndicesOfAllTypes) {
    for (const int type : {kUint8, kUint16, kUint32}) {
        Gltf gltf;
        const int positions = gltf.floats(kTrianglePositions, "VEC3");
        const int indices = type == kUint8    ? gltf.accessor(std::vector<uint8_t>{2, 0, 1}, "SCALAR", type)
                            : type == kUint16 ? gltf.accessor(std::vector<uint16_t>{2, 0, 1}, "SCALAR", type)
                                              : gltf.accessor(std::vector<uint32_t>{2, 0, 1}, "SCALAR", type);
        gltf.doc["materials"] = json::array({json::object()});
        json primitive = {
            {"attributes", {{"POSITION", positions}, {"NORMAL", gltf.floats(kTriangleNormals, "VEC3")}}},
            {"indices", indices}};
        EXPECT_THAT(importWith(gltf, primitive).indices, ElementsAre(2, 0, 1)) << type;
    }
}

TEST(Mesh, TurnsStripsAndFansIntoLists) {
    Gltf gltf;
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
    const std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    json primitive = {
        {"attributes",
         {{"POSITION", gltf.floats(positions, "VEC3")}, {"NORMAL", gltf.floats(normals, "VEC3")}}},
        {"mode", 5}};
    EXPECT_THAT(importWith(gltf, primitive).indices, ElementsAre(0, 1, 2, 1, 3, 2, 2, 3, 4));
    primitive["mode"] = 6;
    EXPECT_THAT(importWith(gltf, primitive).indices, ElementsAre(1, 2, 0, 2, 3, 0, 3, 4, 0));
    primitive["indices"] = gltf.accessor(std::vector<uint8_t>{4, 3, 2, 1}, "SCALAR", kUint8);
    EXPECT_THAT(importWith(gltf, primitive).indices, ElementsAre(3, 2, 4, 2, 1, 4));
    primitive["mode"] = 5;
    EXPECT_THAT(importWith(gltf, primitive).indices, ElementsAre(4, 3, 2, 3, 1, 2));
}

TEST(Mesh, LeavesOutPointsLinesAndBodiless) {
    Gltf gltf;
    const int positions = gltf.floats(kTrianglePositions, "VEC3");
    for (const int mode : {0, 1, 2, 3}) {
        gltf.show({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    }
    gltf.show({{"attributes", {{"NORMAL", positions}}}});
    const Imported imported = gltf.import();
    EXPECT_THAT(imported.scene.primitives, IsEmpty());
    EXPECT_THAT(imported.scene.warnings,
                ElementsAre(HasSubstr("not drawn"), HasSubstr("not drawn"), HasSubstr("not drawn"),
                            HasSubstr("not drawn"), HasSubstr("no POSITION"), HasSubstr("nothing to draw")));
}

TEST(Mesh, ManyWarningsAreCounted) {
    Gltf gltf;
    const json lines = {{"attributes", {{"POSITION", gltf.floats(kTrianglePositions, "VEC3")}}}, {"mode", 1}};
    for (int i = 0; i < 104; ++i) {
        gltf.show(lines);
    }
    const std::vector<std::string> warnings = gltf.import().scene.warnings;
    EXPECT_EQ(warnings.size(), 101U);
    EXPECT_EQ(warnings.back(), "and 5 more warnings");
}

TEST(Mesh, ReadsInterleavedAttributes) {
    Gltf gltf;
    std::vector<float> both;
    for (size_t v = 0; v < 3; ++v) {
        both.insert(both.end(), kTrianglePositions.begin() + 3 * static_cast<int>(v),
                    kTrianglePositions.begin() + 3 * static_cast<int>(v) + 3);
        both.insert(both.end(), {0, 0, 1});
    }
    const int view = gltf.view(both);
    gltf.doc["bufferViews"][0]["byteStride"] = 24;
    json accessor = {{"bufferView", view}, {"componentType", kFloat32}, {"count", 3}, {"type", "VEC3"}};
    const int positions = gltf.push("accessors", accessor);
    accessor["byteOffset"] = 12;
    const int normals = gltf.push("accessors", accessor);
    const Primitive primitive =
        importWith(gltf, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    EXPECT_THAT(primitive.positions, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
    EXPECT_THAT(primitive.normals, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)));
}

TEST(Mesh, ReadsSparseAccessors) {
    Gltf gltf;
    const int positions = gltf.floats(kTrianglePositions, "VEC3");
    gltf.doc["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", gltf.view(std::vector<uint16_t>{1})}, {"componentType", kUint16}}},
        {"values", {{"bufferView", gltf.view(std::vector<float>{5, 6, 7})}}}};
    const json attributes = {{"POSITION", positions}, {"NORMAL", gltf.floats(kTriangleNormals, "VEC3")}};
    EXPECT_THAT(importWith(gltf, {{"attributes", attributes}}).positions,
                ElementsAre(glm::vec3(0, 0, 0), glm::vec3(5, 6, 7), glm::vec3(0, 1, 0)));
    gltf.doc["accessors"][0].erase("bufferView");
    EXPECT_THAT(importWith(gltf, {{"attributes", attributes}}).positions,
                ElementsAre(glm::vec3(0, 0, 0), glm::vec3(5, 6, 7), glm::vec3(0, 0, 0)));
}

TEST(Mesh, AccessorsWithoutABufferViewAreZero) {
    Gltf gltf = triangle();
    gltf.doc["accessors"][2].erase("bufferView");  // texture coordinates
    gltf.doc["accessors"][3].erase("bufferView");  // indices
    const Imported imported = gltf.import();
    EXPECT_THAT(only(imported).uvs[0], ElementsAre(glm::vec2(0), glm::vec2(0), glm::vec2(0)));
    EXPECT_THAT(only(imported).indices, ElementsAre(0, 0, 0));
}

TEST(Mesh, ReadsQuantizedAttributes) {
    Gltf gltf;
    gltf.doc["extensionsUsed"] = gltf.doc["extensionsRequired"] = {"KHR_mesh_quantization"};
    const json attributes = {
        {"POSITION",
         gltf.accessor(std::vector<int16_t>{0, 0, 0, 0, 300, -7, 5, 0, -32768, 32767, 1, 0}, "VEC4", kInt16)},
        {"NORMAL",
         gltf.accessor(std::vector<int8_t>{0, 0, 127, 0, -127, 0, 0, 0, 0, -128, 0, 0}, "VEC4", kInt8, true)},
        {"TEXCOORD_0", gltf.accessor(std::vector<uint16_t>{0, 65535, 32767, 1, 3, 4}, "VEC2", kUint16, true)},
        {"TEXCOORD_1", gltf.accessor(std::vector<int16_t>{0, 9, -5, 1, 3, 4}, "VEC2", kInt16)}};
    for (int i = 0; i < 2; ++i) {  // three components of four, so that vertices are aligned
        json& accessor = gltf.doc["accessors"][static_cast<size_t>(i)];
        accessor["type"] = "VEC3";
        gltf.doc["bufferViews"][static_cast<size_t>(i)]["byteStride"] = i == 0 ? 8 : 4;
    }
    const Primitive primitive = importWith(gltf, {{"attributes", attributes}});
    EXPECT_THAT(primitive.positions,
                ElementsAre(glm::vec3(0, 0, 0), glm::vec3(300, -7, 5), glm::vec3(-32768, 32767, 1)));
    EXPECT_THAT(primitive.normals, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(-1, 0, 0), glm::vec3(0, -1, 0)));
    EXPECT_EQ(primitive.uvs[0][0], glm::vec2(0, 1));
    EXPECT_EQ(primitive.uvs[0][1], glm::vec2(32767.0f * (1.0f / 65535.0f), 1.0f / 65535.0f));
    EXPECT_EQ(primitive.uvs[1][1], glm::vec2(-5, 1));
}

TEST(Mesh, ReadsColorsOfAllTypes) {
    Gltf gltf = triangle();
    json& attributes = gltf.doc["meshes"][0]["primitives"][0]["attributes"];
    const glm::vec4 second(1.0f, 0.0f, 0.2f, 1.0f);
    attributes["COLOR_0"] = gltf.floats({0, 0, 0, 1, 0, 0.2f, 0, 0, 0}, "VEC3");
    EXPECT_EQ(only(gltf.import()).colors.at(1), second);
    attributes["COLOR_0"] = gltf.floats({0, 0, 0, 0.5f, 1, 0, 0.2f, 1, 0, 0, 0, 1}, "VEC4");
    EXPECT_EQ(only(gltf.import()).colors.at(1), second);
    EXPECT_EQ(only(gltf.import()).colors.at(0).a, 0.5f);
    attributes["COLOR_0"] =
        gltf.accessor(std::vector<uint8_t>{0, 0, 0, 0, 255, 0, 51, 255, 0, 0, 0, 0}, "VEC4", kUint8, true);
    EXPECT_EQ(only(gltf.import()).colors.at(1), glm::vec4(1.0f, 0.0f, 51.0f * (1.0f / 255.0f), 1.0f));
    attributes["COLOR_0"] = gltf.accessor(
        std::vector<uint16_t>{0, 0, 0, 0, 65535, 0, 13107, 65535, 0, 0, 0, 0}, "VEC4", kUint16, true);
    EXPECT_NEAR(only(gltf.import()).colors.at(1).b, 0.2f, 1e-7f);
}

TEST(Mesh, BuffersOfAllKinds) {
    Gltf gltf = triangle();
    // A data URI in a binary container, which has no BIN chunk then.
    const json parsed = json::parse(gltf.text());
    std::string chunk = parsed.dump();
    chunk.resize((chunk.size() + 3) / 4 * 4, ' ');
    const std::string glb = "glTF" + Gltf::word(2) + Gltf::word(static_cast<uint32_t>(20 + chunk.size())) +
                            Gltf::word(static_cast<uint32_t>(chunk.size())) + "JSON" + chunk;
    EXPECT_EQ(Gltf::refusalOf(glb), "");
    // A buffer without source, which nothing uses.
    json doc = parsed;
    doc["buffers"].push_back({{"byteLength", 1000000000000}});
    doc["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 1000000000000}});
    EXPECT_EQ(Gltf::refusalOf(doc.dump()), "");
    doc["accessors"][1]["bufferView"] = 4;
    EXPECT_THAT(Gltf::refusalOf(doc.dump()), HasSubstr("buffers[1].uri: missing; expected"));
}

/// A tetrahedron with normals of integers and generic attributes, compressed.
Gltf dracoTetrahedron() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(4);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const std::array<std::array<float, 3>, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const std::array<std::array<size_t, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    for (size_t f = 0; f < 4; ++f) {
        const auto& [a, b, c] = faces[f];
        const draco::FaceIndex face(static_cast<uint32_t>(f));
        builder.SetAttributeValuesForFace(position, face, corners[a].data(), corners[b].data(),
                                          corners[c].data());
        builder.SetAttributeValuesForFace(uv, face, corners[a].data(), corners[b].data(), corners[c].data());
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::ExpertEncoder encoder(*mesh);
    draco::EncoderBuffer encoded;
    EXPECT_TRUE(encoder.EncodeToBuffer(&encoded).ok());
    Gltf gltf;
    gltf.doc["extensionsUsed"] = gltf.doc["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const int view = gltf.view(std::vector<char>(encoded.data(), encoded.data() + encoded.size()));
    const int positions =
        gltf.push("accessors", {{"componentType", kFloat32}, {"count", 4}, {"type", "VEC3"}});
    const int uvs = gltf.push("accessors", {{"componentType", kFloat32}, {"count", 4}, {"type", "VEC2"}});
    const int indices =
        gltf.push("accessors", {{"componentType", kUint16}, {"count", 12}, {"type", "SCALAR"}});
    gltf.show({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
               {"indices", indices},
               {"extensions",
                {{"KHR_draco_mesh_compression",
                  {{"bufferView", view},
                   {"attributes",
                    {{"POSITION", mesh->attribute(position)->unique_id()},
                     {"TEXCOORD_0", mesh->attribute(uv)->unique_id()}}}}}}}});
    return gltf;
}

TEST(Mesh, ReadsDraco) {
    const Imported imported = dracoTetrahedron().import();
    const Primitive& primitive = only(imported);
    ASSERT_EQ(primitive.triangleCount(), 4U);
    glm::vec3 area(0.0f);
    for (size_t t = 0; t < 4; ++t) {
        const glm::vec3 a = primitive.positions[primitive.indices[3 * t]];
        const glm::vec3 b = primitive.positions[primitive.indices[3 * t + 1]];
        const glm::vec3 c = primitive.positions[primitive.indices[3 * t + 2]];
        area += glm::cross(b - a, c - a);
        EXPECT_GE(glm::length(glm::cross(b - a, c - a)), 0.99f);
        EXPECT_GE(glm::dot(glm::cross(b - a, c - a), a + b + c - 0.75f), -1e-5f) << "facing outwards";
        for (int k = 0; k < 3; ++k) {
            const uint32_t v = primitive.indices[3 * t + static_cast<size_t>(k)];
            EXPECT_EQ(primitive.uvs[0][v], glm::vec2(primitive.positions[v]));
        }
    }
    EXPECT_NEAR(glm::length(area), 0.0f, 1e-5f) << "closed";
}

TEST(Mesh, RefusesDamagedDraco) {
    Gltf cut = dracoTetrahedron();
    cut.doc["bufferViews"][0]["byteLength"] = 20;
    EXPECT_THAT(cut.refusal(), HasSubstr("meshes[0].primitives[0].extensions.KHR_draco_mesh_compression"));
    Gltf wrongId = dracoTetrahedron();
    wrongId.doc["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
               ["POSITION"] = 77;
    EXPECT_THAT(wrongId.refusal(), HasSubstr("attribute 77; expected an attribute of 3 components"));
    Gltf wrongCount = dracoTetrahedron();
    wrongCount.doc["accessors"][0]["count"] = 5000000000 % 4294967295;
    EXPECT_THAT(wrongCount.refusal(), HasSubstr("the 4 of the compressed mesh"));
    for (size_t byte = 0; byte < cut.bytes.size(); ++byte) {
        Gltf flipped = dracoTetrahedron();
        flipped.bytes[byte] = static_cast<char>(flipped.bytes[byte] ^ 0x41);
        (void)flipped.refusal();  // refused or read otherwise, but it returns
    }
}

}  // namespace
}  // namespace lobe::test
