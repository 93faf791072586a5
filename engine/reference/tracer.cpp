#include "reference/tracer.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.hpp"
#include "math/ulp.hpp"
#include "reference/surface_reader.hpp"

namespace lobe::reference {
namespace {

constexpr double kRounding = 0x1p-53;  // of one operation in double

float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) <= value
               ? nearest
               : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

float roundedUp(double value) {
    return -roundedDown(-value);
}

/// One ray's search. Embree hands its context back to the callbacks.
struct Query {
    RTCIntersectContext context{};  // first: Embree knows the query by its address
    glm::dvec3 origin{0.0};         ///< relative to the eye
    glm::dvec3 direction{0.0};
    double tMin = 0.0, tMax = 0.0;
    double start = 0.0, length = 1.0;  ///< of the float ray: t = start + its t / length
    const RayDifferentials* differentials = nullptr;
    // For surfaces:
    std::vector<std::pair<Hit, Footprint>> hits;  ///< all blended, and the nearest other, which ends them
    // For visibility:
    uint32_t ownInstance = 0, ownTriangle = 0;
    double transmittance = 1.0;

    /// The float ray's t, not below the true one.
    float floatEnd(double t) const { return roundedUp((t - start) * length); }
};

}  // namespace

struct Tracer::State {
    /// What the callbacks get as a geometry's user pointer.
    struct Part {
        const State* state = nullptr;
        uint32_t instance = 0;
        Mesh mesh;
    };

    std::shared_ptr<const Scene> scene;
    glm::dvec3 eye;
    SurfaceReader reader;
    std::vector<Part> parts;
    glm::dvec3 lower{0.0}, upper{0.0};  ///< of all, relative to the eye, padded
    double padding = 0.0;
    double offset = 0.0;
    RTCDevice device = nullptr;
    RTCScene embree = nullptr;

    State(std::shared_ptr<const Scene> given, const glm::dvec3& eyeAt)
        : scene(std::move(given)), eye(eyeAt), reader(*scene) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        rtcReleaseScene(embree);
        rtcReleaseDevice(device);
    }

    void measure();
    void build();
    void check(const char* what) const;
    bool aim(Query& query, RTCRay& ray) const;

    static void bounds(const RTCBoundsFunctionArguments* arguments);
    static void intersect(const RTCIntersectFunctionNArguments* arguments);
    static void occluded(const RTCOccludedFunctionNArguments* arguments);
};

/// Float copies of a ray differ from it by roundings of its origin, which is inside the scene's bounds once
/// aim() is done, and of its direction, times the way through the bounds: 2^-24 (1 + 2 sqrt(3)) of the
/// largest coordinate on each axis. Boxes that are larger by that hold every point that the exact ray has in
/// them.
void Tracer::State::measure() {
    double magnitude = 0.0;
    bool any = false;
    for (const Part& part : parts) {
        magnitude = std::max(magnitude, part.mesh.magnitude());
        for (const uint32_t vertex : part.mesh.primitive().indices) {
            const glm::dvec3& p = part.mesh.position(vertex);
            lower = any ? glm::min(lower, p) : p;
            upper = any ? glm::max(upper, p) : p;
            any = true;
        }
    }
    const glm::dvec3 reach = glm::max(glm::abs(lower), glm::abs(upper));
    const double radius = std::max({reach.x, reach.y, reach.z});
    // Embree squares and multiplies distances in float.
    if (!(radius < 1e18))
        throw InputError(scene->file + ": a surface is more than 1e18 m from the camera; expected less");
    padding = 6.0 * kFloatRounding * radius;
    lower -= padding;
    upper += padding;
    // Positions are rounded as sums in mesh.cpp (4 roundings), as means of three (4), in world coordinates
    // (1) and back (1); the distance to a neighbour's plane is rounded 8 times. Twice that, as two meet.
    offset = 36.0 * kRounding * magnitude;
}

void Tracer::State::check(const char* what) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw InputError(scene->file + ": " + what + " failed" +
                     (error == RTC_ERROR_OUT_OF_MEMORY ? "; expected more memory to be free" : ""));
}

void Tracer::State::build() {
    device = rtcNewDevice(nullptr);
    check("starting Embree");
    embree = rtcNewScene(device);
    rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
    for (Part& part : parts) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, part.mesh.triangles());
        rtcSetGeometryUserData(geometry, &part);
        rtcSetGeometryBoundsFunction(
            geometry, [](const RTCBoundsFunctionArguments* a) { bounds(a); }, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect);
        rtcSetGeometryOccludedFunction(geometry, occluded);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(embree, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree);
    check("building the tree of triangles");
}

void Tracer::State::bounds(const RTCBoundsFunctionArguments* arguments) {
    const Part& part = *static_cast<const Part*>(arguments->geometryUserPtr);
    const auto [a, b, c] = part.mesh.corners(arguments->primID);
    const glm::dvec3& p = part.mesh.position(a);
    const glm::dvec3& q = part.mesh.position(b);
    const glm::dvec3& r = part.mesh.position(c);
    const glm::dvec3 low = glm::min(p, glm::min(q, r)) - part.state->padding;
    const glm::dvec3 high = glm::max(p, glm::max(q, r)) + part.state->padding;
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = roundedDown(low.x);
    box.lower_y = roundedDown(low.y);
    box.lower_z = roundedDown(low.z);
    box.upper_x = roundedUp(high.x);
    box.upper_y = roundedUp(high.y);
    box.upper_z = roundedUp(high.z);
}

