/// Nodes, animations, morph targets and skins, against values worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;
const float kHalf = std::sqrt(0.5f);

void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-6) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(value[c], expected[c], tolerance) << "component " << c;
    }
}

/// Where the shown triangle's instance takes a local point.
glm::dvec3 placed(const Imported& imported, const glm::dvec3& local, size_t instance = 0) {
    return {imported.scene.instances.at(instance).worldFromLocal * glm::dvec4(local, 1.0)};
}

TEST(Nodes, TransformsMultiplyDownTheTree) {
    Gltf gltf = triangle();
    gltf.doc["nodes"][0]["translation"] = {1, 0, 0};
    gltf.doc["nodes"].push_back({{"children", {0}},
                                 {"rotation", {0, 0, kHalf, kHalf}},
                                 {"scale", {2, 2, 2}},
                                 {"translation", {0, 0, 5}}});
    gltf.doc["scenes"][0]["nodes"] = {1};
    // (1 + 1, 0, 0) scaled by 2, turned a quarter about z, moved up by 5.
    expectNear(placed(gltf.import(), {1, 0, 0}), {0, 4, 5});
}

TEST(Nodes, MatrixIsColumnMajorAndDouble) {
    Gltf gltf = triangle();
    gltf.doc["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 123456789.125, 2, 3, 1};
    EXPECT_EQ(placed(gltf.import(), {1, 0, 0}), glm::dvec3(123456789.125, 3, 3));
}

TEST(Nodes, MeshesAreSharedByTheirNodes) {
    Gltf gltf = triangle();
    gltf.showNode({{"mesh", 0}, {"translation", {0, 1, 0}}, {"name", "second"}});
    const Imported imported = gltf.import();
    EXPECT_EQ(imported.scene.primitives.size(), 1U);
    ASSERT_EQ(imported.scene.instances.size(), 2U);
    EXPECT_EQ(imported.scene.instances[0].node, "nodes[0]");
    EXPECT_EQ(imported.scene.instances[1].node, "second");
    EXPECT_EQ(imported.scene.triangleCount(), 2U);
}

TEST(Nodes, TheDefaultSceneIsShown) {
    Gltf gltf = triangle();
    gltf.doc["nodes"].push_back({{"mesh", 0}, {"translation", {7, 0, 0}}});
    gltf.doc["scenes"].push_back({{"nodes", {1}}});
    expectNear(placed(gltf.import(), {0, 0, 0}), {0, 0, 0});
    gltf.doc["scene"] = 1;
    EXPECT_EQ(gltf.import().scene.instances.size(), 1U);
    expectNear(placed(gltf.import(), {0, 0, 0}), {7, 0, 0});
    gltf.doc.erase("scene");
    gltf.doc.erase("scenes");
    EXPECT_EQ(gltf.import().scene.instances.size(), 2U);
}

TEST(Nodes, RotationsAreNormalised) {
    Gltf gltf = triangle();
    gltf.doc["nodes"][0]["rotation"] = {0, 0, 2, 2};
    const Imported imported = gltf.import();
    expectNear(placed(imported, {1, 0, 0}), {0, 1, 0});
    EXPECT_THAT(imported.scene.warnings, ElementsAre(HasSubstr("no unit quaternion")));
}

/// A triangle whose node is animated: `output` at times 1, 2, 4 s.
Gltf animated(const std::string& path, const std::vector<float>& output, const std::string& type,
              const std::string& interpolation) {
    Gltf gltf = triangle();
    const int input = gltf.floats({1, 2, 4}, "SCALAR");
    const int values = gltf.floats(output, type);
    gltf.push("animations",
              {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
               {"samplers", {{{"input", input}, {"output", values}, {"interpolation", interpolation}}}}});
    return gltf;
}

TEST(Animation, LinearStepAndClamping) {
    const std::vector<float> places{0, 0, 0, 2, 0, 0, 2, 6, 0};
    struct Case {
        double time;
        glm::dvec3 linear, step;
    };
    for (const Case& c : {Case{0.0, {0, 0, 0}, {0, 0, 0}}, Case{1.5, {1, 0, 0}, {0, 0, 0}},
                          Case{2.0, {2, 0, 0}, {2, 0, 0}}, Case{3.0, {2, 3, 0}, {2, 0, 0}},
                          Case{4.0, {2, 6, 0}, {2, 6, 0}}, Case{99.0, {2, 6, 0}, {2, 6, 0}}}) {
        const LoadOptions options{c.time};
        expectNear(placed(animated("translation", places, "VEC3", "LINEAR").import(options), {0, 0, 0}),
                   c.linear);
        expectNear(placed(animated("translation", places, "VEC3", "STEP").import(options), {0, 0, 0}),
                   c.step);
    }
    EXPECT_THAT(animated("translation", places, "VEC3", "STEP").import().scene.animationDurations,
                ElementsAre(4.0));
}

TEST(Animation, CubicSplineFollowsHermite) {
    // x(1) = 0 leaving with slope 1; x(2) = 2 arriving with slope 3 and leaving with slope -1; x(4) = 0,
    // slope 2.
    const std::vector<float> keys{0, 0,  0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 2, 0,
                                  0, -1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0};
    const Gltf gltf = animated("translation", keys, "VEC3", "CUBICSPLINE");
    // At t = 1/2: 1/2 p0 + td/8 m0 + 1/2 p1 - td/8 m1.
    expectNear(placed(gltf.import({1.5}), {0, 0, 0}), {0.5 * 0 + 1.0 / 8 * 1 + 0.5 * 2 - 1.0 / 8 * 3, 0, 0});
    expectNear(placed(gltf.import({3.0}), {0, 0, 0}), {0.5 * 2 + 2.0 / 8 * -1 + 0.5 * 0 - 2.0 / 8 * 2, 0, 0});
    // At t = 1/4 of the first: (2/64 - 3/16 + 1) p0 + (1/64 - 2/16 + 1/4) m0 + (-2/64 + 3/16) p1 + (1/64 -
    // 1/16) m1.
    expectNear(placed(gltf.import({1.25}), {0, 0, 0}), {9.0 / 64 + 10.0 / 64 * 2 - 3.0 / 64 * 3, 0, 0});
}

TEST(Animation, RotationsTakeTheShortWayAtConstantSpeed) {
    // 0, then 90 degrees written with the opposite sign, then 90 degrees.
    const std::vector<float> turns{0, 0, 0, 1, 0, 0, -kHalf, -kHalf, 0, 0, kHalf, kHalf};
    const double third = kPi / 2 / 3;
    const Gltf gltf = animated("rotation", turns, "VEC4", "LINEAR");
    expectNear(placed(gltf.import({1.0 + 1.0 / 3}), {1, 0, 0}), {std::cos(third), std::sin(third), 0});
    expectNear(placed(gltf.import({3.0}), {1, 0, 0}), {0, 1, 0});
}

TEST(Animation, RotationsOfNormalisedIntegers) {
    Gltf gltf = animated("rotation", std::vector<float>(12, 1.0f), "VEC4", "LINEAR");
    gltf.doc["animations"][0]["samplers"][0]["output"] = gltf.accessor(
        std::vector<int16_t>{0, 0, 0, 32767, 0, 0, 32767, 0, 0, 0, 32767, 0}, "VEC4", kInt16, true);
    expectNear(placed(gltf.import({1.5}), {1, 0, 0}), {0, 1, 0});
    expectNear(placed(gltf.import({2.0}), {1, 0, 0}), {-1, 0, 0});
}

TEST(Animation, ScaleAndSeveralAnimations) {
    Gltf gltf = animated("scale", {1, 1, 1, 3, 1, 1, 1, 1, 1}, "VEC3", "LINEAR");
    const int input = gltf.floats({0, 10}, "SCALAR");
    gltf.push("animations",
              {{"channels",
                {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                 {{"sampler", 0}, {"target", {{"path", "translation"}}}}}},
               {"samplers", {{{"input", input}, {"output", gltf.floats({0, 0, 0, 0, 10, 0}, "VEC3")}}}}});
    const Imported imported = gltf.import({1.5});
    expectNear(placed(imported, {1, 0, 0}), {2, 1.5, 0});
    EXPECT_THAT(imported.scene.animationDurations, ElementsAre(4.0, 10.0));
}

/// The triangle with two targets: one lifts it along z, one moves its second corner along x.
Gltf morphed() {
    Gltf gltf = triangle();
    json& primitive = gltf.doc["meshes"][0]["primitives"][0];
    primitive["targets"] = {{{"POSITION", gltf.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                             {"NORMAL", gltf.floats({1, 0, -1, 1, 0, -1, 1, 0, -1}, "VEC3")}},
                            {{"POSITION", gltf.floats({0, 0, 0, 4, 0, 0, 0, 0, 0}, "VEC3")}}};
    return gltf;
}

TEST(Morph, WeightsOfMeshAndNode) {
    Gltf gltf = morphed();
    EXPECT_EQ(gltf.import().scene.primitives.at(0).positions.at(1), glm::vec3(1, 0, 0));
    gltf.doc["meshes"][0]["weights"] = {1, 0.5};
    gltf.showNode({{"mesh", 0}, {"weights", {0.25, 0}}});
    const Imported imported = gltf.import();
    ASSERT_EQ(imported.scene.primitives.size(), 2U);
    EXPECT_EQ(imported.scene.primitives[0].positions.at(1), glm::vec3(3, 0, 1));
    expectNear(imported.scene.primitives[0].normals.at(1), {1, 0, 0});
    EXPECT_EQ(imported.scene.primitives[1].positions.at(1), glm::vec3(1, 0, 0.25f));
    expectNear(imported.scene.primitives[1].normals.at(0), glm::normalize(glm::dvec3(0.25, 0, 0.75)));
}

TEST(Morph, WeightsAreAnimated) {
    Gltf gltf = morphed();
    const int input = gltf.floats({0, 1}, "SCALAR");
    gltf.push("animations",
              {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
               {"samplers", {{{"input", input}, {"output", gltf.floats({0, 1, 1, 0}, "SCALAR")}}}}});
    EXPECT_EQ(gltf.import({0.25}).scene.primitives.at(0).positions.at(1), glm::vec3(4, 0, 0.25f));
}

TEST(Morph, SparseTargets) {
    Gltf gltf = triangle();
    const int sparse = gltf.push(
        "accessors",
        {{"componentType", kFloat32},
         {"count", 3},
         {"type", "VEC3"},
         {"sparse",
          {{"count", 1},
           {"indices", {{"bufferView", gltf.view(std::vector<uint8_t>{2})}, {"componentType", kUint8}}},
           {"values", {{"bufferView", gltf.view(std::vector<float>{0, 3, 0})}}}}}});
    gltf.doc["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", sparse}}};
    gltf.doc["meshes"][0]["weights"] = {2};
    EXPECT_THAT(gltf.import().scene.primitives.at(0).positions,
                ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 7, 0)));
}

