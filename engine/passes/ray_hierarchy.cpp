#include "passes/ray_hierarchy.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "passes/ray_pairs.hpp"

namespace lobe {
namespace {

/// Of the boxes, in the hierarchy's coordinates: what rounding moves a vertex that is projected along a ray
/// from within the scene. v - o (|v - o| <= 2) is rounded, its share along the ray is multiplied by a rounded
/// slope, and both are added: 12 roundings of 2^-24.
constexpr float kPadding = 0x1p-20f;

/// A pair where it stands, in the hierarchy's coordinates.
struct Pair {
    std::array<glm::vec3, 4> vertices;
    uint32_t instance;
    TrianglePair indices;
};

struct Box {
    glm::vec3 lower{std::numeric_limits<float>::infinity()}, upper{-std::numeric_limits<float>::infinity()};
    void add(const Box& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    float area() const {
        const glm::vec3 size = upper - lower;
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

Box boxOf(const Pair& pair) {
    Box box;
    for (const glm::vec3& v : pair.vertices)
        box.add({v, v});
    return {box.lower - kPadding, box.upper + kPadding};
}

Box boxOf(const RTCBounds& bounds) {
    return {{bounds.lower_x, bounds.lower_y, bounds.lower_z},
            {bounds.upper_x, bounds.upper_y, bounds.upper_z}};
}

/// Of the tree that Embree builds: a leaf with pairs, or two children.
struct Node {
    Node* children[2] = {nullptr, nullptr};
    Box boxes[2];  ///< of the children
    const uint32_t* pairs = nullptr;
    uint32_t count = 0;
};

void* makeNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
}

void setChildren(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}

void setBoxes(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<Node*>(node)->boxes[i] = boxOf(*bounds[i]);
}

void* makeLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void*) {
    auto* pairs = static_cast<uint32_t*>(rtcThreadLocalAlloc(allocator, count * sizeof(uint32_t), 16));
    for (size_t i = 0; i < count; ++i)
        pairs[i] = primitives[i].primID;
    std::sort(pairs, pairs + count);  // threads may leave them in any order
    Node* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
    leaf->pairs = pairs;
    leaf->count = static_cast<uint32_t>(count);
    return leaf;
}

/// The tree over some pairs, in memory of its own.
class Tree {
public:
    Tree(const std::string& file, const std::vector<Pair>& pairs, const RayHierarchyOptions& options) {
        device_ = rtcNewDevice(nullptr);
        bvh_ = rtcNewBVH(device_);
        std::vector<RTCBuildPrimitive> primitives(pairs.size());
        for (size_t i = 0; i < pairs.size(); ++i) {
            const Box box = boxOf(pairs[i]);
            box_.add(box);
            primitives[i] = {box.lower.x, box.lower.y, box.lower.z, 0,
                             box.upper.x, box.upper.y, box.upper.z, static_cast<uint32_t>(i)};
        }
        RTCBuildArguments arguments = rtcDefaultBuildArguments();
        arguments.maxDepth = 1024;
        arguments.maxLeafSize = static_cast<unsigned>(options.pairsPerLeaf);
        arguments.traversalCost = options.traversalCost;
        arguments.bvh = bvh_;
        arguments.primitives = primitives.data();
        arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
        arguments.createNode = makeNode;
        arguments.setNodeChildren = setChildren;
        arguments.setNodeBounds = setBoxes;
        arguments.createLeaf = makeLeaf;
        root_ = static_cast<const Node*>(rtcBuildBVH(&arguments));
        const RTCError error = rtcGetDeviceError(device_);
        if (root_ == nullptr || error != RTC_ERROR_NONE) {
            release();
            throw InputError(file + ": building the tree of triangles for shadows failed" +
                             (error == RTC_ERROR_OUT_OF_MEMORY ? "; expected more memory to be free" : ""));
        }
    }
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() { release(); }

    const Node& root() const { return *root_; }
    const Box& box() const { return box_; }

private:
    void release() {
        rtcReleaseBVH(bvh_);
        rtcReleaseDevice(device_);
    }
    RTCDevice device_ = nullptr;
    RTCBVH bvh_ = nullptr;
    const Node* root_ = nullptr;
    Box box_;
};

/// Writes a hierarchy's arrays.
class Writer {
public:
    Writer(const Scene& scene, RayHierarchy& result) : scene_(scene), result_(result) {}

