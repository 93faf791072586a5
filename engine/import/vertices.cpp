#include "import/vertices.hpp"

#include <numeric>

namespace lobe {

namespace {

constexpr uint32_t kNone = UINT32_MAX;

template<typename Values>
void appendCopy(Values& values, uint32_t vertex) {
    if (!values.empty()) {
        const auto value = values[vertex];
        values.push_back(value);
    }
}

uint32_t appendVertex(Primitive& primitive, uint32_t vertex) {
    appendCopy(primitive.normals, vertex);
    appendCopy(primitive.tangents, vertex);
    for (auto& uvs : primitive.uvs) {
        appendCopy(uvs, vertex);
    }
    appendCopy(primitive.colors, vertex);
    appendCopy(primitive.positions, vertex);
    return static_cast<uint32_t>(primitive.positions.size() - 1);
}

template<typename Values>
void gather(Values& values, const std::vector<uint32_t>& indices) {
    if (values.empty()) {
        return;
    }
    Values gathered;
    gathered.reserve(indices.size());
    for (const uint32_t index : indices) {
        gathered.push_back(values[index]);
    }
    values = std::move(gathered);
}

}  // namespace

std::vector<uint32_t> splitVertices(Primitive& primitive, std::span<const uint32_t> keys) {
    std::vector<uint32_t> cornerOf(primitive.positions.size(), kNone);
    std::vector<uint32_t> next(primitive.positions.size(),
                               kNone);  // the split-off vertices of each, as a list
    for (uint32_t corner = 0; corner < primitive.indices.size(); ++corner) {
        uint32_t vertex = primitive.indices[corner];
        while (cornerOf[vertex] != kNone && keys[cornerOf[vertex]] != keys[corner]) {
            if (next[vertex] == kNone) {
                const uint32_t added = appendVertex(primitive, vertex);
                cornerOf.push_back(kNone);
                next.push_back(kNone);
                next[vertex] = added;
            }
            vertex = next[vertex];
        }
        if (cornerOf[vertex] == kNone) {
            cornerOf[vertex] = corner;
        }
        primitive.indices[corner] = vertex;
    }
    return cornerOf;
}

void unshareVertices(Primitive& primitive) {
    gather(primitive.normals, primitive.indices);
    gather(primitive.tangents, primitive.indices);
    for (auto& uvs : primitive.uvs) {
        gather(uvs, primitive.indices);
    }
    gather(primitive.colors, primitive.indices);
    gather(primitive.positions, primitive.indices);
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
}

}  // namespace lobe