/// The triangle hung on two joints: the first corner on joint 0, the second on joint 1, the third on both in
/// halves. Joint 1 is bound at (1, 0, 0) and turned a quarter about z; the skinned node itself is far away.
Gltf skinned() {
    Gltf gltf = triangle();
    json& attributes = gltf.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] =
        gltf.accessor(std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4", kUint8);
    attributes["WEIGHTS_0"] =
        gltf.accessor(std::vector<uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 127, 127, 0, 0}, "VEC4", kUint8, true);
    const int root = gltf.showNode({{"translation", {0, 0, 10}}});
    const int tip = gltf.push("nodes", {{"translation", {1, 0, 0}}, {"rotation", {0, 0, kHalf, kHalf}}});
    gltf.doc["nodes"][static_cast<size_t>(root)]["children"] = {tip};
    std::vector<float> inverse(32, 0.0f);
    for (size_t i = 0; i < 8; ++i) {
        inverse[i / 4 * 16 + i % 4 * 5] = 1.0f;
    }
    inverse[16 + 12] = -1.0f;
    gltf.push("skins", {{"joints", {root, tip}}, {"inverseBindMatrices", gltf.floats(inverse, "MAT4")}});
    gltf.doc["nodes"][0]["skin"] = 0;
    gltf.doc["nodes"][0]["translation"] = {1000, 0, 0};
    return gltf;
}

