#include "passes/shadow_maps.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace lobe {
namespace {

constexpr const char* kNames[] = {"Directional", "Point", "Spot"};
/// Above what surfaces, G-buffer and lights take, whatever the model.
constexpr GLuint kDepthUnit = 24, kRecordUnit = 25;

/// Texels of a record, as shadow/maps.glsl reads them.
constexpr size_t kMapTexels = 5;

class Records {
public:
    void push(const glm::dvec3& xyz, double w) {
        for (int i = 0; i < 3; ++i)
            values_.push_back(static_cast<float>(xyz[i]));
        values_.push_back(static_cast<float>(std::min(w, 3e38)));
    }
    void pushMap(const PlacedShadowMap& map, const glm::dvec3& eye, double inside, bool cube) {
        const ShadowProjection& p = map.projection;
        const double half = 0.5 * map.tile.size;
        push(p.origin - eye, p.perspective ? p.reach : 1.0 / p.reach);
        push(p.x * p.texel.x, 1.0 / (p.texel.x * p.texel.x));
        push(p.y * p.texel.y, 1.0 / (p.texel.y * p.texel.y));
        push(p.z, cube ? 1.0 : 0.0);
        push({map.tile.x + half, map.tile.y + half, map.tile.layer}, p.empty ? -1.0 : half - inside);
    }
    void pushCube(const PlacedShadowMap& face, int firstTile, const glm::dvec3& eye) {
        const ShadowProjection& p = face.projection;
        push(p.origin - eye, p.reach);
        push({p.texel.x, 1.0 / p.texel.x, firstTile}, face.tile.size);
    }
    void pad(size_t texels) { values_.resize(values_.size() + 4 * texels, 0.0f); }
    size_t texels() const { return values_.size() / 4; }
    const std::vector<float>& values() const { return values_; }

private:
    std::vector<float> values_;
};

bool sameFrustum(const View& a, const View& b) {
    return a.eye == b.eye && a.forward == b.forward && a.orthographic == b.orthographic &&
           a.width == b.width && a.height == b.height && a.depthToZ == b.depthToZ &&
           a.rayOriginDx == b.rayOriginDx && a.rayOriginDy == b.rayOriginDy &&
           a.rayDirectionDx == b.rayDirectionDx && a.rayDirectionDy == b.rayDirectionDy;
}

bool same(const ShadowProjection& a, const ShadowProjection& b) {
    return a.empty == b.empty && a.origin == b.origin && a.x == b.x && a.y == b.y && a.z == b.z &&
           a.texel == b.texel && a.reach == b.reach;
}

bool same(const ShadowTile& a, const ShadowTile& b) {
    return a.layer == b.layer && a.x == b.x && a.y == b.y && a.size == b.size;
}

}  // namespace