void Tracer::State::intersect(const RTCIntersectFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const Part& part = *static_cast<const Part*>(arguments->geometryUserPtr);
    const SurfaceReader& reader = part.state->reader;
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    std::optional<Hit> hit = part.mesh.intersect(arguments->primID, query.origin, query.direction);
    if (!hit || hit->t < query.tMin || hit->t > query.tMax) return;
    if (!hit->front && reader.oneSided(part.mesh)) return;
    hit->instance = part.instance;
    Footprint footprint;
    if (query.differentials != nullptr)
        footprint = part.mesh.footprint(hit->triangle, query.origin, query.direction, *query.differentials);
    const bool ends = reader.alphaMode(part.mesh) != AlphaMode::blend;
    if (ends && reader.coverage(part.mesh, *hit, footprint) == 0.0) return;
    query.hits.emplace_back(*hit, footprint);
    if (!ends) return;
    query.tMax = hit->t;
    reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray.tfar = query.floatEnd(hit->t);
}

void Tracer::State::occluded(const RTCOccludedFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const Part& part = *static_cast<const Part*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    if (!part.state->scene->instances[part.instance].castsShadow) return;
    if (arguments->primID == query.ownTriangle && part.instance == query.ownInstance) return;
    const std::optional<Hit> hit = part.mesh.intersect(arguments->primID, query.origin, query.direction);
    if (!hit || hit->t < query.tMin || hit->t > query.tMax) return;
    // Embree visits each triangle once: its trees split no primitives of users.
    query.transmittance *= 1.0 - part.state->reader.coverage(part.mesh, *hit, {});
    if (query.transmittance == 0.0)
        reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
}

/// Sets the float ray to the part of the query that is inside the scene's bounds; false if there is none.
bool Tracer::State::aim(Query& query, RTCRay& ray) const {
    query.length = glm::length(query.direction);
    double begin = query.tMin, end = query.tMax;
    for (int i = 0; i < 3; ++i) {
        if (query.direction[i] == 0.0) {
            if (query.origin[i] < lower[i] || query.origin[i] > upper[i]) return false;
            continue;
        }
        const double a = (lower[i] - query.origin[i]) / query.direction[i];
        const double b = (upper[i] - query.origin[i]) / query.direction[i];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    if (!(begin <= end)) return false;
    query.start = begin;
    const glm::dvec3 from = query.origin + begin * query.direction;
    const glm::dvec3 direction = query.direction / query.length;
    ray.org_x = static_cast<float>(from.x);
    ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = 0.0f;
    ray.tfar = query.floatEnd(end);
    ray.mask = ~0u;
    ray.time = 0.0f;
    ray.id = 0;
    ray.flags = 0;
    rtcInitIntersectContext(&query.context);
    return true;
}

Tracer::Tracer(std::shared_ptr<const Scene> scene, const glm::dvec3& eye)
    : state_(std::make_unique<State>(std::move(scene), eye)) {
    const Scene& given = *state_->scene;
    for (uint32_t i = 0; i < given.instances.size(); ++i) {
        const Instance& instance = given.instances[i];
        state_->parts.push_back(
            {state_.get(), i,
             Mesh(instance, given.primitives[static_cast<size_t>(instance.primitive)], eye)});
    }
    state_->measure();
    state_->build();
}

Tracer::~Tracer() = default;

void Tracer::surfacesAlong(const Ray& ray, const RayDifferentials* differentials,
                           std::vector<SurfacePoint>& layers) const {
    layers.clear();
    Query query;
    query.origin = ray.origin - state_->eye;
    query.direction = ray.direction;
    query.tMin = ray.tMin;
    query.tMax = ray.tMax;
    query.differentials = differentials;
    RTCRayHit found{};
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    if (!state_->aim(query, found.ray)) return;
    rtcIntersect1(state_->embree, &query.context, &found);

    const auto place = [](const std::pair<Hit, Footprint>& hit) {
        return std::tuple(hit.first.t, hit.first.instance, hit.first.triangle);
    };
    std::sort(query.hits.begin(), query.hits.end(),
              [&](const auto& a, const auto& b) { return place(a) < place(b); });
    for (const auto& [hit, footprint] : query.hits) {
        const Mesh& mesh = state_->parts[hit.instance].mesh;
        SurfacePoint point = state_->reader.read(mesh, hit, footprint);
        const auto [a, b, c] = mesh.corners(hit.triangle);
        point.position = state_->eye + (hit.weights.x * mesh.position(a) + hit.weights.y * mesh.position(b) +
                                        hit.weights.z * mesh.position(c));
        point.t = hit.t;
        point.distance = hit.t * query.length;
        layers.push_back(std::move(point));
        if (layers.back().alphaMode != AlphaMode::blend) break;
    }
}

double Tracer::visibility(const SurfacePoint& from, const glm::dvec3& direction, double tMax) const {
    Query query;
    query.transmittance = glm::dot(from.geometricNormal, direction) < 0.0 ? 1.0 - from.alpha : 1.0;
    if (query.transmittance == 0.0) return 0.0;
    // The side on which the way starts: what touches the surface there is not in the way by rounding alone.
    const double side = glm::dot(from.geometricNormal, direction) < 0.0 ? -1.0 : 1.0;
    query.origin = (from.position - state_->eye) + (side * state_->offset) * from.geometricNormal;
    query.direction = direction;
    query.tMax = tMax;
    query.ownInstance = from.instance;
    query.ownTriangle = from.triangle;
    RTCRay ray{};
    if (!state_->aim(query, ray)) return query.transmittance;
    rtcOccluded1(state_->embree, &query.context, &ray);
    return query.transmittance;
}

}  // namespace lobe::reference
