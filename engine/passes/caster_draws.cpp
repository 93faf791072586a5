// What casts shadows, as depth alone: one program for all that is opaque, and one a combination of masks.
#include <algorithm>

#include "passes/frustum.hpp"
#include "passes/material_glsl.hpp"
#include "passes/surface_draws.hpp"

namespace lobe {
namespace {

bool isMasked(const Variant& variant) {
    return variant.defines.contains("ALPHA_MASK");
}

}  // namespace

const gl::Program& SurfaceDraws::casterProgram(const PlannedPass& pass, const Variant& variant) {
    const gl::Program*& slot = compiled_[&variant];
    if (slot == nullptr)
        slot = &programs_.get(
            "shadow/map.vert", pass.program, variant.defines,
            isMasked(variant) ? coverageGlsl(plan_.surfaces[static_cast<size_t>(variant.surface)]) : "");
    return *slot;
}

void SurfaceDraws::prepareCasters(const PlannedPass& pass) {
    for (const Variant& variant : pass.variants)
        casterProgram(pass, variant);
    for (size_t i = 0; i < scene_.instances.size(); ++i)
        if (scene_.instances[i].castsShadow && variantOf(pass, surfaceOfInstance_[i]) != nullptr)
            geometry(scene_.instances[i].primitive);
}

void SurfaceDraws::drawCasters(const PlannedPass& pass, const View& view,
                               const std::function<void(const gl::Program&)>& perProgram) {
    // Maps reach to the end of the scene: their last plane, the far one, keeps nothing out, and is another
    // without clip control.
    std::vector<glm::dvec4> planes = frustumPlanes(view);
    planes.pop_back();
    std::vector<std::pair<const Variant*, const Instance*>> items;
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
        const Instance& instance = scene_.instances[i];
        const Variant* variant = variantOf(pass, surfaceOfInstance_[i]);
        if (variant == nullptr || !instance.castsShadow) continue;
        const Geometry& shape = geometry(instance.primitive);
        if (inView(planes, movedSphere(instance.worldFromLocal, shape.center, shape.radius, view.eye)))
            items.emplace_back(variant, &instance);
    }
    std::stable_sort(items.begin(), items.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });

    glDisable(GL_CULL_FACE);
    const gl::Program* current = nullptr;
    int material = -1;
    for (const auto& [variant, instance] : items) {
        const gl::Program& shader = casterProgram(pass, *variant);
        if (&shader != current) {
            current = &shader;
            material = -1;
            shader.use();
            shader.set("uClipFromRelative", glm::mat4(view.clipFromRelative));
            perProgram(shader);
        }
        const int own = scene_.primitives[static_cast<size_t>(instance->primitive)].material;
        if (isMasked(*variant) && own != material) useMaterial(shader, *variant, material = own);
        glm::dmat4 relativeFromLocal = instance->worldFromLocal;
        relativeFromLocal[3] -= glm::dvec4(view.eye, 0.0);
        shader.set("uRelativeFromLocal", glm::mat4(relativeFromLocal));
        const Geometry& shape = geometry(instance->primitive);
        glBindVertexArray(shape.vertexArray.id());
        glDrawElements(GL_TRIANGLES, shape.indexCount, GL_UNSIGNED_INT, nullptr);
    }
}

}  // namespace lobe
