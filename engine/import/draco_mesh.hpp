/// KHR_draco_mesh_compression. tinygltf's own decoder is not used: it follows attribute ids and accessor
/// types of the file unchecked.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "import/document.hpp"

namespace draco {
class Mesh;
class PointAttribute;
}  // namespace draco

namespace lobe {

class DracoMesh {
public:
    /// Throws InputError "FILE: PROPERTY: ...".
    DracoMesh(std::span<const std::byte> compressed, const std::string& file, const std::string& property);
    ~DracoMesh();

    size_t pointCount() const;
    std::vector<uint32_t> indices() const;

    /// All components of attribute `id`, one point after another, as the accessor describes them. Throws
    /// InputError if there is no such attribute or it has another number of components.
    void readFloats(uint32_t id, const tinygltf::Accessor& accessor, float* out) const;
    void readIntegers(uint32_t id, const tinygltf::Accessor& accessor, uint32_t* out) const;

private:
    const draco::PointAttribute& attribute(uint32_t id, size_t components) const;
    std::string file_;
    std::string property_;
    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace lobe
