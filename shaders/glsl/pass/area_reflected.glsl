/// area_reflected.glsl - what a surface reflects towards the eye of a whole light with a body, unshadowed and per unit of
/// radiance: the plan sets AREA_ANALYTIC for models that have it in closed form.
///
/// Lambert's part of a model is exact (light/area.glsl), the rest by lobes fitted to it (light/transformed_lobe.glsl):
/// LOBE_COUNT of them, 0 for none, from row LOBE_FIRST of the tables on; LOBE_WEIGHTS(w): the colours' weights of the
/// first half and the second half of them. area_begin() comes first.

/// A light with a body as one fragment sees it.
struct AreaLight {
    vec3 center;    // from the fragment, world axes, m
    vec3 axis;      // unit: along a rect's width, along a tube
    vec3 facing;    // unit: the side of a rect or disk that emits
    float a, b;     // rect: half width, half height; disk, sphere: radius; tube: half length, radius; m
    vec3 radiance;  // with the window of its range
    float slot;     // of its shadow; -1: casts none
#ifdef RECT_IMAGES
    vec4 image;     // of a rect: as light_image_of() takes it
#endif
};

#ifdef AREA_ANALYTIC
#include "light/transformed_lobe.glsl"
#ifdef RECT_IMAGES
#include "light/light_image.glsl"
#endif

vec3 area_local(LightReceiver r, vec3 v) { return frame_to_local(r.frame, v); }

/// What all lights of a fragment share: the model's parts at its angle of view.
struct AreaSurface {
    vec3 lambert;
#if LOBE_COUNT > 0
    LobeFit fit;
#endif
};

AreaSurface area_surface;

void area_begin(LightReceiver r, MODEL_PARAMS p)
{
    AreaWeights weights = model_area(p);
    area_surface.lambert = r.wo.z > 0.0 ? weights.lambert : vec3(0.0);
#if LOBE_COUNT > 0
    area_surface.fit = lobe_fetch(LOBE_FIRST, model_area_width(p), r.wo, LOBE_WEIGHTS(weights));
    area_surface.lambert *= area_surface.fit.base;
    if (!(r.wo.z > 0.0))
        for (int i = 0; i < LOBE_COUNT; ++i)
            area_surface.fit.lobes[i].weight = vec3(0.0);
#endif
}

#ifdef RECT_IMAGES
/// Each part of the reflection times the mean of the picture as that part sees it.
vec3 area_reflected_image(AreaLight light, LightReceiver r)
{
    vec3 facing = area_local(r, light.facing), center = area_local(r, light.center);
    vec3 half_u = area_local(r, light.axis) * light.a, half_v = area_local(r, cross(light.facing, light.axis)) * light.b;
    float scale = 1.0 / max(max(area_largest(center), area_largest(half_u)), max(area_largest(half_v), 1e-30));
    vec3 c = center * scale, u = half_u * scale, v = half_v * scale;
    vec3 heights = vec3(c.z, u.z, v.z);
    LightImage image = light_image_of(light.image);
    vec3 sum = area_surface.lambert * area_rect_factor(center, half_u, half_v, facing);
    if (any(greaterThan(sum, vec3(0.0))))
        sum *= light_image_mean(image, c, u, v, 1.0, heights);
#if LOBE_COUNT > 0
    if (dot(center, facing) < 0.0) {
        LobeFit fit = area_surface.fit;
        LobeSum s = lobe_rect_sum(fit, c, u, v);
        vec3 vc = lobe_to_frame(fit, c), vu = lobe_to_frame(fit, u), vv = lobe_to_frame(fit, v);
        int i = 0;
        do {
            vec3 part = fit.lobes[i].weight * lobe_share(s, fit, i, vc, length(u) + length(v));
            if (any(greaterThan(abs(part), vec3(0.0))))
                part *= light_image_mean(image, lobe_map(fit.lobes[i], vc), lobe_map(fit.lobes[i], vu),
                                         lobe_map(fit.lobes[i], vv), fit.lobes[i].k, heights);
            sum += part;
        } while (++i < LOBE_COUNT);
    }
#endif
    return sum;
}
#endif

vec3 area_reflected_rect(AreaLight light, LightReceiver r)
{
#ifdef RECT_IMAGES
    if (light.image.z > 0.0)
        return area_reflected_image(light, r);
#endif
    vec3 center = area_local(r, light.center), facing = area_local(r, light.facing);
    vec3 half_u = area_local(r, light.axis) * light.a, half_v = area_local(r, cross(light.facing, light.axis)) * light.b;
    vec3 sum = area_surface.lambert * area_rect_factor(center, half_u, half_v, facing);
#if LOBE_COUNT > 0
    vec3 lobes = lobe_rect(area_surface.fit, center, half_u, half_v);
    sum += dot(center, facing) < 0.0 ? lobes : vec3(0.0);
#endif
    return sum;
}

vec3 area_reflected_disk(AreaLight light, LightReceiver r)
{
    vec3 center = area_local(r, light.center), facing = area_local(r, light.facing);
    vec3 sum = area_surface.lambert * area_disk_factor(center, facing, light.a);
#if LOBE_COUNT > 0
    sum += lobe_disk(area_surface.fit, center, facing, light.a);
#endif
    return sum;
}

vec3 area_reflected_sphere(AreaLight light, LightReceiver r)
{
    vec3 center = area_local(r, light.center);
    vec3 sum = area_surface.lambert * area_sphere_factor(center, light.a);
#if LOBE_COUNT > 0
    sum += lobe_sphere(area_surface.fit, center, light.a);
#endif
    return sum;
}

vec3 area_reflected_tube(AreaLight light, LightReceiver r)
{
    vec3 center = area_local(r, light.center), half_axis = area_local(r, light.axis) * light.a;
    vec3 sum = area_surface.lambert * area_tube_factor(center, half_axis, light.b);
#if LOBE_COUNT > 0
    sum += lobe_tube(area_surface.fit, center, half_axis, light.b);
#endif
    return sum;
}

#endif
