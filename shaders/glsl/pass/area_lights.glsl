/// area_lights.glsl - sums the lights with a body of each type at a point.
///
/// AREA_ANALYTIC: the whole light in closed form (pass/area_reflected.glsl). AREA_SAMPLED: points on it, each with the
/// model's value and, with AREA_SHADOWS, a ray of its own. Both: the closed form, times the share of the points' light
/// that arrives, so that only penumbrae are noisy; none of it where no point lights the surface. AREA_HARD_SHADOWS: one
/// ray to the centre. AREA_MAP_SHADOWS: by a shadow map about the centre, as soft as of a sphere that is as large seen
/// from the front; with AREA_POINT_SHADOWS as of a point. MIRRORED_LIGHTS: what an ideal mirror shows of them.
/// RECT_IMAGES: rects may show a picture (light/light_image.glsl).
///
/// Points: those of common/pixel_lattice.glsl, shifted from pixel to pixel and from light to light by a hash, and folded
/// like a tent where what is integrated has ends (Hickernell, MCQMC 2000): smooth integrands then converge with the square of the number of points. Jittered frames go on where the last
/// one stopped, so that they add up to more points.
#include "common/pixel_lattice.glsl"
#include "light/area_sample.glsl"
#include "pass/area_reflected.glsl"

// position, 1/range^2; radiance, shadow's slot; axis, a; facing, b
const int AREA_TEXELS = 4;
// Of rects: the same, and with RECT_IMAGES the image's place in the atlas.
#ifdef RECT_IMAGES
#include "light/light_image.glsl"
const int AREA_RECT_TEXELS = 5;
#else
const int AREA_RECT_TEXELS = 4;
#endif

// Types by number. Functions that ask for one are called with a constant, so that compilers keep that type's part alone;
// defines leave out what a scene has none of where they are called.
const int AREA_RECT = 0, AREA_DISK = 1, AREA_SPHERE = 2, AREA_TUBE = 3;

AreaLight area_light(int type, samplerBuffer lights, int i, LightReceiver r)
{
    int first = (type == AREA_RECT ? AREA_RECT_TEXELS : AREA_TEXELS) * i;
    vec4 position = texelFetch(lights, first);
    vec4 radiance = texelFetch(lights, first + 1);
    vec4 axis = texelFetch(lights, first + 2);
    vec4 facing = texelFetch(lights, first + 3);
    AreaLight light;
#ifdef RECT_IMAGES
    light.image = type == AREA_RECT ? texelFetch(lights, first + 4) : vec4(0.0);
#endif
    light.center = position.xyz - r.position;
    light.axis = axis.xyz;
    light.facing = facing.xyz;
    light.a = axis.w;
    light.b = facing.w;
    light.radiance = radiance.xyz * punctual_window(min(dot(light.center, light.center), 3e38), position.w);
    light.slot = radiance.w;
    return light;
}

#ifdef AREA_HARD_SHADOWS
/// Whether the centre of the light is seen.
float area_center_visible(AreaLight light, LightReceiver r)
{
    float d = length(light.center);
    return light_visibility_by_ray(light.slot, r, light.center / max(d, 1e-30), d);
}
#endif

#ifdef AREA_MAP_SHADOWS
/// `area`: of the light from the front, m^2.
float area_map_visible_of(int first, AreaLight light, LightReceiver r, float area)
{
#ifdef AREA_POINT_SHADOWS
    area = 0.0;
#endif
    return shadow_maps_soft(first, light.slot, r, sqrt(area / PI));
}
#endif

#ifdef AREA_SAMPLED
uniform int uAreaPointsFirst, uAreaPointsEnd, uAreaPointsAll;  // this draw's points, and the number of all
uniform int uAreaStart;                                        // points that earlier frames took

/// Where a light's points of one pixel start.
uvec2 area_shift(int light, int type) { return lattice_hash(uvec3(uvec2(gl_FragCoord.xy), uint(light * 4 + type))); }

vec2 area_point(uvec2 shift, int i) { return lattice_point(shift, uAreaStart + i); }