    /// The subtree in depth-first order, the larger child first: it is more likely to end a ray.
    void write(const Node& node, const Box& box, const std::vector<Pair>& pairs, bool opaque) {
        const size_t at = result_.nodes.size();
        result_.nodes.resize(at + 8);
        for (int i = 0; i < 3; ++i) {
            result_.nodes[at + static_cast<size_t>(i)] = std::bit_cast<uint32_t>(box.lower[i]);
            result_.nodes[at + 4 + static_cast<size_t>(i)] = std::bit_cast<uint32_t>(box.upper[i]);
        }
        if (node.pairs != nullptr) {
            result_.nodes[at + 3] = ~static_cast<uint32_t>(result_.triangles.size() / 4);
            result_.nodes[at + 7] = node.count;
            for (uint32_t i = 0; i < node.count; ++i)
                write(pairs[node.pairs[i]], opaque);
            return;
        }
        const int larger = node.boxes[1].area() > node.boxes[0].area() ? 1 : 0;
        write(*node.children[larger], node.boxes[larger], pairs, opaque);
        write(*node.children[1 - larger], node.boxes[1 - larger], pairs, opaque);
        result_.nodes[at + 3] = static_cast<uint32_t>(result_.nodes.size() / 8);
    }

private:
    void push(std::initializer_list<float> texel) {
        result_.triangles.insert(result_.triangles.end(), texel);
    }

    void write(const Pair& pair, bool opaque) {
        for (const glm::vec3& v : pair.vertices)
            push({v.x, v.y, v.z});
        if (opaque) return;
        const Primitive& primitive =
            scene_.primitives[static_cast<size_t>(scene_.instances[pair.instance].primitive)];
        const Material& material = scene_.materials[static_cast<size_t>(primitive.material)];
        const TextureSlot& slot = material.baseColorTexture;
        for (const uint32_t vertex : pair.indices) {
            const glm::vec2 uv = coordinate(primitive, slot, vertex);
            push({uv.x, uv.y});
        }
        for (const uint32_t vertex : pair.indices)
            push({material.alpha * (primitive.colors.empty() ? 1.0f : primitive.colors[vertex].a)});
        pushTexture(slot);
        push({material.alphaMode == AlphaMode::mask ? material.alphaCutoff : -1.0f});
    }

    /// With KHR_texture_transform: translation * rotation * scale.
    static glm::vec2 coordinate(const Primitive& primitive, const TextureSlot& slot, uint32_t vertex) {
        if (!slot) return glm::vec2(0.0f);
        const std::vector<glm::vec2>& uvs = primitive.uvs[static_cast<size_t>(slot.uvSet)];
        if (uvs.empty()) return slot.offset;
        const double c = std::cos(static_cast<double>(slot.rotation));
        const double s = std::sin(static_cast<double>(slot.rotation));
        const glm::dvec2 uv = glm::dvec2(slot.scale) * glm::dvec2(uvs[vertex]);
        return {glm::dvec2(slot.offset) + glm::dvec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x)};
    }

    /// Width, height, first texel in two parts that floats hold; wraps and filter. Width 0: alpha 1
    /// everywhere.
    void pushTexture(const TextureSlot& slot) {
        const Texture* texture = slot ? &scene_.textures[static_cast<size_t>(slot.texture)] : nullptr;
        const Bitmap* image = texture != nullptr && texture->image >= 0
                                  ? &scene_.images[static_cast<size_t>(texture->image)]
                                  : nullptr;
        if (image == nullptr || image->channels % 2 != 0) {
            push({0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f});
            return;
        }
        const uint32_t first = firstTexel(texture->image);
        const Sampler& sampler = texture->sampler;
        push({static_cast<float>(image->width), static_cast<float>(image->height),
              static_cast<float>(first / 65536), static_cast<float>(first % 65536),
              static_cast<float>(sampler.wrapS), static_cast<float>(sampler.wrapT),
              sampler.magnify == Filter::linear ? 1.0f : 0.0f});
    }

    uint32_t firstTexel(int index) {
        const auto [found, isNew] = texels_.emplace(index, static_cast<uint32_t>(result_.texels.size()));
        if (!isNew) return found->second;
        const Bitmap& image = scene_.images[static_cast<size_t>(index)];
        const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
        const auto channels = static_cast<size_t>(image.channels);
        for (size_t i = 0; i < count; ++i)
            result_.texels.push_back(alpha(image, i * channels + channels - 1));
        return found->second;
    }

