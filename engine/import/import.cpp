#include "import/import.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "import/accessors.hpp"
#include "import/animation.hpp"
#include "import/cameras.hpp"
#include "import/light_bodies.hpp"
#include "import/lights.hpp"
#include "import/materials.hpp"
#include "import/normals.hpp"
#include "import/refuse.hpp"
#include "import/skin.hpp"
#include "import/source_mesh.hpp"
#include "import/surroundings.hpp"
#include "import/tangents.hpp"
#include "import/textures.hpp"
#include "scene/brdf_tables.hpp"

namespace lobe {

namespace {

constexpr size_t kMostInstances = size_t{1} << 22;  // a small file can ask for very many by sharing meshes
/// Bytes of geometry, and their multiple of the file's own bytes, beyond which a scene is taken for a bomb.
constexpr uint64_t kGeometryBytes = uint64_t{2} << 30;
constexpr uint64_t kGeometryGrowth = 40;

/// glTF's texture transform: scale, then rotate, then move.
glm::vec2 transformed(const glm::vec2& uv, const TextureSlot& slot) {
    const glm::dvec2 scaled = glm::dvec2(uv) * glm::dvec2(slot.scale);
    const double c = std::cos(double{slot.rotation});
    const double s = std::sin(double{slot.rotation});
    return glm::vec2(glm::dvec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y) +
                     glm::dvec2(slot.offset));
}

class Importer {
public:
    Importer(const std::filesystem::path& file, const LoadOptions& options)
        : options_(options), document_(openDocument(file)) {}

    Imported import() {
        Scene& scene = result_.scene;
        scene.file = document_.file;
        scene.name = std::filesystem::path(document_.file).stem().string();
        materials_ = readMaterials(document_);
        tree_ = readNodeTree(document_);
        pose_ = readRestPose(document_);
        scene.animationDurations = animate(document_, options_.time, pose_);
        world_ = worldPose(document_, tree_, pose_);
        checkGeometry();
        for (const int node : tree_.drawn) {
            addNode(static_cast<size_t>(node));
        }
        addImages();
        scene.cameras = readCameras(document_, tree_, world_);
        warnOfRepairs();
        placeTables(scene.materials);
        scene.contentHash = document_.hash.hex();
        scene.warnings = document_.allWarnings();
        return std::move(result_);
    }

private:
    /// Refuses a scene whose primitives, which may share accessors or have no bytes of their own, unpack to
    /// far more than the file holds, before any is unpacked. The largest is left to the checks of its
    /// accessors.
    void checkGeometry() const {
        uint64_t most = 0;
        for (const std::span<const std::byte> buffer : document_.buffers) {
            most += buffer.size() * kGeometryGrowth;
        }
        most = std::max(most, kGeometryBytes);
        std::set<int> shared;
        uint64_t bytes = 0;
        uint64_t largest = 0;
        for (const int node : tree_.drawn) {
            const tinygltf::Node& source = document_.model.nodes[static_cast<size_t>(node)];
            const bool own = source.skin >= 0 || !pose_[static_cast<size_t>(node)].weights.empty();
            if (source.mesh < 0 || (!own && !shared.insert(source.mesh).second)) {
                continue;
            }
            for (const uint64_t one : geometryBytes(document_, static_cast<size_t>(source.mesh))) {
                bytes += one;
                largest = std::max(largest, one);
            }
            if (bytes - largest > most) {
                refuse(document_.file, at("meshes", static_cast<size_t>(source.mesh)),
                       "brings the scene's geometry to " + std::to_string(bytes >> 20) + " MiB",
                       "at most " + std::to_string(most >> 20) + " MiB in a file of this size");
            }
        }
    }

