/// A primitive's vertex data as the file has it: decoded, checked, with triangles as a list and morph targets
/// added.
#pragma once

#include <optional>
#include <vector>

#include "import/document.hpp"
#include "scene/scene.hpp"

namespace lobe {

struct SourceMesh {
    Primitive primitive;  ///< normals, tangents, uvs and colors empty where the file has none
    /// Influences of a skin, four a set and vertex.
    std::vector<std::vector<glm::uvec4>> joints;
    std::vector<std::vector<glm::vec4>> weights;
};

/// Least bytes that each primitive of a mesh takes unpacked, from the counts that it states.
std::vector<uint64_t> geometryBytes(const Document& document, size_t mesh);

/// Nothing, with a warning, for what is not drawn: points, lines, and primitives without positions.
/// `morphWeights` has one weight a target or is empty. Throws InputError.
std::optional<SourceMesh> readSourceMesh(Document& document, size_t mesh, size_t primitive,
                                         const std::vector<double>& morphWeights);

}  // namespace lobe
