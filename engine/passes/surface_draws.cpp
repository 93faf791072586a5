#include "passes/surface_draws.hpp"

#include <algorithm>
#include <cmath>

#include "passes/frustum.hpp"
#include "passes/material_glsl.hpp"
#include "passes/parameters.hpp"

namespace lobe {
namespace {

/// Vertex attribute locations of pass/surface.vert.
enum Attribute : GLuint { kPosition = 0, kNormal = 1, kTangent = 2, kUv0 = 3, kUv1 = 4, kColor = 5 };

struct AttributeArray {
    GLuint location;
    GLint components;
    const void* data;
    size_t bytes;
};

/// Inverse transpose up to a positive factor, also for matrices without inverse (flattened nodes).
glm::dmat3 normalMatrix(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double determinant = glm::dot(m[0], cofactors[0]);
    double largest = 0.0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            largest = std::max(largest, std::abs(cofactors[c][r]));
    const double scale = largest > 0.0 ? (determinant < 0.0 ? -1.0 : 1.0) / largest : 1.0;
    return cofactors * scale;
}

/// Rows of KHR_texture_transform's matrix: translation * rotation * scale.
void setUvTransform(const gl::Program& program, const std::string& name, const TextureSlot& slot) {
    const float c = std::cos(slot.rotation);
    const float s = std::sin(slot.rotation);
    program.set(name + "[0]", glm::vec3(c * slot.scale.x, s * slot.scale.y, slot.offset.x));
    program.set(name + "[1]", glm::vec3(-s * slot.scale.x, c * slot.scale.y, slot.offset.y));
}

}  // namespace

SurfaceDraws::SurfaceDraws(const Scene& scene, const FramePlan& plan, const Capabilities& capabilities,
                           ProgramCache& programs, const BrdfTableBuffer& tables)
    : scene_(scene),
      plan_(plan),
      programs_(programs),
      tables_(tables),
      textures_(scene, plan.quality.textureBits, capabilities) {
    int triangles = 0;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        const SurfaceFeatures features = surfaceFeatures(
            scene.materials[static_cast<size_t>(primitive.material)], primitive, plan.surroundings);
        const auto found = std::find(plan.surfaces.begin(), plan.surfaces.end(), features);
        surfaceOfInstance_.push_back(static_cast<int>(found - plan.surfaces.begin()));
        firstTriangles_.push_back(triangles);
        triangles += static_cast<int>(primitive.triangleCount());
    }
}

const SurfaceDraws::Geometry& SurfaceDraws::geometry(int index) {
    if (const auto found = geometry_.find(index); found != geometry_.end()) return found->second;
    const Primitive& primitive = scene_.primitives[static_cast<size_t>(index)];
    const Material& material = scene_.materials[static_cast<size_t>(primitive.material)];
    const SurfaceFeatures features = surfaceFeatures(material, primitive, plan_.surroundings);
    const bool lit = features.brdf != kUnlit;
    const bool tangents =
        features.texture("normal") != nullptr || (lit && requireBrdf(features.brdf).traits.usesTangent);

    std::vector<AttributeArray> arrays;
    const auto add = [&arrays](GLuint location, GLint components, const auto& values, bool wanted) {
        if (wanted && !values.empty())
            arrays.push_back({location, components, values.data(), values.size() * sizeof(values[0])});
    };
    add(kPosition, 3, primitive.positions, true);
    add(kNormal, 3, primitive.normals, lit);
    add(kTangent, 4, primitive.tangents, tangents);
    add(kUv0, 2, primitive.uvs[0], features.usesUv(0));
    add(kUv1, 2, primitive.uvs[1], features.usesUv(1));
    add(kColor, 4, primitive.colors, features.vertexColors);

    Geometry result{gl::VertexArray::make(), gl::Buffer::make(), gl::Buffer::make(), 0, glm::dvec3(0.0), 0.0};
    glBindVertexArray(result.vertexArray.id());
    size_t total = 0;
    for (const AttributeArray& array : arrays)
        total += array.bytes;
    glBindBuffer(GL_ARRAY_BUFFER, result.vertices.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(total), nullptr, GL_STATIC_DRAW);
    size_t offset = 0;
    for (const AttributeArray& array : arrays) {
        glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(array.bytes),
                        array.data);
        glEnableVertexAttribArray(array.location);
        glVertexAttribPointer(array.location, array.components, GL_FLOAT, GL_FALSE, 0,
                              reinterpret_cast<const void*>(offset));
        offset += array.bytes;
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, result.indices.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(primitive.indices.size() * sizeof(uint32_t)),
                 primitive.indices.data(), GL_STATIC_DRAW);
    result.indexCount = static_cast<GLsizei>(primitive.indices.size());

    Bounds bounds;
    for (const glm::vec3& position : primitive.positions)
        bounds.add(position);
    result.center = bounds.center();
    result.radius = bounds.radius();
    return geometry_.emplace(index, std::move(result)).first->second;
}

const Variant* SurfaceDraws::variantOf(const PlannedPass& pass, int surface) const {
    for (const Variant& variant : pass.variants)
        if (variant.surface == surface) return &variant;
    return nullptr;
}

