#include "import/draco_mesh.hpp"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <array>

#include "import/accessors.hpp"
#include "import/refuse.hpp"

namespace lobe {

namespace {

/// What a normalised integer of this component type is divided by.
float normalizationOf(int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 127.0f;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 255.0f;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 32767.0f;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 65535.0f;
        default:
            return 1.0f;
    }
}

constexpr size_t kMostComponents = 4;

template<typename Value>
bool convertPoints(const draco::Mesh& mesh, const draco::PointAttribute& attribute, size_t components,
                   Value* out) {
    for (uint32_t point = 0; point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(point));
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<Value>(value, static_cast<int8_t>(components),
                                           out + point * components)) {
            return false;
        }
    }
    return true;
}

}  // namespace

DracoMesh::DracoMesh(std::span<const std::byte> compressed, const std::string& file,
                     const std::string& property)
    : file_(file), property_(property) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        refuse(file_, property_, decoded.status().error_msg_string(), "a mesh compressed by Draco");
    }
    mesh_ = std::move(decoded).value();
    for (uint32_t face = 0; face < mesh_->num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh_->face(draco::FaceIndex(face))) {
            if (point.value() >= mesh_->num_points()) {
                refuse(file_, property_, "a corner at point " + std::to_string(point.value()),
                       "one of " + std::to_string(mesh_->num_points()) + " points");
            }
        }
    }
}

DracoMesh::~DracoMesh() = default;

size_t DracoMesh::pointCount() const {
    return mesh_->num_points();
}

std::vector<uint32_t> DracoMesh::indices() const {
    std::vector<uint32_t> indices;
    indices.reserve(size_t{mesh_->num_faces()} * 3);
    for (uint32_t face = 0; face < mesh_->num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh_->face(draco::FaceIndex(face))) {
            indices.push_back(point.value());
        }
    }
    return indices;
}

const draco::PointAttribute& DracoMesh::attribute(uint32_t id, size_t components) const {
    const draco::PointAttribute* attribute = mesh_->GetAttributeByUniqueId(id);
    if (attribute == nullptr || components > kMostComponents ||
        static_cast<size_t>(attribute->num_components()) != components) {
        refuse(file_, property_, "attribute " + std::to_string(id),
               "an attribute of " + std::to_string(components) + " components in the compressed mesh");
    }
    return *attribute;
}

void DracoMesh::readFloats(uint32_t id, const tinygltf::Accessor& accessor, float* out) const {
    const size_t components = componentCount(accessor);
    const draco::PointAttribute& source = attribute(id, components);
    if (!convertPoints(*mesh_, source, components, out)) {
        refuse(file_, property_, "attribute " + std::to_string(id), "numbers that a float can hold");
    }
    const bool integers = source.data_type() != draco::DT_FLOAT32 && source.data_type() != draco::DT_FLOAT64;
    if (accessor.normalized && integers && !source.normalized()) {
        const float scale = 1.0f / normalizationOf(accessor.componentType);
        for (size_t i = 0; i < pointCount() * components; ++i) {
            out[i] = std::max(out[i] * scale, -1.0f);
        }
    }
}

void DracoMesh::readIntegers(uint32_t id, const tinygltf::Accessor& accessor, uint32_t* out) const {
    const size_t components = componentCount(accessor);
    if (!convertPoints(*mesh_, attribute(id, components), components, out)) {
        refuse(file_, property_, "attribute " + std::to_string(id), "unsigned integers");
    }
}

}  // namespace lobe
