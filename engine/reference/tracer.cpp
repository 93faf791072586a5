#include "reference/tracer.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/error.hpp"

namespace lobe::reference {
namespace {

glm::vec3 floats(const glm::dvec3& v) {
    return {v};
}

/// What the filters of one query need; Embree hands the context back to them.
struct Query : RTCIntersectContext {
    const Surfaces* surfaces = nullptr;
    const PixelRay* pixel = nullptr;  ///< primary rays
    const Ray* shadow = nullptr;      ///< shadow rays
    const std::vector<Facet>* passed = nullptr;
    double transmittance = 1.0;

    Query() { rtcInitIntersectContext(this); }
};

/// Primary rays: what the renderer would not draw, or has been seen before, is not there.
void filterPrimary(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const Query& query = *static_cast<const Query*>(arguments->context);
    const Facet facet{RTCHitN_geomID(arguments->hit, 1, 0), RTCHitN_primID(arguments->hit, 1, 0)};
    const Surfaces& surfaces = *query.surfaces;
    const bool seen = std::find(query.passed->begin(), query.passed->end(), facet) != query.passed->end();
    const bool culled =
        !surfaces.doubleSided(facet.instance) && !surfaces.frontSeen(facet, query.pixel->direction);
    if (seen || culled ||
        (surfaces.alphaMode(facet.instance) == AlphaMode::mask &&
         surfaces.coverage(facet, *query.pixel) == 0.0))
        arguments->valid[0] = 0;
}

/// Shadow rays: what is not opaque takes its share and lets the ray go on.
void filterShadow(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    Query& query = *static_cast<Query*>(arguments->context);
    const Facet facet{RTCHitN_geomID(arguments->hit, 1, 0), RTCHitN_primID(arguments->hit, 1, 0)};
    query.transmittance *= 1.0 - query.surfaces->coverage(facet, *query.shadow);
    if (query.transmittance > 0.0) arguments->valid[0] = 0;
}

}  // namespace

struct Tracer::Device {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    ~Device() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    void check(const char* what) const {
        if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
            throw InputError(std::string("Embree can't ") + what + " (error " + std::to_string(error) +
                             (error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory)" : ")"));
    }
};

Tracer::Tracer(const Scene& scene, const glm::dvec3& eye)
    : surfaces_(scene), eye_(eye), device_(std::make_unique<Device>()) {
    device_->check("start");
    rtcSetSceneFlags(device_->scene, RTC_SCENE_FLAG_ROBUST);
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        RTCGeometry geometry = rtcNewGeometry(device_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* positions = static_cast<glm::vec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                    primitive.positions.size()));
        auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                       RTC_FORMAT_UINT3, 3 * sizeof(uint32_t),
                                                                       primitive.triangleCount()));
        device_->check("hold the scene");
        for (size_t v = 0; v < primitive.positions.size(); ++v)
            positions[v] =
                floats(glm::dvec3(instance.worldFromLocal * glm::dvec4(primitive.positions[v], 1.0)) - eye);
        std::copy(primitive.indices.begin(), primitive.indices.end(), corners);
        rtcSetGeometryIntersectFilterFunction(geometry, filterPrimary);
        if (surfaces_.alphaMode(static_cast<unsigned>(i)) != AlphaMode::opaque)
            rtcSetGeometryOccludedFilterFunction(geometry, filterShadow);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(device_->scene, geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(device_->scene);
    device_->check("build its hierarchy");
}

Tracer::~Tracer() = default;

std::vector<SurfacePoint> Tracer::surfacesAlong(const PixelRay& ray, double near, double far) const {
    std::vector<SurfacePoint> layers;
    std::vector<Facet> passed;
    const glm::vec3 origin = floats(ray.origin - eye_), direction = floats(ray.direction);
    double start = near;
    for (;;) {
        Query query;
        query.surfaces = &surfaces_;
        query.pixel = &ray;
        query.passed = &passed;
        RTCRayHit hit{};
        hit.ray = {origin.x,
                   origin.y,
                   origin.z,
                   static_cast<float>(start),
                   direction.x,
                   direction.y,
                   direction.z,
                   0.0F,
                   static_cast<float>(std::min(far, double{FLT_MAX})),
                   0xFFFFFFFFU,
                   0,
                   0};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(device_->scene, &query, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return layers;
        const Facet facet{hit.hit.geomID, hit.hit.primID};
        SurfacePoint point = surfaces_.at(facet, ray);
        const bool opaque = point.alpha >= 1.0;
        if (point.alpha > 0.0) layers.push_back(std::move(point));
        if (opaque) return layers;
        passed.push_back(facet);
        // A little back, as surfaces may share a place: those that were passed are told apart by name.
        start = std::max(near, double{hit.ray.tfar} * (1.0 - 4.0 * double{FLT_EPSILON}));
    }
}

double Tracer::visibility(const SurfacePoint& from, const glm::dvec3& direction, double distance) const {
    const double facing = glm::dot(from.geometricNormal, direction);
    if (!(facing > 0.0)) return 0.0;  // the surface itself is in the way
    // The triangle's corners, the point and the ray are each off by half an ulp of their coordinates, and
    // Embree's own arithmetic adds as much again: 8 ulp cover them.
    const double off = 8.0 * double{FLT_EPSILON} * (glm::length(from.position - eye_) + from.extent);
    const glm::dvec3 start = from.position + off * from.geometricNormal;
    const Ray ray{start, direction};
    const glm::vec3 origin = floats(start - eye_), along = floats(direction);
    Query query;
    query.surfaces = &surfaces_;
    query.shadow = &ray;
    RTCRay shadow{origin.x,
                  origin.y,
                  origin.z,
                  0.0F,
                  along.x,
                  along.y,
                  along.z,
                  0.0F,
                  static_cast<float>(
                      std::min(std::max(0.0, distance * (1.0 - 4.0 * double{FLT_EPSILON})), double{FLT_MAX})),
                  0xFFFFFFFFU,
                  0,
                  0};
    rtcOccluded1(device_->scene, &query, &shadow);
    return shadow.tfar < 0.0F ? 0.0 : query.transmittance;
}

}  // namespace lobe::reference