ShadowMaps::ShadowMaps(const Scene& scene, const FramePlan& plan, const LightBuffers& lights)
    : scene_(scene), planned_(plan.shadowMaps), filter_{planned_.filterSide} {
    if (planned_.layers() == 0) return;
    for (size_t type = 0; type < 3; ++type)
        if (plan.shadowOf(static_cast<LightType>(type)) == PlannedShadow::maps)
            for (const Light* light : lights.casting(static_cast<LightType>(type)))
                slots_[type].push_back({light, {}, {}});

    depths_ = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D_ARRAY, depths_.id());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, planned_.size, planned_.size,
                 planned_.layers(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    gl::checkErrors("making shadow maps");
    comparing_ = gl::Sampler::make();
    const auto set = [this](GLenum what, GLenum value) {
        glSamplerParameteri(comparing_.id(), what, static_cast<GLint>(value));
    };
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    set(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    set(GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    framebuffer_ = gl::Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    placeLights(lights);
}

/// Tiles for all lights, and the projections of those that do not depend on the camera.
void ShadowMaps::placeLights(const LightBuffers&) {
    const double radius = scene_.bounds().radius();
    int whole = 0, cube = 0;
    for (Slot& slot : slots_[static_cast<size_t>(LightType::directional)]) {
        directional_.emplace_back(scene_, slot.light->direction);
        slot.maps.push_back({{}, wholeTile(planned_, whole++)});
    }
    for (const LightType type : {LightType::spot, LightType::point})
        for (Slot& slot : slots_[static_cast<size_t>(type)]) {
            const Light& light = *slot.light;
            if (!needsCube(light)) {
                slot.maps.push_back(
                    {fitSpot(light, radius, planned_.size, filter_), wholeTile(planned_, whole++)});
                continue;
            }
            for (int face = 0; face < 6; ++face) {
                const ShadowTile tile = cubeTile(planned_, cube, face);
                slot.maps.push_back({cubeFace(light.position, face, radius, tile.size, filter_), tile});
            }
            ++cube;
        }
}

void ShadowMaps::fitDirectional(size_t index, const View& view, std::vector<PlacedShadowMap>& changed) {
    Slot& slot = slots_[static_cast<size_t>(LightType::directional)][index];
    const ShadowTile whole = wholeTile(planned_, slot.maps[0].tile.layer);
    const DirectionalMaps fit = directional_[index].fit(view, planned_.size, filter_);
    std::vector<PlacedShadowMap> maps;
    for (size_t i = 0; i < fit.maps.size(); ++i)
        maps.push_back({fit.maps[i], fit.maps.size() == 1 ? whole : quarterOf(whole, static_cast<int>(i))});
    slot.ends = fit.ends;
    for (size_t i = 0; i < maps.size(); ++i)
        if (!fitted_ || i >= slot.maps.size() || !same(maps[i].projection, slot.maps[i].projection) ||
            !same(maps[i].tile, slot.maps[i].tile))
            changed.push_back(maps[i]);
    slot.maps = std::move(maps);
}

std::vector<PlacedShadowMap> ShadowMaps::update(const View& view) {
    std::vector<PlacedShadowMap> changed;
    if (fitted_ && sameFrustum(*fitted_, view)) return changed;
    for (size_t i = 0; i < directional_.size(); ++i)
        fitDirectional(i, view, changed);
    if (!fitted_)
        for (const LightType type : {LightType::spot, LightType::point})
            for (const Slot& slot : slots_[static_cast<size_t>(type)])
                changed.insert(changed.end(), slot.maps.begin(), slot.maps.end());
    fitted_ = view;
    sendRecords(view);
    return changed;
}

void ShadowMaps::sendRecords(const View& view) {
    Records records;
    const double inside = filter_.reach();
    for (size_t type = 0; type < 3; ++type) {
        firstRecord_[type] = static_cast<int>(records.texels());
        for (const Slot& slot : slots_[type]) {
            if (type == static_cast<size_t>(LightType::directional)) {
                records.push({slot.ends[0], slot.ends[1], slot.ends[2]}, 0.0);
                for (const PlacedShadowMap& map : slot.maps)
                    records.pushMap(map, view.eye, inside, false);
                records.pad(kMapTexels * (kMostCascades - slot.maps.size()));
                continue;
            }
            const ShadowTile& tile = slot.maps[0].tile;
            const int quarter = 4 * tile.layer + (tile.x > 0 ? 1 : 0) + (tile.y > 0 ? 2 : 0);
            if (type == static_cast<size_t>(LightType::point)) {
                records.pushCube(slot.maps[0], quarter, view.eye);
            } else if (slot.maps.size() == 1) {
                records.pushMap(slot.maps[0], view.eye, inside, false);
            } else {
                records.pushCube(slot.maps[0], quarter, view.eye);
                records.pad(1);
                records.push(glm::dvec3(0.0), 1.0);
                records.pad(1);
            }
        }
    }
    records_ =
        gl::makeTextureBuffer(GL_RGBA32F, records.values().data(), records.values().size() * sizeof(float));
}

void ShadowMaps::bindForDrawing(int layer) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depths_.id(), 0, layer);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw ContextError("the driver refuses to draw into layer " + std::to_string(layer) +
                           " of the shadow maps");
}

void ShadowMaps::bind(const gl::Program& program) const {
    if (program.uniform("uShadowMaps") < 0) return;
    glActiveTexture(GL_TEXTURE0 + kDepthUnit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, depths_.id());
    glBindSampler(kDepthUnit, comparing_.id());
    program.set("uShadowMaps", static_cast<int>(kDepthUnit));
    glActiveTexture(GL_TEXTURE0 + kRecordUnit);
    glBindTexture(GL_TEXTURE_BUFFER, records_.texture.id());
    program.set("uShadowRecords", static_cast<int>(kRecordUnit));
    program.set("uShadowTexel", 1.0f / static_cast<float>(planned_.size));
    for (size_t type = 0; type < 3; ++type)
        program.set("uShadow" + std::string(kNames[type]), firstRecord_[type]);
}

}  // namespace lobe