vec2 area_folded(vec2 u) { return 1.0 - abs(2.0 * u - 1.0); }
/// Of a square whose second side is an angle.
vec2 area_folded_polar(vec2 u) { return vec2(1.0 - abs(2.0 * u.x - 1.0), u.y); }

/// Sums over points: what all of them would reflect, and what arrives of it.
struct AreaTally { vec3 lit, seen; };

/// `f`: what a point reflects.
void area_count(inout AreaTally tally, vec3 f, AreaSample s, AreaLight light, LightReceiver r)
{
#ifdef AREA_ANALYTIC
    tally.lit += f;
#endif
#ifdef AREA_SHADOWS
    f *= light_visibility_by_ray(light.slot, r, s.direction, s.solid_angle > 0.0 ? s.distance : 0.0);
#endif
    tally.seen += f;
}

/// What arrives of `whole`, which all points together reflect.
vec3 area_arriving(AreaTally tally, vec3 whole)
{
    vec3 share = tally.seen / max(tally.lit, vec3(1e-37));
    return whole * mix(share, vec3(0.0), lessThanEqual(tally.lit, vec3(0.0)));
}
#endif

#ifdef RECT_LIGHTS
uniform samplerBuffer uRectLights;
uniform int uRectFirst, uRectEnd;
#endif
#ifdef DISK_LIGHTS
uniform samplerBuffer uDiskLights;
uniform int uDiskFirst, uDiskEnd;
#endif
#ifdef SPHERE_LIGHTS
uniform samplerBuffer uSphereLights;
uniform int uSphereFirst, uSphereEnd;
#endif
#ifdef TUBE_LIGHTS
uniform samplerBuffer uTubeLights;
uniform int uTubeFirst, uTubeEnd;
#endif
#ifdef AREA_MAP_SHADOWS
uniform int uShadowRect, uShadowDisk, uShadowSphere, uShadowTube;  // first record of the type's maps
#endif

#ifdef MIRRORED_LIGHTS
#include "light/area_ray.glsl"

/// The nearest light with a body on a ray so far.
struct AreaNearest { float distance; vec3 radiance; float slot; int type; };

/// Distance at which a ray meets the light.
float area_ray(int type, AreaLight l, vec3 direction)
{
    if (type == AREA_RECT)
        return area_rect_ray(l.center, l.facing, l.axis, l.a, l.b, direction);
    if (type == AREA_DISK)
        return area_disk_ray(l.center, l.facing, l.a, direction);
    if (type == AREA_SPHERE)
        return area_sphere_ray(l.center, l.a, direction);
    return area_tube_ray(l.center, l.axis * l.a, l.b, direction);
}

void area_offer(inout AreaNearest nearest, int type, samplerBuffer lights, int first, int end, LightReceiver r,
                vec3 direction)
{
    int i = first;
    do {
        AreaLight light = area_light(type, lights, i, r);
        float distance = area_ray(type, light, direction);
        if (distance < nearest.distance) {
            nearest = AreaNearest(distance, light.radiance, light.slot, type);
#ifdef RECT_IMAGES
            if (type == AREA_RECT && light.image.z > 0.0)
                nearest.radiance *= light_image_sharp(light_image_of(light.image), light_image_place(direction * distance - light.center, light.axis,
                                                                                                     light.facing, light.a, light.b));
#endif
        }
    } while (++i < end);
}

/// The nearest body that a ray meets; of type -1: none.
AreaNearest area_nearest(LightReceiver r, vec3 direction)
{
    AreaNearest nearest = AreaNearest(AREA_MISSED, vec3(0.0), -1.0, -1);
#ifdef RECT_LIGHTS
    area_offer(nearest, AREA_RECT, uRectLights, uRectFirst, uRectEnd, r, direction);
#endif
#ifdef DISK_LIGHTS
    area_offer(nearest, AREA_DISK, uDiskLights, uDiskFirst, uDiskEnd, r, direction);
#endif
#ifdef SPHERE_LIGHTS
    area_offer(nearest, AREA_SPHERE, uSphereLights, uSphereFirst, uSphereEnd, r, direction);
#endif
#ifdef TUBE_LIGHTS
    area_offer(nearest, AREA_TUBE, uTubeLights, uTubeFirst, uTubeEnd, r, direction);
#endif
    return nearest;
}