    void addNode(size_t node) {
        const tinygltf::Node& source = document_.model.nodes[node];
        if (source.mesh < 0) {
            return;
        }
        const auto mesh = static_cast<size_t>(source.mesh);
        const size_t count = document_.model.meshes[mesh].primitives.size();
        checkTargets(mesh);
        std::vector<glm::dmat4> joints;
        if (source.skin >= 0) {
            joints = jointTransforms(document_, static_cast<size_t>(source.skin), world_);
        }
        for (size_t p = 0; p < count; ++p) {
            const int primitive = primitiveOf(node, mesh, p, joints);
            if (primitive < 0) {
                continue;
            }
            if (result_.scene.instances.size() >= kMostInstances) {
                refuse(document_.file, "nodes",
                       "more than " + std::to_string(kMostInstances) + " drawn primitives", "fewer");
            }
            const Primitive& shape = result_.scene.primitives[static_cast<size_t>(primitive)];
            // Light that a pane lets through would not be coloured: it throws no shadow at all.
            const bool casts = castsShadow(document_, node) &&
                               !seesThrough(result_.scene.materials[static_cast<size_t>(shape.material)]);
            // Skinned vertices are in world space already; glTF ignores the node's own transform.
            result_.scene.instances.push_back({primitive,
                                               joints.empty() ? world_.transforms[node] : glm::dmat4(1.0),
                                               source.name.empty() ? at("nodes", node) : source.name, casts});
        }
    }

    void checkTargets(size_t mesh) const {
        const auto& primitives = document_.model.meshes[mesh].primitives;
        for (size_t p = 1; p < primitives.size(); ++p) {
            if (primitives[p].targets.size() != primitives[0].targets.size()) {
                refuse(
                    document_.file, at("meshes", mesh, at("primitives", p)) + ".targets",
                    std::to_string(primitives[p].targets.size()) + " targets",
                    "as many as the mesh's first primitive, " + std::to_string(primitives[0].targets.size()));
            }
        }
    }

    /// The scene's primitive, shared by nodes that show it in the same shape; -1 if it is not drawn.
    int primitiveOf(size_t node, size_t mesh, size_t primitive, const std::vector<glm::dmat4>& joints) {
        const std::vector<double>& own = pose_[node].weights;
        const std::vector<double>& weights = own.empty() ? document_.model.meshes[mesh].weights : own;
        const bool shared = joints.empty() && own.empty();
        const std::pair key{mesh, primitive};
        if (shared) {
            if (const auto known = shared_.find(key); known != shared_.end()) {
                return known->second;
            }
        }
        const int index = addPrimitive(mesh, primitive, weights, joints);
        if (shared) {
            shared_.emplace(key, index);
        }
        return index;
    }

    int addPrimitive(size_t mesh, size_t primitive, const std::vector<double>& weights,
                     const std::vector<glm::dmat4>& joints) {
        std::optional<SourceMesh> source = readSourceMesh(document_, mesh, primitive, weights);
        if (!source) {
            return -1;
        }
        const std::string property = at("meshes", mesh, at("primitives", primitive));
        const tinygltf::Mesh& gltfMesh = document_.model.meshes[mesh];
        if (!joints.empty()) {
            applySkin(*source, joints, document_, property);
        }
        Primitive& result = source->primitive;
        const size_t count = result.positions.size() * 3;
        const size_t bad = firstNonFinite(&result.positions[0].x, count);
        if (bad < count) {
            refuse(document_.file, property + ", vertex " + std::to_string(bad / 3),
                   "its posed place is not finite", "finite weights and joint transforms");
        }
        result.name = gltfMesh.name.empty() ? property : gltfMesh.name;
        result.material = materialOf(gltfMesh.primitives[primitive].material);
        finishNormals(result);
        finishUvs(result, property);
        finishTangents(result);
        result_.scene.primitives.push_back(std::move(result));
        return static_cast<int>(result_.scene.primitives.size()) - 1;
    }

    int materialOf(int gltfMaterial) {
        const auto known = materialIndex_.find(gltfMaterial);
        if (known != materialIndex_.end()) {
            return known->second;
        }
        auto& materials = result_.scene.materials;
        materials.push_back(gltfMaterial < 0 ? defaultMaterial()
                                             : materials_[static_cast<size_t>(gltfMaterial)]);
        materials.back().fileIndex = gltfMaterial;
        const int index = static_cast<int>(materials.size()) - 1;
        materialIndex_.emplace(gltfMaterial, index);
        return index;
    }

    void finishNormals(Primitive& primitive) {
        if (options_.normals == NormalsMode::flat || primitive.normals.empty()) {
            // glTF: without normals the file's tangents are not to be used.
            primitive.tangents.clear();
            if (options_.normals == NormalsMode::smooth) {
                makeSmoothNormals(primitive);
            } else {
                makeFlatNormals(primitive);
            }
        } else {
            repairedNormals_ += repairNormals(primitive);
        }
    }