    static float alpha(const Bitmap& image, size_t index) {
        switch (image.type) {
            case ComponentType::u8:
                return static_cast<float>(std::to_integer<unsigned>(image.data[index])) / 255.0f;
            case ComponentType::u16: {
                uint16_t value;
                std::memcpy(&value, image.data.data() + index * 2, 2);
                return static_cast<float>(value) / 65535.0f;
            }
            case ComponentType::f32:
                break;
        }
        float value;
        std::memcpy(&value, image.data.data() + index * 4, 4);
        return value;
    }

    static_assert(static_cast<int>(Wrap::repeat) == 0 && static_cast<int>(Wrap::mirroredRepeat) == 1 &&
                      static_cast<int>(Wrap::clampToEdge) == 2,
                  "as rays.glsl counts them");

    const Scene& scene_;
    RayHierarchy& result_;
    std::map<int, uint32_t> texels_;  ///< first of each image
};

/// Largest coordinate of what an instance's vertices are sums of, but for its place.
double localSize(const Instance& instance, const Primitive& primitive) {
    const glm::dmat3 m(instance.worldFromLocal);
    const glm::dmat3 sizes(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2]));
    glm::vec3 largest(0.0f);
    for (const glm::vec3& position : primitive.positions)
        largest = glm::max(largest, glm::abs(position));
    const glm::dvec3 sum = sizes * glm::dvec3(largest);
    return std::max({sum.x, sum.y, sum.z});
}

Bounds castersBounds(const Scene& scene) {
    Bounds bounds;
    for (const Instance& instance : scene.instances) {
        if (!instance.castsShadow) continue;
        for (const glm::vec3& p : scene.primitives[static_cast<size_t>(instance.primitive)].positions)
            bounds.add(glm::dvec3(instance.worldFromLocal * glm::dvec4(glm::dvec3(p), 1.0)));
    }
    return bounds;
}

/// A sum of 3 products and a place, each rounded once or twice in float, is off by up to 8 roundings of its
/// largest part; that of the hierarchy's vertices, of the point in their frame, and of its distance to the
/// plane of a triangle that spans the scene (12, as for kPadding), by up to 16 of the scene's size.
constexpr double kDrawnRoundings = 8.0, kTracedRoundings = 16.0, kFloatRounding = 0x1p-24;

}  // namespace

RayHierarchy buildRayHierarchy(const Scene& scene, const RayHierarchyOptions& options) {
    RayHierarchy result;
    const Bounds bounds = castersBounds(scene);
    if (bounds.empty) return result;
    result.center = bounds.center();
    const glm::dvec3 half = (bounds.upper - bounds.lower) * 0.5;
    const double size = std::max({half.x, half.y, half.z});
    // Between what keeps 1 / scale and squares of distances from the light normal floats.
    if (size > 0.0) result.scale = std::exp2(-std::clamp(std::ceil(std::log2(size)), -60.0, 60.0));

    std::map<int, std::vector<TrianglePair>> pairsOf;
    std::vector<Pair> opaque, others;
    double drawn = 0.0;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        const Material& material = scene.materials[static_cast<size_t>(primitive.material)];
        drawn = std::max(drawn, localSize(instance, primitive));
        if (!instance.castsShadow) continue;
        auto [pairs, isNew] = pairsOf.try_emplace(instance.primitive);
        if (isNew) pairs->second = pairTriangles(primitive);
        std::vector<glm::vec3> vertices;
        vertices.reserve(primitive.positions.size());
        const glm::dmat3 m(instance.worldFromLocal);
        const glm::dvec3 place = glm::dvec3(instance.worldFromLocal[3]) - result.center;
        for (const glm::vec3& position : primitive.positions)
            vertices.emplace_back((m * glm::dvec3(position) + place) * result.scale);
        std::vector<Pair>& list = material.alphaMode == AlphaMode::opaque ? opaque : others;
        for (const TrianglePair& p : pairs->second)
            list.push_back({{vertices[p[0]], vertices[p[1]], vertices[p[2]], vertices[p[3]]}, i, p});
    }
    result.error = kFloatRounding * (kDrawnRoundings * drawn + kTracedRoundings * size);

    Writer writer(scene, result);
    const auto add = [&](const std::vector<Pair>& pairs, bool isOpaque) {
        if (pairs.empty()) return;
        const Tree tree(scene.file, pairs, options);
        writer.write(tree.root(), tree.box(), pairs, isOpaque);
    };
    add(opaque, true);
    result.opaqueNodes = static_cast<int>(result.nodes.size() / 8);
    add(others, false);
    result.allNodes = static_cast<int>(result.nodes.size() / 8);
    return result;
}

}  // namespace lobe