const gl::Program& SurfaceDraws::program(const PlannedPass& pass, const Variant& variant) {
    const gl::Program*& slot = compiled_[&variant];
    if (slot == nullptr)
        slot =
            &programs_.get("pass/surface.vert", pass.program, variant.defines,
                           surfaceMaterialGlsl(plan_, plan_.surfaces[static_cast<size_t>(variant.surface)]));
    return *slot;
}

void SurfaceDraws::prepare(const PlannedPass& pass) {
    for (const Variant& variant : pass.variants)
        program(pass, variant);
    for (size_t i = 0; i < scene_.instances.size(); ++i)
        if (variantOf(pass, surfaceOfInstance_[i]) != nullptr) geometry(scene_.instances[i].primitive);
}

void SurfaceDraws::useMaterial(const gl::Program& shader, const Variant& variant, int index) {
    const Material& material = scene_.materials[static_cast<size_t>(index)];
    const SurfaceFeatures& features = plan_.surfaces[static_cast<size_t>(variant.surface)];
    std::vector<bool> bound(features.samples.size(), false);
    for (const SurfaceTexture& texture : features.textures) {
        const auto sample = static_cast<size_t>(texture.sample);
        if (bound[sample]) continue;
        bound[sample] = true;
        const TextureSlot& slot = slotOf(material, texture.slot);
        textures_.bind(texture.sample, slot, slotIsSrgb(material, texture.slot));
        shader.set("uSample" + std::to_string(texture.sample), texture.sample);
        if (features.samples[sample].transformed)
            setUvTransform(shader, "uUvRow" + std::to_string(texture.sample), slot);
    }
    shader.set("uMaterial", index);
    shader.set("uAlpha", material.alpha);
    shader.set("uAlphaCutoff", material.alphaCutoff);
    shader.set("uEmission", material.emission);
    shader.set("uNormalScale", material.normalScale);
    shader.set("uOcclusionStrength", material.occlusionStrength);
    if (material.brdf == kUnlit) {
        shader.set("uUnlitColor", glm::vec3(material.metallicRoughness.baseColor));
        return;
    }
    setParameters(shader, requireBrdf(material.brdf), material.values);
}

void SurfaceDraws::draw(const PlannedPass& pass, const View& view, SurfaceOrder order,
                        const std::function<void(const gl::Program&, const Variant&)>& perProgram) {
    const std::vector<glm::dvec4> planes = frustumPlanes(view);
    std::vector<Item> items;
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
        const int surface = surfaceOfInstance_[i];
        if (variantOf(pass, surface) == nullptr) continue;
        const Instance& instance = scene_.instances[i];
        const Geometry& shape = geometry(instance.primitive);
        const BoundingSphere bound =
            movedSphere(instance.worldFromLocal, shape.center, shape.radius, view.eye);
        const glm::dvec3& center = bound.center;
        if (!inView(planes, bound)) continue;
        items.push_back({static_cast<int>(i), surface, glm::dot(center, view.forward)});
    }
    const auto materialOf = [this](const Item& item) {
        return scene_
            .primitives[static_cast<size_t>(scene_.instances[static_cast<size_t>(item.instance)].primitive)]
            .material;
    };
    std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
        if (order == SurfaceOrder::backToFront) return a.depth > b.depth;
        if (order == SurfaceOrder::byScene) return a.instance < b.instance;
        return std::pair(a.surface, materialOf(a)) < std::pair(b.surface, materialOf(b));
    });

    const Variant* current = nullptr;
    const gl::Program* shader = nullptr;
    int material = -1;
    for (const Item& item : items) {
        const Variant* variant = variantOf(pass, item.surface);
        if (variant != current) {
            current = variant;
            material = -1;
            shader = &program(pass, *variant);
            shader->use();
            shader->set("uClipFromRelative", glm::mat4(view.clipFromRelative));
            tables_.bind(*shader);
            perProgram(*shader, *variant);
            if (plan_.masked)
                if (const PlannedBrdf* brdf = plan_.brdf(variant->brdf))
                    glStencilFunc(GL_ALWAYS, brdf->stencil, 0xff);
        }
        if (materialOf(item) != material) {
            material = materialOf(item);
            useMaterial(*shader, *variant, material);
        }
        const Instance& instance = scene_.instances[static_cast<size_t>(item.instance)];
        glm::dmat4 relativeFromLocal = instance.worldFromLocal;
        relativeFromLocal[3] -= glm::dvec4(view.eye, 0.0);
        shader->set("uRelativeFromLocal", glm::mat4(relativeFromLocal));
        shader->set("uFirstTriangle", firstTriangles_[static_cast<size_t>(item.instance)]);
        shader->set("uNormalFromLocal", glm::mat3(normalMatrix(glm::dmat3(relativeFromLocal))));

        const bool mirrored = glm::determinant(glm::dmat3(relativeFromLocal)) < 0.0;
        glFrontFace(mirrored ? GL_CW : GL_CCW);
        if (scene_.materials[static_cast<size_t>(material)].doubleSided)
            glDisable(GL_CULL_FACE);
        else
            glEnable(GL_CULL_FACE);
        const Geometry& shape = geometry(instance.primitive);
        glBindVertexArray(shape.vertexArray.id());
        glDrawElements(GL_TRIANGLES, shape.indexCount, GL_UNSIGNED_INT, nullptr);
    }
}

}  // namespace lobe
