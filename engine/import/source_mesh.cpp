#include "import/source_mesh.hpp"

#include <numeric>

#include "import/accessors.hpp"
#include "import/draco_mesh.hpp"
#include "import/refuse.hpp"

namespace lobe {

namespace {

using Normalized = AccessorUse::Normalized;
constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
constexpr int kI8 = TINYGLTF_COMPONENT_TYPE_BYTE;
constexpr int kU8 = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
constexpr int kI16 = TINYGLTF_COMPONENT_TYPE_SHORT;
constexpr int kU16 = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
constexpr int kU32 = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
const std::vector<int> kPositionTypes{kFloat, kI8, kU8, kI16, kU16};  // integers: KHR_mesh_quantization
const std::vector<int> kDirectionTypes{kFloat, kI8, kI16};
const std::vector<int> kFractionTypes{kFloat, kU8, kU16};
const std::vector<int> kJointTypes{kU8, kU16};
const std::vector<int> kIndexTypes{kU8, kU16, kU32};

class Reader {
public:
    Reader(Document& document, size_t mesh, size_t primitive)
        : document_(document),
          source_(document.model.meshes[mesh].primitives[primitive]),
          property_(at("meshes", mesh, at("primitives", primitive))) {
        const nlohmann::json& json = document.json["meshes"][mesh]["primitives"][primitive];
        if (const nlohmann::json* extension = findExtension(json, "KHR_draco_mesh_compression")) {
            dracoIds_ = (*extension)["attributes"];
            draco_.emplace(document.viewBytes((*extension)["bufferView"].get<size_t>()), document.file,
                           property_ + ".extensions.KHR_draco_mesh_compression");
        }
    }

    std::optional<SourceMesh> read(const std::vector<double>& morphWeights) {
        if (source_.mode < TINYGLTF_MODE_TRIANGLES) {
            document_.warn(property_ + ".mode", "points and lines are not drawn; left out");
            return std::nullopt;
        }
        if (!source_.attributes.contains("POSITION")) {
            document_.warn(property_ + ".attributes", "has no POSITION; left out");
            return std::nullopt;
        }
        SourceMesh result;
        Primitive& primitive = result.primitive;
        count_ = vertexCount();
        readAttribute("POSITION", TINYGLTF_TYPE_VEC3, kPositionTypes, Normalized::either,
                      primitive.positions);
        readAttribute("NORMAL", TINYGLTF_TYPE_VEC3, kDirectionTypes, Normalized::integersMust,
                      primitive.normals);
        readAttribute("TANGENT", TINYGLTF_TYPE_VEC4, kDirectionTypes, Normalized::integersMust,
                      primitive.tangents);
        for (size_t set = 0; set < primitive.uvs.size(); ++set) {
            readAttribute("TEXCOORD_" + std::to_string(set), TINYGLTF_TYPE_VEC2, kPositionTypes,
                          Normalized::either, primitive.uvs[set]);
        }
        readColors(primitive.colors);
        readInfluences(result);
        addMorphTargets(primitive, morphWeights);
        primitive.indices = triangles(readIndices());
        return result;
    }

private:
    const tinygltf::Accessor& accessor(int index) const {
        return document_.model.accessors[static_cast<size_t>(index)];
    }

    /// The compressed attribute's id, if it is compressed.
    std::optional<uint32_t> dracoId(const std::string& name) const {
        const auto found = dracoIds_.find(name);
        return draco_ && found != dracoIds_.end() ? std::optional(found->get<uint32_t>()) : std::nullopt;
    }

    size_t vertexCount() const {
        const size_t described = accessor(source_.attributes.at("POSITION")).count;
        if (draco_ && draco_->pointCount() != described) {
            refuse(document_.file, property_ + ".attributes.POSITION",
                   std::to_string(described) + " vertices",
                   "the " + std::to_string(draco_->pointCount()) + " of the compressed mesh");
        }
        return described;
    }

    /// Checks attribute `name` and returns its accessor, or -1 if there is none.
    int checkAttribute(const std::string& name, int type, const std::vector<int>& componentTypes,
                       Normalized normalized) const {
        const auto found = source_.attributes.find(name);
        if (found == source_.attributes.end()) {
            return -1;
        }
        const std::string property = property_ + ".attributes." + name;
        AccessorUse use{property, type, componentTypes, normalized};
        use.mayBeCompressed = dracoId(name).has_value();
        checkUse(document_, found->second, use);
        checkCount(found->second, property);
        return found->second;
    }

