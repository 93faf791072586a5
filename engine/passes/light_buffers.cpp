#include "passes/light_buffers.hpp"

#include <algorithm>

#include "shading/punctual.hpp"

namespace lobe {
namespace {

constexpr const char* kNames[] = {"Directional", "Point", "Spot"};

void push(std::vector<float>& data, const glm::dvec3& xyz, double w) {
    for (int i = 0; i < 3; ++i)
        data.push_back(static_cast<float>(xyz[i]));
    data.push_back(static_cast<float>(w));
}

/// `slot`: of the light's shadow; below 0: it casts none.
void pushLight(std::vector<float>& data, const Light& light, const glm::dvec3& eye, double slot,
               bool shadows) {
    const double invRange2 = inverseRange2(light.range);
    switch (light.type) {
        case LightType::directional:
            push(data, -light.direction, slot);
            push(data, light.intensity, 0.0);
            break;
        case LightType::point:
            push(data, light.position - eye, invRange2);
            push(data, light.intensity, slot);
            break;
        case LightType::spot: {
            const SpotScaleOffset cone = spotScaleOffset(light.innerConeAngle, light.outerConeAngle);
            push(data, light.position - eye, invRange2);
            push(data, light.intensity, cone.scale);
            push(data, light.direction, cone.offset);
            if (shadows) push(data, glm::dvec3(0.0), slot);
            break;
        }
        default:
            break;
    }
}

}  // namespace

LightBuffers::LightBuffers(const Scene& scene, const FramePlan& plan) {
    const Bounds bounds = scene.bounds();
    sceneRadius_ = bounds.radius();
    sceneCenter_ = bounds.center();
    clustered_[static_cast<size_t>(LightType::point)] = plan.clusteredPoint;
    clustered_[static_cast<size_t>(LightType::spot)] = plan.clusteredSpot;
    for (const Light& light : scene.lights)
        if (isPunctual(light.type)) lights_[static_cast<size_t>(light.type)].push_back(&light);
    for (size_t type = 0; type < 3; ++type) {
        shadows_[type] = plan.shadowOf(static_cast<LightType>(type)) != PlannedShadow::none;
        auto& list = lights_[type];
        const auto split = clustered_[type] ? std::stable_partition(list.begin(), list.end(),
                                                                    [](const Light* l) { return !l->range; })
                                            : list.end();
        global_[type] = static_cast<int>(split - list.begin());
    }
}

void LightBuffers::update(const View& view) {
    for (size_t type = 0; type < 3; ++type) {
        if (lights_[type].empty()) continue;
        std::vector<float> data;
        int casting = 0;
        for (const Light* light : lights_[type])
            pushLight(data, *light, view.eye, shadows_[type] && light->castsShadow ? casting++ : -1,
                      shadows_[type]);
        buffers_[type] = gl::makeTextureBuffer(GL_RGBA32F, data.data(), data.size() * sizeof(float));
    }
    if (clustered_[1] || clustered_[2]) updateClusters(view);
}

void LightBuffers::updateClusters(const View& view) {
    const double center = glm::dot(sceneCenter_ - view.eye, view.forward);
    const double far = std::max(center + sceneRadius_, 1e-6);
    const double near = std::max(center - sceneRadius_, far * 1e-4);
    const ClusterGrid grid(view, near, far);
    sliceFactors_ = grid.sliceFactors();
    clusterTiles_ = {grid.columns(), grid.rows()};
    std::vector<uint32_t> indices;
    for (size_t type : {size_t{1}, size_t{2}}) {
        if (!clustered_[type]) continue;
        std::vector<LightVolume> volumes;
        for (size_t i = static_cast<size_t>(global_[type]); i < lights_[type].size(); ++i) {
            const Light& light = *lights_[type][i];
            LightVolume volume{light.position - view.eye, *light.range};
            if (light.type == LightType::spot) {
                volume.axis = light.direction;
                volume.coneAngle = light.outerConeAngle;
            }
            volumes.push_back(volume);
        }
        ClusterLists lists = grid.assign(volumes, static_cast<uint32_t>(global_[type]));
        for (size_t i = 0; i < lists.ranges.size(); i += 2)
            lists.ranges[i] += static_cast<uint32_t>(indices.size());
        indices.insert(indices.end(), lists.indices.begin(), lists.indices.end());
        clusters_[type] =
            gl::makeTextureBuffer(GL_RG32UI, lists.ranges.data(), lists.ranges.size() * sizeof(uint32_t));

        tileCounts_[type] = static_cast<int>(lists.tiles.size());
        tiles_[type] = gl::VertexArray::make();
        tileBuffers_[type] = gl::Buffer::make();
        glBindVertexArray(tiles_[type].id());
        glBindBuffer(GL_ARRAY_BUFFER, tileBuffers_[type].id());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lists.tiles.size() * sizeof(glm::vec2)),
                     lists.tiles.data(), GL_STREAM_DRAW);
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        glVertexAttribDivisor(0, 1);
    }
    if (indices.empty()) indices.push_back(0);
    indices_ = gl::makeTextureBuffer(GL_R32UI, indices.data(), indices.size() * sizeof(uint32_t));
}

int LightBuffers::bind(const gl::Program& program, int unit) const {
    const auto attach = [&](const std::string& uniform, const gl::TextureBuffer& buffer) {
        if (!buffer.texture || program.uniform(uniform) < 0) return;
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(GL_TEXTURE_BUFFER, buffer.texture.id());
        program.set(uniform, unit++);
    };
    for (size_t type = 0; type < 3; ++type) {
        const std::string name = kNames[type];
        attach("u" + name + "Lights", buffers_[type]);
        attach("u" + name + "Clusters", clusters_[type]);
        program.set("u" + name + "First", 0);
        program.set("u" + name + "End", global_[type]);
    }
    attach("uClusterIndices", indices_);
    program.set("uClusterZ", sliceFactors_);
    program.set("uClusterTiles", clusterTiles_);
    return unit;
}

}  // namespace lobe