TEST(Skin, BlendsJointsInWorldSpace) {
    const Imported imported = skinned().import();
    const Primitive& primitive = imported.scene.primitives.at(0);
    expectNear(placed(imported, primitive.positions.at(0)), {0, 0, 10});
    // (1, 0, 0) is joint 1's own place.
    expectNear(placed(imported, primitive.positions.at(1)), {1, 0, 10});
    // (0, 1, 0): joint 0 leaves it, joint 1 turns (-1, 1) to (-1, -1) and puts it back: (0, -1).
    expectNear(placed(imported, primitive.positions.at(2)), {0, 0, 10});
    for (const glm::vec3& normal : primitive.normals) {
        expectNear(normal, {0, 0, 1});
    }
    EXPECT_THAT(imported.scene.warnings, IsEmpty());
}

TEST(Skin, NormalsTurnWithScaledJoints) {
    Gltf gltf = skinned();
    gltf.doc["nodes"][1]["scale"] = {1, 4, 1};
    gltf.doc["nodes"][2].erase("rotation");
    json& attributes = gltf.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = gltf.floats({kHalf, kHalf, 0, kHalf, kHalf, 0, kHalf, kHalf, 0}, "VEC3");
    // A surface stretched fourfold along y leans by the inverse.
    expectNear(gltf.import().scene.primitives.at(0).normals.at(0), glm::normalize(glm::dvec3(4, 1, 0)));
}

