#include "import/nodes.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "import/gltf_schema.hpp"
#include "import/refuse.hpp"

namespace lobe {

namespace {

constexpr double kUnitTolerance = 1e-3;  // rotations off unit length by more than file formats' rounding

std::vector<int> shownRoots(const Document& document, const std::vector<int>& parents) {
    if (const auto scene = shownScene(document)) {
        return document.model.scenes[*scene].nodes;
    }
    std::vector<int> roots;
    for (size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] < 0) {
            roots.push_back(static_cast<int>(i));
        }
    }
    return roots;
}

/// `roots` and all below them, parents first, each once.
std::vector<int> below(const Document& document, const std::vector<int>& roots) {
    std::vector<char> seen(document.model.nodes.size(), 0);
    std::vector<int> order;
    const auto add = [&](int node) {
        if (seen[static_cast<size_t>(node)] == 0) {
            seen[static_cast<size_t>(node)] = 1;
            order.push_back(node);
        }
    };
    for (const int root : roots) {
        add(root);
    }
    for (size_t i = 0; i < order.size(); ++i) {
        for (const int child : document.model.nodes[static_cast<size_t>(order[i])].children) {
            add(child);
        }
    }
    return order;
}

/// The rotation nearest to a matrix by Gram-Schmidt; a mirrored one is turned right by its x axis.
glm::dquat rotationOf(const glm::dmat4& matrix) {
    const glm::dvec3 z = glm::dvec3(matrix[2]);
    const glm::dvec3 y = glm::dvec3(matrix[1]);
    const double zLength = glm::length(z);
    if (!(zLength > 0.0)) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    const glm::dvec3 back = z / zLength;
    const glm::dvec3 up = y - back * glm::dot(y, back);
    const double upLength = glm::length(up);
    if (!(upLength > 0.0)) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    const glm::dvec3 unitUp = up / upLength;
    return glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(unitUp, back), unitUp, back)));
}

NodePose readPose(Document& document, size_t index) {
    const tinygltf::Node& node = document.model.nodes[index];
    NodePose pose;
    pose.weights = node.weights;
    if (!node.matrix.empty()) {
        if (document.json["nodes"][index].contains("translation") ||
            document.json["nodes"][index].contains("rotation") ||
            document.json["nodes"][index].contains("scale")) {
            refuse(document.file, at("nodes", index), "both matrix and translation, rotation or scale",
                   "one of them");
        }
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) {
            matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        }
        const glm::dvec4 lastRow(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3] - 1.0);
        if (glm::length(lastRow) > 1e-6) {
            refuse(document.file, at("nodes", index, "matrix"),
                   shown(document.json["nodes"][index]["matrix"]),
                   "an affine transform, whose last row is 0, 0, 0, 1");
        }
        matrix[0][3] = matrix[1][3] = matrix[2][3] = 0.0;
        matrix[3][3] = 1.0;
        pose.matrix = matrix;
        return pose;
    }
    if (!node.translation.empty()) {
        pose.translation = {node.translation[0], node.translation[1], node.translation[2]};
    }
    if (!node.scale.empty()) {
        pose.scale = {node.scale[0], node.scale[1], node.scale[2]};
    }
    if (!node.rotation.empty()) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(rotation);
        if (!(length > 0.0) || !std::isfinite(length)) {
            refuse(document.file, at("nodes", index, "rotation"),
                   shown(document.json["nodes"][index]["rotation"]), "a unit quaternion");
        }
        if (std::abs(length - 1.0) > kUnitTolerance) {
            document.warn(at("nodes", index, "rotation"), "is no unit quaternion; normalised");
        }
        pose.rotation = rotation / length;
    }
    return pose;
}

glm::dmat4 localTransform(const NodePose& pose) {
    if (pose.matrix) {
        return *pose.matrix;
    }
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), pose.translation);
    return glm::scale(moved * glm::mat4_cast(pose.rotation), pose.scale);
}

bool isFinite(const glm::dmat4& matrix) {
    double sum = 0.0;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            sum += matrix[column][row] * 0.0;  // NaN if any is not finite
        }
    }
    return sum == 0.0;
}

}  // namespace

NodeTree readNodeTree(const Document& document) {
    const auto& nodes = document.model.nodes;
    NodeTree tree;
    tree.parents.assign(nodes.size(), -1);
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (size_t c = 0; c < nodes[i].children.size(); ++c) {
            int& parent = tree.parents[static_cast<size_t>(nodes[i].children[c])];
            if (parent >= 0) {
                refuse(document.file, at(at("nodes", i, "children"), c), std::to_string(nodes[i].children[c]),
                       "a node without another parent; it is a child of " +
                           at("nodes", static_cast<size_t>(parent)) + " too");
            }
            parent = static_cast<int>(i);
        }
    }
    std::vector<int> roots;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (tree.parents[i] < 0) {
            roots.push_back(static_cast<int>(i));
        }
    }
    tree.order = below(document, roots);
    if (tree.order.size() < nodes.size()) {
        std::vector<char> reached(nodes.size(), 0);
        for (const int node : tree.order) {
            reached[static_cast<size_t>(node)] = 1;
        }
        size_t first = 0;
        while (reached[first] != 0) {
            ++first;
        }
        refuse(document.file, at("nodes", first, "children"), "a cycle", "a tree: no node is below itself");
    }
    tree.drawn = below(document, shownRoots(document, tree.parents));
    return tree;
}

std::optional<size_t> shownScene(const Document& document) {
    if (document.model.scenes.empty()) {
        return std::nullopt;
    }
    return document.model.defaultScene < 0 ? 0 : static_cast<size_t>(document.model.defaultScene);
}

std::vector<NodePose> readRestPose(Document& document) {
    std::vector<NodePose> pose;
    pose.reserve(document.model.nodes.size());
    for (size_t i = 0; i < document.model.nodes.size(); ++i) {
        pose.push_back(readPose(document, i));
    }
    return pose;
}

bool castsShadow(const Document& document, size_t node) {
    const nlohmann::json* shadow = document.extension("nodes", node, kShadowExtension);
    return shadow == nullptr || shadow->value("cast", true);
}

WorldPose worldPose(const Document& document, const NodeTree& tree, const std::vector<NodePose>& pose) {
    WorldPose world;
    world.transforms.assign(pose.size(), glm::dmat4(1.0));
    world.rotations.assign(pose.size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    for (const int node : tree.order) {
        const auto index = static_cast<size_t>(node);
        glm::dmat4& transform = world.transforms[index];
        glm::dquat& rotation = world.rotations[index];
        transform = localTransform(pose[index]);
        rotation = pose[index].matrix ? rotationOf(*pose[index].matrix) : pose[index].rotation;
        if (tree.parents[index] >= 0) {
            const auto parent = static_cast<size_t>(tree.parents[index]);
            transform = world.transforms[parent] * transform;
            rotation = glm::normalize(world.rotations[parent] * rotation);
        }
        if (!isFinite(transform)) {
            refuse(document.file, at("nodes", index), "its place in the world is not finite",
                   "transforms that multiply to finite numbers");
        }
    }
    return world;
}

}  // namespace lobe