/// What an ideal mirror shows: the nearest body that the mirrored ray meets, if it is of the type MIRRORED_TYPE (-1: of
/// any).
vec3 mirrored_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 direction = normalize(2.0 * r.wo.z * r.frame.n - r.wo_w);
    AreaNearest nearest = area_nearest(r, direction);
    vec3 shown = nearest.radiance * model_mirror(r.wo.z, dot(r.wo.xy, r.wo.xy), params);
#ifdef AREA_SHADOWS
    shown *= light_visibility_by_ray(nearest.slot, r, direction, nearest.type >= 0 ? nearest.distance : 0.0);
#endif
    bool shows = r.wo.z > 0.0 && nearest.type >= 0 && (MIRRORED_TYPE < 0 || nearest.type == MIRRORED_TYPE);
    return shows ? shown : vec3(0.0);
}
#else
#ifdef AREA_SAMPLED
/// A light as the surface sees it; only its own type's part is set.
struct AreaView {
    AreaRectView rect;
    AreaDiskView disk;
    AreaSphereView sphere;
    AreaTubeView tube;
};

AreaView area_view(int type, AreaLight l)
{
    AreaView v;
    if (type == AREA_RECT)
        v.rect = area_rect_view(l.center, l.facing, l.axis, l.a, l.b);
    if (type == AREA_DISK)
        v.disk = area_disk_view(l.center, l.facing, l.a);
    if (type == AREA_SPHERE)
        v.sphere = area_sphere_view(l.center, l.a);
    if (type == AREA_TUBE)
        v.tube = area_tube_view(l.center, l.axis * l.a, l.b);
    return v;
}

AreaSample area_sample(int type, AreaView v, vec2 u)
{
    if (type == AREA_RECT)
        return area_rect_sample(v.rect, area_folded(u));
    if (type == AREA_DISK)
        return area_disk_sample(v.disk, area_folded_polar(u));
    if (type == AREA_SPHERE)
        return area_sphere_sample(v.sphere, area_folded_polar(u));
    return area_tube_sample(v.tube, area_folded(u));
}

#ifdef RECT_IMAGES
#ifndef AREA_ANALYTIC
uniform float uAreaPointsEver;  // in all jittered frames
#endif

/// What comes from a point of a rect, of its radiance: the picture blurred by the part of it that one of all the points
/// stands for, and half a level more, as points are not where its parts are. Where the closed form is multiplied by their
/// share that arrives: of the points of this frame alone, as that share is of these.
vec3 area_image(AreaLight light, AreaRectView view, vec2 u, AreaSample s)
{
    float cosine = max(-dot(s.direction, light.facing), 1e-7);
#ifdef AREA_ANALYTIC
    float points = float(uAreaPointsAll);
#else
    float points = uAreaPointsEver;
#endif
    float part = s.solid_angle * s.distance * s.distance / (cosine * points * 4.0 * light.a * light.b);
    LightImage image = light_image_of(light.image);
    float level = float(abs(image.turn)) - 0.5 - 0.5 * log2(clamp(part, 1e-20, 1.0));
    // Where it is so small that offsets would cancel, points are even in area.
    vec2 place = view.spherical ? light_image_place(s.direction * s.distance - light.center, light.axis, light.facing, light.a, light.b)
                                : vec2(1.0 - u.x, u.y);
    return light_image_blurred(image, place, level);
}
#endif

/// A point of a light, and what it reflects.
vec3 area_point_reflected(int type, AreaView view, vec2 u, AreaLight light, LightReceiver r, MODEL_PARAMS params, out AreaSample s)
{
    s = area_sample(type, view, u);
    vec3 f = light_reflected(r, params, s.direction) * s.solid_angle;
#ifdef RECT_IMAGES
    if (type == AREA_RECT && light.image.z > 0.0)
        f *= area_image(light, view.rect, area_folded(u), s);
#endif
    return f;
}

