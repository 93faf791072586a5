#include "reference/explanation.hpp"

#include "shading/punctual.hpp"

namespace lobe::reference {
namespace {

constexpr int kRounds = 3;

double sumOf(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

/// Light of all sources of `scene` at a point.
Estimate lightAt(const Scene& scene, const EnvironmentMap* environment, const ShadingPoint& point,
                 const Visibility& visible, int rounds) {
    Pcg32 random(1);
    Contributions exact{};
    Estimate sum;
    const DirectLight lights(scene, environment);  // integrals refer to it
    for (const auto& integral : lights.at(point, visible, random, exact)) {
        for (int i = 0; i < rounds; ++i)
            integral->refine();
        sum.mean += integral->estimate().mean;
        sum.variance += integral->estimate().variance;
    }
    for (const glm::dvec3& one : exact)
        sum.mean += one;
    return sum;
}

/// What a light would give a facing surface: W/m^2.
glm::dvec3 facingIrradiance(const Light& light, const glm::dvec3& direction, double distance) {
    if (light.type == LightType::directional) return light.intensity;
    double attenuation = distanceAttenuation(distance * distance, light.range);
    if (light.type == LightType::spot)
        attenuation *= spotAttenuation(-glm::dot(direction, light.direction), light.innerConeAngle,
                                       light.outerConeAngle);
    return light.intensity * attenuation;
}

void describeDirection(const ShadingPoint& point, const Light& light, LightShare& share) {
    glm::dvec3 direction = -light.direction;
    if (light.type != LightType::directional) {
        const glm::dvec3 toLight = light.position - point.position;
        share.distance = glm::length(toLight);
        if (!(share.distance > 0.0)) return;
        direction = toLight / share.distance;
    }
    const glm::dmat3 local = glm::transpose(point.frame);
    const glm::dvec3 wo = local * point.toEye;
    share.wi = local * direction;
    if (isPunctual(light.type)) share.irradiance = facingIrradiance(light, direction, share.distance);
    if (!(share.wi.z > 0.0) || !(wo.z > 0.0)) return;
    const Directions d(share.wi, wo);
    share.brdf = point.brdf->fCos(d, point.values) / share.wi.z;
    if (point.brdf->factors) share.factors = point.brdf->factors(d, point.values);
}

LightShare shareOf(const Scene& single, const EnvironmentMap* environment, const ShadingPoint& point,
                   const Visibility& visible) {
    LightShare share;
    const Estimate shadowed = lightAt(single, environment, point, visible, kRounds);
    const Estimate all = lightAt(
        single, environment, point, [](const glm::dvec3&, double) { return 1.0; }, kRounds);
    share.radiance = shadowed.mean;
    share.error = glm::sqrt(shadowed.variance);
    share.visible = sumOf(all.mean) > 0.0 ? sumOf(shadowed.mean) / sumOf(all.mean) : 0.0;
    return share;
}

}  // namespace

Explanation explain(const PixelIntegrator& integrator, const Scene& scene, int x, int y, const Effort& effort,
                    bool shadows) {
    Explanation result;
    const View& view = integrator.view();
    const Ray ray = pixelRay(view, x + 0.5, view.height - y - 0.5);
    const RayDifferentials differentials = pixelDifferentials(view);
    std::vector<SurfacePoint> points;
    integrator.tracer().surfacesAlong(ray, &differentials, points);
    glm::dvec3 remaining(1.0);
    for (SurfacePoint& point : points) {
        SurfaceShare& surface = result.surfaces.emplace_back();
        surface.point = std::move(point);
        surface.weight = (remaining.x + remaining.y + remaining.z) / 3.0 * surface.point.alpha;
        remaining *= throughOf(surface.point, -glm::normalize(ray.direction));
    }
    for (SurfaceShare& surface : result.surfaces) {
        const SurfacePoint& point = surface.point;
        if (point.brdf == nullptr) continue;
        const ShadingPoint shading{point.position, glm::dmat3(point.tangent, point.bitangent, point.normal),
                                   -glm::normalize(ray.direction), point.brdf, point.values()};
        surface.wo = glm::transpose(shading.frame) * shading.toEye;
        surface.ambient = point.brdf->ambient(point.values()) *
                          scene.ambientRadiance.value_or(glm::dvec3(0.0)) * point.occlusion;
        const Visibility visible = [&](const glm::dvec3& direction, double distance) {
            return shadows ? integrator.tracer().visibility(point, direction, distance) : 1.0;
        };
        Scene single;
        single.images = scene.images;  // that lights show
        for (const Light& light : scene.lights) {
            single.lights = {light};
            LightShare share = shareOf(single, nullptr, shading, visible);
            share.name = light.name;
            share.source = sourceOf(light.type);
            describeDirection(shading, light, share);
            surface.lights.push_back(std::move(share));
        }
        if (integrator.environment() != nullptr) {
            single.lights.clear();
            LightShare share = shareOf(single, integrator.environment(), shading, visible);
            share.name = "environment";
            share.source = Source::environment;
            surface.lights.push_back(std::move(share));
        }
    }
    result.truth = integrator.at(x, y, effort, 1);
    return result;
}

}  // namespace lobe::reference