TEST(Skin, IsPosedByAnimations) {
    Gltf gltf = skinned();
    const int input = gltf.floats({0, 1}, "SCALAR");
    gltf.push("animations",
              {{"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}},
               {"samplers", {{{"input", input}, {"output", gltf.floats({1, 0, 0, 1, 0, 2}, "VEC3")}}}}});
    expectNear(gltf.import({0.5}).scene.primitives.at(0).positions.at(1), {1, 0, 11});
}

TEST(Skin, DamageIsRefusedOrNamed) {
    Gltf foreignJoint = skinned();
    foreignJoint.doc["skins"][0]["joints"] = {1};
    EXPECT_THAT(foreignJoint.refusal(), HasSubstr("JOINTS_0[1]: 1; expected one of the skin's 1 joints"));
    Gltf fewMatrices = skinned();
    fewMatrices
        .doc["accessors"][static_cast<size_t>(fewMatrices.doc["skins"][0]["inverseBindMatrices"])]["count"] =
        1;
    EXPECT_THAT(fewMatrices.refusal(), HasSubstr("skins[0].inverseBindMatrices: 1 matrices; expected"));
    Gltf noJoints = skinned();
    noJoints.doc["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
    EXPECT_THAT(noJoints.refusal(), HasSubstr("JOINTS_0"));
    Gltf unweighted = skinned();
    unweighted.doc["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
        unweighted.floats(std::vector<float>(12, 0.0f), "VEC4");
    EXPECT_THAT(unweighted.import().scene.warnings, ElementsAre(HasSubstr("3 vertices have no weights")));
}

TEST(Animation, DamageIsRefused) {
    const std::vector<float> places(9, 0.0f);
    Gltf unsorted = animated("translation", places, "VEC3", "LINEAR");
    unsorted.doc["animations"][0]["samplers"][0]["input"] = unsorted.floats({1, 1, 2}, "SCALAR");
    EXPECT_THAT(unsorted.refusal(), HasSubstr("samplers[0].input, key 1: 1; expected times that grow"));
    Gltf few = animated("translation", {0, 0, 0}, "VEC3", "LINEAR");
    EXPECT_THAT(few.refusal(), HasSubstr("1 values; expected 3 for 3 keys"));
    Gltf notCubic = animated("translation", places, "VEC3", "CUBICSPLINE");
    EXPECT_THAT(notCubic.refusal(), HasSubstr("3 values; expected 9 for 3 keys"));
    Gltf sampler = animated("translation", places, "VEC3", "LINEAR");
    sampler.doc["animations"][0]["channels"][0]["sampler"] = 1;
    EXPECT_THAT(sampler.refusal(), HasSubstr("animations[0].channels[0].sampler: 1; expected"));
    Gltf matrix = animated("translation", places, "VEC3", "LINEAR");
    matrix.doc["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_THAT(matrix.refusal(), HasSubstr("not a matrix"));
    Gltf weights = animated("weights", {0, 0, 0}, "SCALAR", "LINEAR");
    EXPECT_THAT(weights.refusal(), HasSubstr("weights of a node without morph targets"));
    Gltf type = animated("translation", places, "SCALAR", "LINEAR");
    EXPECT_THAT(type.refusal(), HasSubstr("is a scalar of float; expected one of vec3 of float"));
}

}  // namespace
}  // namespace lobe::test