    void checkCount(int index, const std::string& property) const {
        if (accessor(index).count != count_) {
            refuse(document_.file, property, std::to_string(accessor(index).count) + " elements",
                   "as many as POSITION, " + std::to_string(count_));
        }
    }

    /// NaN is let through for normals and tangents, which are repaired.
    void readValues(const std::string& name, int index, float* out) const {
        const size_t count = count_ * componentCount(accessor(index));
        if (const auto id = dracoId(name)) {
            draco_->readFloats(*id, accessor(index), out);
        } else {
            readFloats(document_, index, out);
        }
        const size_t bad = name == "NORMAL" || name == "TANGENT" ? count : firstNonFinite(out, count);
        if (bad < count) {
            refuse(document_.file,
                   property_ + ".attributes." + name + ", vertex " +
                       std::to_string(bad / componentCount(accessor(index))),
                   static_cast<double>(out[bad]), "finite numbers");
        }
    }

    template<typename Vector>
    void readAttribute(const std::string& name, int type, const std::vector<int>& componentTypes,
                       Normalized normalized, std::vector<Vector>& out) const {
        const int index = checkAttribute(name, type, componentTypes, normalized);
        if (index >= 0) {
            out.resize(count_);
            readValues(name, index, &out[0].x);
        }
    }

    void readColors(std::vector<glm::vec4>& colors) const {
        const auto found = source_.attributes.find("COLOR_0");
        if (found == source_.attributes.end()) {
            return;
        }
        if (accessor(found->second).type == TINYGLTF_TYPE_VEC3) {
            std::vector<glm::vec3> opaque;
            readAttribute("COLOR_0", TINYGLTF_TYPE_VEC3, kFractionTypes, Normalized::integersMust, opaque);
            colors.assign(count_, glm::vec4(1.0f));
            for (size_t i = 0; i < count_; ++i) {
                colors[i] = glm::vec4(opaque[i], 1.0f);
            }
        } else {
            readAttribute("COLOR_0", TINYGLTF_TYPE_VEC4, kFractionTypes, Normalized::integersMust, colors);
        }
    }

