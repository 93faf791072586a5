#include "import/skin.hpp"

#include "import/accessors.hpp"
#include "import/refuse.hpp"

namespace lobe {

namespace {

/// Turns a normal as its surface is turned: the transpose of the inverse up to a positive factor, which is
/// defined for singular matrices too. Unit, or zero.
glm::dvec3 turnedNormal(const glm::dmat3& m, const glm::dvec3& normal) {
    const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const glm::dvec3 turned = cofactor * normal * (glm::determinant(m) < 0.0 ? -1.0 : 1.0);
    const double length = glm::length(turned);
    return length > 0.0 ? turned / length : glm::dvec3(0.0);
}

struct Blend {
    glm::dmat4 transform{0.0};
    double weight = 0.0;
};

}  // namespace

std::vector<glm::dmat4> jointTransforms(const Document& document, size_t index, const WorldPose& world) {
    const tinygltf::Skin& skin = document.model.skins[index];
    std::vector<glm::dmat4> transforms;
    transforms.reserve(skin.joints.size());
    for (const int joint : skin.joints) {
        transforms.push_back(world.transforms[static_cast<size_t>(joint)]);
    }
    if (skin.inverseBindMatrices < 0) {
        return transforms;
    }
    const std::string property = at("skins", index, "inverseBindMatrices");
    checkUse(document, skin.inverseBindMatrices,
             {property, TINYGLTF_TYPE_MAT4, {TINYGLTF_COMPONENT_TYPE_FLOAT}});
    const std::vector<float> values = readFloats(document, skin.inverseBindMatrices);
    if (values.size() < transforms.size() * 16) {
        refuse(document.file, property, std::to_string(values.size() / 16) + " matrices",
               "one for each of " + std::to_string(transforms.size()) + " joints");
    }
    for (size_t j = 0; j < transforms.size(); ++j) {
        glm::dmat4 inverseBind;
        for (size_t i = 0; i < 16; ++i) {
            inverseBind[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = double{values[j * 16 + i]};
        }
        transforms[j] = transforms[j] * inverseBind;
    }
    return transforms;
}

void applySkin(SourceMesh& mesh, const std::vector<glm::dmat4>& joints, Document& document,
               const std::string& property) {
    Primitive& primitive = mesh.primitive;
    if (mesh.joints.empty()) {
        refuse(document.file, property + ".attributes", "no JOINTS_0", "influences, as the node has a skin");
    }
    size_t unweighted = 0;
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        Blend blend;
        for (size_t set = 0; set < mesh.joints.size(); ++set) {
            for (int i = 0; i < 4; ++i) {
                const double weight = double{mesh.weights[set][v][i]};
                const uint32_t joint = mesh.joints[set][v][i];
                if (weight != 0.0 && joint >= joints.size()) {
                    refuse(document.file, property + ".attributes." + at("JOINTS_" + std::to_string(set), v),
                           std::to_string(joint),
                           "one of the skin's " + std::to_string(joints.size()) + " joints");
                }
                if (weight < 0.0) {
                    refuse(document.file, property + ".attributes." + at("WEIGHTS_" + std::to_string(set), v),
                           weight, "0 or more");
                }
                if (weight != 0.0) {
                    blend.transform += weight * joints[joint];
                    blend.weight += weight;
                }
            }
        }
        if (blend.weight > 0.0) {
            blend.transform /= blend.weight;  // weights stored in few bits add up to almost 1
        } else {
            ++unweighted;
            blend.transform = joints[std::min<size_t>(mesh.joints[0][v][0], joints.size() - 1)];
        }
        primitive.positions[v] = glm::vec3(blend.transform * glm::dvec4(primitive.positions[v], 1.0));
        const glm::dmat3 linear(blend.transform);
        if (!primitive.normals.empty()) {
            primitive.normals[v] = glm::vec3(turnedNormal(linear, glm::dvec3(primitive.normals[v])));
        }
        if (!primitive.tangents.empty()) {
            const glm::vec4 tangent = primitive.tangents[v];
            primitive.tangents[v] = glm::vec4(glm::vec3(linear * glm::dvec3(tangent)), tangent.w);
        }
    }
    if (unweighted > 0) {
        document.warn(property,
                      std::to_string(unweighted) + " vertices have no weights; moved with their first joint");
    }
}

}  // namespace lobe