    /// Texture coordinates that the material needs and the primitive lacks are zero, as if there were one
    /// texel.
    void finishUvs(Primitive& primitive, const std::string& property) {
        Material& material = result_.scene.materials[static_cast<size_t>(primitive.material)];
        for (const TextureSlot* slot : textureSlots(material)) {
            std::vector<glm::vec2>& uvs = primitive.uvs[static_cast<size_t>(slot->uvSet)];
            if (uvs.empty()) {
                uvs.assign(primitive.positions.size(), glm::vec2(0.0f));
                document_.warn(property + ".attributes", "has no TEXCOORD_" + std::to_string(slot->uvSet) +
                                                             ", which its material uses; taken as 0, 0");
            }
        }
    }

    void finishTangents(Primitive& primitive) {
        const Material& material = result_.scene.materials[static_cast<size_t>(primitive.material)];
        const Brdf* brdf = findBrdf(material.brdf);
        if (!material.normalTexture && (brdf == nullptr || !brdf->traits.usesTangent)) {
            primitive.tangents.clear();
            return;
        }
        if (!primitive.tangents.empty()) {
            repairedTangents_ += repairTangents(primitive);
            return;
        }
        const std::vector<glm::vec2>& own = primitive.uvs[static_cast<size_t>(material.normalTexture.uvSet)];
        std::vector<glm::vec2> uvs =
            own.empty() ? std::vector(primitive.positions.size(), glm::vec2(0.0f)) : own;
        if (material.normalTexture.transformed()) {
            std::transform(uvs.begin(), uvs.end(), uvs.begin(),
                           [&](const glm::vec2& uv) { return transformed(uv, material.normalTexture); });
        }
        makeTangents(primitive, uvs);
    }

    void addLights(TextureTable& table) {
        std::map<std::string, int> images;  // by URI: lights may share one
        for (PlacedLight& placed : readLights(document_, tree_, world_)) {
            if (placed.image) {
                const auto [known, added] = images.emplace(placed.image->uri, -1);
                if (added) {
                    known->second = table.addFile(placed.image->uri, placed.image->property);
                }
                placed.light.image = known->second;
            }
            if (placed.visible) {
                const bool image = placed.light.image >= 0;
                addBody(result_.scene, placed.light, image ? table.addTexture(placed.light.image) : -1);
            }
            result_.scene.lights.push_back(std::move(placed.light));
        }
    }

    /// Materials have indices into the file's textures until here; only those that are drawn are read. Lights
    /// come here, as images belong to them.
    void addImages() {
        TextureTable table(document_);
        for (Material& material : result_.scene.materials) {
            for (TextureSlot* slot : textureSlots(material)) {
                slot->texture = table.use(slot->texture);
            }
        }
        addLights(table);
        readSurroundings(document_, table,
                         result_.scene);  // last, as faces of an environment are taken off again
        result_.scene.textures = std::move(table.textures);
        for (const EncodedImage& image : table.images) {
            result_.scene.imageNames.push_back(image.name);
        }
        result_.images = std::move(table.images);
    }

    void warnOfRepairs() {
        if (repairedNormals_ > 0) {
            document_.warn("meshes",
                           std::to_string(repairedNormals_) +
                               " normals are zero or not finite; replaced by those of the facets around");
        }
        if (repairedTangents_ > 0) {
            document_.warn("meshes",
                           std::to_string(repairedTangents_) +
                               " tangents are zero, not finite or parallel to the normal; replaced");
        }
        if (result_.scene.instances.empty()) {
            document_.warn("scene", "has nothing to draw");
        }
    }

    LoadOptions options_;
    Document document_;
    Imported result_;
    std::vector<Material> materials_;
    NodeTree tree_;
    std::vector<NodePose> pose_;
    WorldPose world_;
    std::map<int, int> materialIndex_;
    std::map<std::pair<size_t, size_t>, int> shared_;
    size_t repairedNormals_ = 0;
    size_t repairedTangents_ = 0;
};

}  // namespace

Imported importGltf(const std::filesystem::path& file, const LoadOptions& options) {
    return Importer(file, options).import();
}

}  // namespace lobe
