/// Skinning on the CPU.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "import/nodes.hpp"
#include "import/source_mesh.hpp"

namespace lobe {

/// World from bind space for each joint of a skin.
std::vector<glm::dmat4> jointTransforms(const Document& document, size_t skin, const WorldPose& world);

/// Moves positions, normals and tangents into world space. `property` names the primitive. Throws InputError.
void applySkin(SourceMesh& mesh, const std::vector<glm::dmat4>& joints, Document& document,
               const std::string& property);

}  // namespace lobe
