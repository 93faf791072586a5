#include "passes/shadow_maps.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace lobe {
namespace {

constexpr const char* kNames[] = {"Directional", "Point", "Spot", "Rect", "Disk", "Sphere", "Tube"};
/// Above what surfaces, G-buffer and lights take, whatever the model.
constexpr GLuint kMapUnit = 24, kDepthUnit = 25, kRecordUnit = 26;

/// Texels of a record, as shadow/maps.glsl reads them.
constexpr size_t kMapTexels = 5;

class Records {
public:
    void push(const glm::dvec3& xyz, double w) {
        for (int i = 0; i < 3; ++i)
            values_.push_back(static_cast<float>(xyz[i]));
        values_.push_back(static_cast<float>(std::min(w, 3e38)));
    }
    void pushMap(const PlacedShadowMap& map, const glm::dvec3& eye, double inside) {
        const ShadowProjection& p = map.projection;
        const double half = 0.5 * map.tile.size;
        push(p.origin - eye, p.perspective ? p.reach : 1.0 / p.reach);
        push(p.x * p.texel.x, 1.0 / (p.texel.x * p.texel.x));
        push(p.y * p.texel.y, 1.0 / (p.texel.y * p.texel.y));
        push(p.z, 0.0);
        push({map.tile.x + half, map.tile.y + half, map.tile.layer}, p.empty ? -1.0 : half - inside);
    }
    void pushCube(const PlacedShadowMap& face, const glm::dvec3& eye) {
        const ShadowProjection& p = face.projection;
        const ShadowTile& tile = face.tile;
        const int quarter = 4 * tile.layer + (tile.x > 0 ? 1 : 0) + (tile.y > 0 ? 2 : 0);
        push(p.origin - eye, p.reach);
        push({p.texel.x, 1.0 / p.texel.x, quarter}, tile.size);
    }
    void pad(size_t texels) { values_.resize(values_.size() + 4 * texels, 0.0f); }
    size_t texels() const { return values_.size() / 4; }
    const std::vector<float>& values() const { return values_; }

private:
    std::vector<float> values_;
};

bool isFlat(LightType type) {
    return type == LightType::rect || type == LightType::disk;
}

/// A turn of the taps, 0..1, that differs between the jittered samples of a frame: how far they are moved
/// across a pixel.
double turnOf(const View& view) {
    const glm::dvec3 corner = view.orthographic ? view.rayOrigin : view.rayDirection;
    const glm::dvec3 dx = view.orthographic ? view.rayOriginDx : view.rayDirectionDx;
    const double across = glm::dot(corner, dx) / glm::dot(dx, dx) + 0.5 * view.width + 0.5;
    return across - std::floor(across);
}

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

ShadowMaps::ShadowMaps(const Scene& scene, const FramePlan& plan, const LightBuffers& lights,
                       const BodyLights& bodies)
    : scene_(scene), planned_(plan.shadowMaps), filter_{planned_.filterSide} {
    if (planned_.layers() == 0) return;
    for (size_t i = 0; i < kTypes; ++i) {
        const auto type = static_cast<LightType>(i);
        if (plan.shadowOf(type) != PlannedShadow::maps) continue;
        for (const Light* light : isPunctual(type) ? lights.casting(type) : bodies.casting(type))
            slots_[i].push_back({light, {}, {}, {}});
    }
    makeTexture();
    placeLights();
}

void ShadowMaps::makeTexture() {
    depths_ = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D_ARRAY, depths_.id());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, planned_.size, planned_.size,
                 planned_.layers(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    gl::checkErrors("making shadow maps");
    comparing_ = gl::Sampler::make();
    reading_ = gl::Sampler::make();
    const auto set = [](const gl::Sampler& sampler, GLenum what, GLenum value) {
        glSamplerParameteri(sampler.id(), what, static_cast<GLint>(value));
    };
    for (const gl::Sampler* sampler : {&comparing_, &reading_}) {
        const GLenum filter = sampler == &comparing_ ? GL_LINEAR : GL_NEAREST;
        set(*sampler, GL_TEXTURE_MIN_FILTER, filter);
        set(*sampler, GL_TEXTURE_MAG_FILTER, filter);
        set(*sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        set(*sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    set(comparing_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    set(comparing_, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    framebuffer_ = gl::Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
}

/// Tiles for all lights, and the projections of those that do not depend on the camera.
void ShadowMaps::placeLights() {
    const double radius = scene_.bounds().radius();
    int whole = 0, cube = 0;
    for (auto& slots : slots_)
        for (Slot& slot : slots) {
            const Light& light = *slot.light;
            if (light.type == LightType::directional) {
                directional_.emplace_back(scene_, light.direction);
                slot.maps.push_back({{}, wholeTile(planned_, whole++)});
            } else if (!needsCube(light)) {
                slot.maps.push_back(
                    {fitSpot(light, radius, planned_.size, filter_), wholeTile(planned_, whole++)});
            } else {
                for (int face = 0; face < 6; ++face) {
                    const ShadowTile tile = cubeTile(planned_, cube, face);
                    slot.maps.push_back({cubeFace(light.position, face, radius, tile.size, filter_), tile});
                    if (!isPunctual(light.type))
                        slot.nearest[static_cast<size_t>(face)] =
                            nearestCaster(scene_, slot.maps.back().projection, tile.size,
                                          isFlat(light.type) ? std::optional(light.direction) : std::nullopt);
                }
                ++cube;
            }
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
    turn_ = turnOf(view);
    if (fitted_ && sameFrustum(*fitted_, view)) return changed;
    for (size_t i = 0; i < directional_.size(); ++i)
        fitDirectional(i, view, changed);
    if (!fitted_)
        for (size_t type = 1; type < kTypes; ++type)
            for (const Slot& slot : slots_[type])
                changed.insert(changed.end(), slot.maps.begin(), slot.maps.end());
    fitted_ = view;
    sendRecords(view);
    return changed;
}

void ShadowMaps::sendRecords(const View& view) {
    Records records;
    const double inside = filter_.reach();
    for (size_t i = 0; i < kTypes; ++i) {
        const auto type = static_cast<LightType>(i);
        firstRecord_[i] = static_cast<int>(records.texels());
        for (const Slot& slot : slots_[i]) {
            if (type == LightType::directional) {
                records.push({slot.ends[0], slot.ends[1], slot.ends[2]}, 0.0);
                for (const PlacedShadowMap& map : slot.maps)
                    records.pushMap(map, view.eye, inside);
                records.pad(kMapTexels * (kMostCascades - slot.maps.size()));
            } else if (slot.maps.size() == 1) {
                records.pushMap(slot.maps[0], view.eye, inside);
            } else {
                records.pushCube(slot.maps[0], view.eye);
                if (type == LightType::spot) {  // where a map has its z axis
                    records.pad(1);
                    records.push(glm::dvec3(0.0), 1.0);
                    records.pad(1);
                } else if (!isPunctual(type)) {
                    for (size_t axis = 0; axis < 3; ++axis)
                        records.push({1.0 / slot.nearest[2 * axis], 1.0 / slot.nearest[2 * axis + 1], 0.0},
                                     0.0);
                }
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
    if (program.uniform("uShadowRecords") < 0) return;
    const auto attach = [&](const char* uniform, GLuint unit, GLenum kind, GLuint texture, GLuint sampler) {
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(kind, texture);
        glBindSampler(unit, sampler);
        program.set(uniform, static_cast<int>(unit));
    };
    attach("uShadowMaps", kMapUnit, GL_TEXTURE_2D_ARRAY, depths_.id(), comparing_.id());
    attach("uShadowDepths", kDepthUnit, GL_TEXTURE_2D_ARRAY, depths_.id(), reading_.id());
    attach("uShadowRecords", kRecordUnit, GL_TEXTURE_BUFFER, records_.texture.id(), 0);
    program.set("uShadowTexel", 1.0f / static_cast<float>(planned_.size));
    program.set("uShadowTurn", static_cast<float>(turn_));
    for (size_t type = 0; type < kTypes; ++type)
        program.set("uShadow" + std::string(kNames[type]), firstRecord_[type]);
}

}  // namespace lobe