AreaTally area_points(int type, int i, AreaLight light, LightReceiver r, MODEL_PARAMS params)
{
    AreaView view = area_view(type, light);
    uvec2 shift = area_shift(i, type);
    AreaTally tally = AreaTally(vec3(0.0), vec3(0.0));
    int point = uAreaPointsFirst;
    AreaSample s;
    do {
        vec3 f = area_point_reflected(type, view, area_point(shift, point), light, r, params, s);
        area_count(tally, f, s, light, r);
    } while (++point < uAreaPointsEnd);
    light_loop_ended(point >= uAreaPointsEnd);
#ifdef AREA_SPLIT
    // Other draws count the rest of what arrives; what is lit is that of all points.
    tally.lit = vec3(0.0);
    point = 0;
    do
        tally.lit += area_point_reflected(type, view, area_point(shift, point), light, r, params, s);
    while (++point < uAreaPointsAll);
    light_loop_ended(point >= uAreaPointsAll);
#endif
    return tally;
}
#endif

#ifdef AREA_ANALYTIC
vec3 area_reflected(int type, AreaLight light, LightReceiver r)
{
    if (type == AREA_RECT)
        return area_reflected_rect(light, r);
    if (type == AREA_DISK)
        return area_reflected_disk(light, r);
    if (type == AREA_SPHERE)
        return area_reflected_sphere(light, r);
    return area_reflected_tube(light, r);
}
#endif

#ifdef AREA_MAP_SHADOWS
float area_map_visible(int type, AreaLight light, LightReceiver r)
{
    if (type == AREA_RECT)
        return area_map_visible_of(uShadowRect, light, r, 4.0 * light.a * light.b);
    if (type == AREA_DISK)
        return area_map_visible_of(uShadowDisk, light, r, PI * light.a * light.a);
    if (type == AREA_SPHERE)
        return area_map_visible_of(uShadowSphere, light, r, PI * light.a * light.a);
    return area_map_visible_of(uShadowTube, light, r, (4.0 * light.a + PI * light.b) * light.b);
}
#endif

vec3 area_arrives(int type, int i, AreaLight light, LightReceiver r, MODEL_PARAMS params)
{
#if defined(AREA_SAMPLED) && defined(AREA_ANALYTIC)
    vec3 reflected = area_arriving(area_points(type, i, light, r, params), area_reflected(type, light, r));
#elif defined(AREA_SAMPLED)
    vec3 reflected = area_points(type, i, light, r, params).seen / float(uAreaPointsAll);
#else
    vec3 reflected = area_reflected(type, light, r);
#endif
#ifdef AREA_HARD_SHADOWS
    reflected *= area_center_visible(light, r);
#endif
#ifdef AREA_MAP_SHADOWS
    reflected *= area_map_visible(type, light, r);
#endif
    return light.radiance * reflected;
}

vec3 area_sum(int type, samplerBuffer lights, int first, int end, LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = first;
    do
        sum += area_arrives(type, i, area_light(type, lights, i, r), r, params);
    while (++i < end);
    light_loop_ended(i >= end);
    return sum;
}
#endif

vec3 all_area_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
#ifdef AREA_ANALYTIC
    area_begin(r, params);
#endif
#ifdef MIRRORED_LIGHTS
    sum += mirrored_lights(r, params);
#else
#ifdef RECT_LIGHTS
    sum += area_sum(AREA_RECT, uRectLights, uRectFirst, uRectEnd, r, params);
#endif
#ifdef DISK_LIGHTS
    sum += area_sum(AREA_DISK, uDiskLights, uDiskFirst, uDiskEnd, r, params);
#endif
#ifdef SPHERE_LIGHTS
    sum += area_sum(AREA_SPHERE, uSphereLights, uSphereFirst, uSphereEnd, r, params);
#endif
#ifdef TUBE_LIGHTS
    sum += area_sum(AREA_TUBE, uTubeLights, uTubeFirst, uTubeEnd, r, params);
#endif
#endif
    return sum;
}