    void readInfluences(SourceMesh& result) const {
        for (int set = 0; source_.attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
            const std::string joints = "JOINTS_" + std::to_string(set);
            const std::string weights = "WEIGHTS_" + std::to_string(set);
            if (!source_.attributes.contains(weights)) {
                refuse(document_.file, property_ + ".attributes." + weights, "missing",
                       "weights beside " + joints);
            }
            const int index = checkAttribute(joints, TINYGLTF_TYPE_VEC4, kJointTypes, Normalized::never);
            std::vector<glm::uvec4>& out = result.joints.emplace_back(count_);
            if (const auto id = dracoId(joints)) {
                draco_->readIntegers(*id, accessor(index), &out[0].x);
            } else {
                const std::vector<uint32_t> values = readIntegers(document_, index);
                for (size_t i = 0; i < count_; ++i) {
                    out[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
                }
            }
            readAttribute(weights, TINYGLTF_TYPE_VEC4, kFractionTypes, Normalized::integersMust,
                          result.weights.emplace_back());
        }
    }

    void addMorphTargets(Primitive& primitive, const std::vector<double>& weights) const {
        if (weights.size() > source_.targets.size()) {
            refuse(document_.file, property_ + ".targets",
                   std::to_string(source_.targets.size()) + " targets",
                   "one for each of " + std::to_string(weights.size()) + " weights");
        }
        for (size_t t = 0; t < weights.size(); ++t) {
            const auto weight = static_cast<float>(weights[t]);
            addDeltas(t, "POSITION", TINYGLTF_TYPE_VEC3, kDirectionTypes, weight, primitive.positions);
            addDeltas(t, "NORMAL", TINYGLTF_TYPE_VEC3, kDirectionTypes, weight, primitive.normals);
            addDeltas(t, "TANGENT", TINYGLTF_TYPE_VEC3, kDirectionTypes, weight, primitive.tangents);
            addDeltas(t, "TEXCOORD_0", TINYGLTF_TYPE_VEC2, kPositionTypes, weight, primitive.uvs[0]);
            addDeltas(t, "TEXCOORD_1", TINYGLTF_TYPE_VEC2, kPositionTypes, weight, primitive.uvs[1]);
            addDeltas(t, "COLOR_0", accessorType(t, "COLOR_0"), kPositionTypes, weight, primitive.colors);
        }
    }

    int accessorType(size_t target, const std::string& name) const {
        const auto found = source_.targets[target].find(name);
        const bool opaque =
            found != source_.targets[target].end() && accessor(found->second).type == TINYGLTF_TYPE_VEC3;
        return opaque ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4;
    }

    /// Adds weight times a target's attribute; a delta may have fewer components (a tangent's sign stays).
    template<typename Vector>
    void addDeltas(size_t target, const std::string& name, int type, const std::vector<int>& componentTypes,
                   float weight, std::vector<Vector>& base) const {
        const auto found = source_.targets[target].find(name);
        if (found == source_.targets[target].end() || base.empty()) {
            return;
        }
        const std::string property = property_ + "." + at("targets", target, name);
        checkUse(document_, found->second, {property, type, componentTypes});
        checkCount(found->second, property);
        if (weight == 0.0f) {
            return;
        }
        const std::vector<float> deltas = readFloats(document_, found->second);
        const size_t components = componentCount(accessor(found->second));
        for (size_t i = 0; i < count_; ++i) {
            for (size_t c = 0; c < components; ++c) {
                base[i][static_cast<int>(c)] += weight * deltas[i * components + c];
            }
        }
    }

    std::vector<uint32_t> readIndices() const {
        if (draco_) {
            return draco_->indices();
        }
        std::vector<uint32_t> indices;
        if (source_.indices < 0) {
            indices.resize(count_);
            std::iota(indices.begin(), indices.end(), 0U);
            return indices;
        }
        checkUse(document_, source_.indices,
                 {property_ + ".indices", TINYGLTF_TYPE_SCALAR, kIndexTypes, Normalized::never});
        indices = readIntegers(document_, source_.indices);
        for (size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] >= count_) {
                refuse(document_.file,
                       property_ + ".indices, " +
                           at(at("accessors", static_cast<size_t>(source_.indices)) + " element ", i),
                       std::to_string(indices[i]), "a vertex below " + std::to_string(count_));
            }
        }
        return indices;
    }

    /// As a triangle list; corners that make no whole triangle are left out.
    std::vector<uint32_t> triangles(std::vector<uint32_t> corners) const {
        // Draco stores triangles whatever the mode says.
        const int mode = draco_ ? TINYGLTF_MODE_TRIANGLES : source_.mode;
        if (mode == TINYGLTF_MODE_TRIANGLES) {
            if (corners.size() % 3 != 0) {
                document_.warn(property_, std::to_string(corners.size()) +
                                              " corners are no multiple of 3; the last ones are left out");
                corners.resize(corners.size() / 3 * 3);
            }
            return corners;
        }
        std::vector<uint32_t> list;
        list.reserve(corners.size() * 3);
        for (size_t i = 0; i + 2 < corners.size(); ++i) {
            if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
                list.insert(list.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
            } else {
                list.insert(list.end(), {corners[i + 1], corners[i + 2], corners[0]});
            }
        }
        return list;
    }

    Document& document_;
    const tinygltf::Primitive& source_;
    std::string property_;
    nlohmann::json dracoIds_ = nlohmann::json::object();
    std::optional<DracoMesh> draco_;
    size_t count_ = 0;
};

}  // namespace

std::vector<uint64_t> geometryBytes(const Document& document, size_t mesh) {
    constexpr uint64_t kVertexBytes = 2 * sizeof(glm::vec3);  // position and normal, which all have
    std::vector<uint64_t> bytes;
    for (const tinygltf::Primitive& primitive : document.model.meshes[mesh].primitives) {
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) {
            continue;
        }
        const auto count = [&](int accessor) {
            return uint64_t{document.model.accessors[static_cast<size_t>(accessor)].count};
        };
        const uint64_t vertices = count(position->second);
        bytes.push_back(vertices * kVertexBytes +
                        (primitive.indices < 0 ? vertices : count(primitive.indices)) * sizeof(uint32_t));
    }
    return bytes;
}

std::optional<SourceMesh> readSourceMesh(Document& document, size_t mesh, size_t primitive,
                                         const std::vector<double>& morphWeights) {
    return Reader(document, mesh, primitive).read(morphWeights);
}

}  // namespace lobe
