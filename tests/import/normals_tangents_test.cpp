#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "gltf_builder.hpp"
#include "import/normals.hpp"
#include "import/tangents.hpp"

namespace lobe::test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-6) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(value[c], expected[c], tolerance) << "component " << c;
    }
}

/// Two triangles that share the edge from (0, 0, 0) to (0, 1, 0) and fold by `degrees` there.
Primitive folded(double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {std::cos(angle), 0, std::sin(angle)}};
    primitive.indices = {0, 1, 2, 0, 3, 1};
    return primitive;
}

TEST(Normals, FlatVerticesAreNotShared) {
    Primitive primitive = folded(90);
    primitive.uvs[0] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
    makeFlatNormals(primitive);
    EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2, 3, 4, 5));
    for (size_t v = 0; v < 3; ++v) {
        expectNear(primitive.normals[v], {0, 0, 1});
        expectNear(primitive.normals[v + 3], {-1, 0, 0});
    }
    EXPECT_EQ(primitive.uvs[0][4], glm::vec2(3, 0));
}

TEST(Normals, SmoothBelowTheCreaseAngle) {
    Primitive primitive = folded(59);
    makeSmoothNormals(primitive);
    EXPECT_EQ(primitive.positions.size(), 4U);
    // Both facets have a right angle at (0, 0, 0), and 45 degrees at (0, 1, 0): equal weights.
    const double half = 59.0 / 2 * std::numbers::pi / 180.0;
    expectNear(primitive.normals[0], {-std::sin(half), 0, std::cos(half)});
    expectNear(primitive.normals[1], {-std::sin(half), 0, std::cos(half)});
    expectNear(primitive.normals[2], {0, 0, 1});
}

TEST(Normals, SplitAboveTheCreaseAngle) {
    Primitive primitive = folded(61);
    makeSmoothNormals(primitive);
    EXPECT_EQ(primitive.positions.size(), 6U);
    const double angle = 61.0 * std::numbers::pi / 180.0;
    for (size_t corner = 0; corner < 6; ++corner) {
        expectNear(primitive.normals[primitive.indices[corner]],
                   corner < 3 ? glm::dvec3(0, 0, 1) : glm::dvec3(-std::sin(angle), 0, std::cos(angle)));
    }
}

TEST(Normals, SmoothWeldsPositionsAndWeighsByAngle) {
    Primitive primitive = folded(30);
    // The second facet gets vertices of its own, and an angle of 45 degrees at (0, 0, 0).
    primitive.positions.insert(primitive.positions.end(), {{0, 0, 0}, {0, 1, 0}});
    primitive.positions[3] += glm::vec3(0, 1, 0);
    primitive.indices = {0, 1, 2, 4, 3, 5};
    makeSmoothNormals(primitive);
    const double angle = 30.0 * std::numbers::pi / 180.0;
    const glm::dvec3 second(-std::sin(angle), 0, std::cos(angle));
    expectNear(primitive.normals[0], glm::normalize(2.0 * glm::dvec3(0, 0, 1) + second));
    EXPECT_EQ(primitive.normals[0], primitive.normals[4]);
}

TEST(Normals, ModesOfLoading) {
    Gltf gltf = triangle();
    gltf.doc["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        gltf.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
    EXPECT_THAT(gltf.import().scene.primitives.at(0).normals, Each(glm::vec3(1, 0, 0)));
    EXPECT_THAT(gltf.import({0.0, NormalsMode::smooth}).scene.primitives.at(0).normals,
                Each(glm::vec3(1, 0, 0)));
    EXPECT_THAT(gltf.import({0.0, NormalsMode::flat}).scene.primitives.at(0).normals,
                Each(glm::vec3(0, 0, 1)));
    gltf.doc["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    EXPECT_THAT(gltf.import().scene.primitives.at(0).normals, Each(glm::vec3(0, 0, 1)));
    EXPECT_THAT(gltf.import({0.0, NormalsMode::smooth}).scene.primitives.at(0).normals,
                Each(glm::vec3(0, 0, 1)));
}

TEST(Normals, BrokenOnesAreRepaired) {
    Gltf gltf = triangle();
    gltf.doc["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        gltf.floats({0, 0, 0, kNan, 0, 1, 0, 3, 4}, "VEC3");
    const Imported imported = gltf.import();
    const Primitive& primitive = imported.scene.primitives.at(0);
    expectNear(primitive.normals[0], {0, 0, 1});
    expectNear(primitive.normals[1], {0, 0, 1});
    expectNear(primitive.normals[2], {0, 0.6, 0.8});
    EXPECT_THAT(imported.scene.warnings, ElementsAre(HasSubstr("2 normals")));
}

TEST(Normals, FacetsWithoutAreaGetSomeUnitNormal) {
    Primitive primitive;
    primitive.positions = {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}};
    primitive.indices = {0, 1, 2};
    for (Primitive copy : {primitive, primitive}) {
        makeFlatNormals(copy);
        for (const glm::vec3& normal : copy.normals) {
            EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f);
        }
        makeSmoothNormals(copy);
        for (const glm::vec3& normal : copy.normals) {
            EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f);
        }
    }
}

/// A unit square in the xy plane, seen upright: u to the right, v downwards from the top.
Primitive square() {
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

TEST(Tangents, FollowU) {
    Primitive primitive = square();
    makeTangents(primitive, primitive.uvs[0]);
    EXPECT_THAT(primitive.tangents, Each(glm::vec4(1, 0, 0, 1)));
    // Turned by 90 degrees: u grows along y.
    Primitive turned = square();
    turned.uvs[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    makeTangents(turned, turned.uvs[0]);
    for (const glm::vec4& tangent : turned.tangents) {
        expectNear(glm::vec3(tangent), {0, 1, 0});
        EXPECT_EQ(tangent.w, 1.0f);
    }
}

TEST(Tangents, MirroredHalvesSplitTheirVertices) {
    // Two squares side by side; the right one has the left one's texture mirrored.
    Primitive primitive = square();
    primitive.positions.insert(primitive.positions.end(), {{2, 0, 0}, {2, 1, 0}});
    primitive.normals.assign(6, {0, 0, 1});
    primitive.uvs[0].insert(primitive.uvs[0].end(), {{0, 1}, {0, 0}});
    primitive.indices.insert(primitive.indices.end(), {1, 4, 5, 1, 5, 2});
    makeTangents(primitive, primitive.uvs[0]);
    EXPECT_EQ(primitive.positions.size(), 8U) << "two vertices on the seam";
    for (size_t corner = 0; corner < 12; ++corner) {
        const glm::vec4 tangent = primitive.tangents[primitive.indices[corner]];
        expectNear(glm::vec3(tangent), {corner < 6 ? 1 : -1, 0, 0});
        EXPECT_EQ(tangent.w, corner < 6 ? 1.0f : -1.0f);
    }
    EXPECT_EQ(primitive.uvs[0].size(), 8U);
    EXPECT_EQ(primitive.normals.size(), 8U);
}

TEST(Tangents, AreWeightedByAngle) {
    // Two facets meet at (0, 0, 0) with angles of 90 and 45 degrees; their u runs along x and along x + y.
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.indices = {0, 1, 2, 0, 2, 3};
    // First: u = x, v = -y. The second shares uv at 0 and 2, and has u = x + y - 1... so that du/dy = 0 along
    // the edge.
    primitive.uvs[0] = {{0, 0}, {1, 0}, {0, -1}, {-1, -2}};
    makeTangents(primitive, primitive.uvs[0]);
    // Second facet: solve gradients from its edges (0,1)->(0,-1) and (-1,1)->(-1,-2): dP/du = (1, 0) + v
    // part: e1 = (0, 1) has uv (0, -1); e2 = (-1, 1) has uv (-1, -2). P_u = (e1 * -2 - e2 * -1) / (0 * -2 -
    // -1 * -1)
    //    = ((0, -2) + (-1, 1)) / -1 = (1, 1).
    const glm::dvec3 expected =
        glm::normalize(2.0 * glm::dvec3(1, 0, 0) + glm::normalize(glm::dvec3(1, 1, 0)));
    expectNear(glm::vec3(primitive.tangents[0]), expected);
    expectNear(glm::vec3(primitive.tangents[1]), {1, 0, 0});
}

TEST(Tangents, WeldVerticesThatAreEqual) {
    Primitive shared = square();
    shared.uvs[0][2] = {1.5f, 0};  // the two facets differ
    Primitive split = shared;
    split.positions = {shared.positions[0], shared.positions[1], shared.positions[2],
                       shared.positions[0], shared.positions[2], shared.positions[3]};
    split.normals.assign(6, {0, 0, 1});
    split.uvs[0] = {shared.uvs[0][0], shared.uvs[0][1], shared.uvs[0][2],
                    shared.uvs[0][0], shared.uvs[0][2], shared.uvs[0][3]};
    split.indices = {0, 1, 2, 3, 4, 5};
    makeTangents(shared, shared.uvs[0]);
    makeTangents(split, split.uvs[0]);
    for (size_t corner = 0; corner < 6; ++corner) {
        EXPECT_EQ(shared.tangents[shared.indices[corner]], split.tangents[split.indices[corner]]) << corner;
    }
}

TEST(Tangents, DegenerateTrianglesDoNoHarm) {
    Primitive primitive = square();
    primitive.indices.insert(primitive.indices.begin(), {0, 0, 1});  // no area
    primitive.indices.insert(primitive.indices.end(), {3, 3, 3});    // a point
    primitive.positions.insert(primitive.positions.end(), {{9, 9, 9}, {9, 9, 9}, {9, 9, 9}});
    primitive.normals.insert(primitive.normals.end(), 3, {0, 1, 0});
    primitive.uvs[0].insert(primitive.uvs[0].end(), 3, {0, 0});
    primitive.indices.insert(primitive.indices.end(), {4, 5, 6});  // a point that nothing else touches
    makeTangents(primitive, primitive.uvs[0]);
    for (size_t corner = 0; corner < 12; ++corner) {
        EXPECT_EQ(primitive.tangents[primitive.indices[corner]], glm::vec4(1, 0, 0, 1)) << corner;
    }
    for (size_t v = 0; v < primitive.tangents.size(); ++v) {
        EXPECT_NEAR(glm::length(glm::vec3(primitive.tangents[v])), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::dot(glm::vec3(primitive.tangents[v]), primitive.normals[v]), 0.0f, 1e-6f);
    }
}

TEST(Tangents, TextureWithoutAreaGetsAnyPerpendicular) {
    Primitive primitive = square();
    primitive.uvs[0].assign(4, {0.5f, 0.5f});
    makeTangents(primitive, primitive.uvs[0]);
    for (const glm::vec4& tangent : primitive.tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f);
        EXPECT_NEAR(tangent.z, 0.0f, 1e-6f);
        EXPECT_EQ(std::abs(tangent.w), 1.0f);
    }
}

TEST(Tangents, BrokenOnesOfTheFileAreRepaired) {
    Gltf gltf = triangle({{"normalTexture", {{"index", 0}}}});
    addTexture(gltf);
    json& attributes = gltf.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["TANGENT"] = gltf.floats({0, 0, 0, 1, 0, 0, 2, -1, kNan, 0, 0, 1}, "VEC4");
    const Imported imported = gltf.import();
    EXPECT_THAT(imported.scene.warnings, ElementsAre(HasSubstr("3 tangents")));
    for (const glm::vec4& tangent : imported.scene.primitives.at(0).tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f);
        EXPECT_NEAR(tangent.z, 0.0f, 1e-6f);
    }
    EXPECT_EQ(imported.scene.primitives.at(0).tangents[1].w, -1.0f);
}

TEST(Tangents, OfTheFileAreKept) {
    Gltf gltf = triangle({{"normalTexture", {{"index", 0}}}});
    addTexture(gltf);
    json& attributes = gltf.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["TANGENT"] = gltf.floats({0, 1, 0, -1, 0, 2, 0, 1, 0.6f, 0.8f, 0, 1}, "VEC4");
    EXPECT_THAT(gltf.import().scene.primitives.at(0).tangents,
                ElementsAre(glm::vec4(0, 1, 0, -1), glm::vec4(0, 1, 0, 1), glm::vec4(0.6f, 0.8f, 0, 1)));
}

TEST(Tangents, FollowTheNormalMapsTransform) {
    Gltf gltf =
        triangle({{"normalTexture",
                   {{"index", 0},
                    {"extensions", {{"KHR_texture_transform", {{"rotation", std::numbers::pi / 2}}}}}}}});
    addTexture(gltf);
    // u' = v, which decreases along y.
    const Imported imported = gltf.import();
    for (const glm::vec4& tangent : imported.scene.primitives.at(0).tangents) {
        expectNear(glm::vec3(tangent), {0, -1, 0});
        EXPECT_EQ(tangent.w, 1.0f);
    }
}

}  // namespace
}  // namespace lobe::test
