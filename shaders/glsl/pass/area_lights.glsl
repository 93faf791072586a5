/// area_lights.glsl - sums the lights with a body of each type at a point.
///
/// AREA_ANALYTIC: the whole light in closed form (pass/area_reflected.glsl). AREA_SAMPLED: points on it, each with the
/// model's value and, with AREA_SHADOWS, a ray of its own. Both: the closed form, times the share of the points' light
/// that arrives, so that only penumbrae are noisy; none of it where no point lights the surface. AREA_HARD_SHADOWS: one
/// ray to the centre. AREA_MAP_SHADOWS: by a shadow map about the centre, as soft as of a sphere that is as large seen
/// from the front; with AREA_POINT_SHADOWS as of a point. MIRRORED_LIGHTS: what an ideal mirror shows of them.
///
/// Points: a lattice whose first 2^m points are a lattice for every m (Hickernell et al., "Extensible lattice sequences",
/// SIAM J. Sci. Comput. 22(3), 2000; generator 1, 182667 of Cools, Kuo, Nuyens, ibid. 28(6), 2006), shifted from pixel to
/// pixel and from light to light by a hash, and folded like a tent where what is integrated has ends (Hickernell, MCQMC
/// 2000): smooth integrands then converge with the square of the number of points. Jittered frames go on where the last
/// one stopped, so that they add up to more points.
#include "light/area_sample.glsl"
#include "pass/area_reflected.glsl"

// position, 1/range^2; radiance, shadow's slot; axis, a; facing, b
const int AREA_TEXELS = 4;

AreaLight area_light(samplerBuffer lights, int i, LightReceiver r)
{
    vec4 position = texelFetch(lights, AREA_TEXELS * i);
    vec4 radiance = texelFetch(lights, AREA_TEXELS * i + 1);
    vec4 axis = texelFetch(lights, AREA_TEXELS * i + 2);
    vec4 facing = texelFetch(lights, AREA_TEXELS * i + 3);
    AreaLight light;
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
float area_map_visible(int first, AreaLight light, LightReceiver r, float area)
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

/// A hash of three numbers as two (Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3), 2020: pcg3d).
uvec2 area_hash(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v.xy;
}

/// Where a light's points of one pixel start.
uvec2 area_shift(int light, int type) { return area_hash(uvec3(uvec2(gl_FragCoord.xy), uint(light * 4 + type))); }

uint area_reversed(uint i)
{
    i = ((i >> 1u) & 0x55555555u) | ((i & 0x55555555u) << 1u);
    i = ((i >> 2u) & 0x33333333u) | ((i & 0x33333333u) << 2u);
    i = ((i >> 4u) & 0x0f0f0f0fu) | ((i & 0x0f0f0f0fu) << 4u);
    i = ((i >> 8u) & 0x00ff00ffu) | ((i & 0x00ff00ffu) << 8u);
    return (i >> 16u) | (i << 16u);
}

/// In [0, 1)^2. 32-bit integers, which wrap around: no digit is lost.
vec2 area_point(uvec2 shift, int i)
{
    uvec2 u = shift + area_reversed(uint(uAreaStart + i)) * uvec2(1u, 182667u);
    return vec2(u >> 8u) * (1.0 / 16777216.0);
}

vec2 area_folded(vec2 u) { return 1.0 - abs(2.0 * u - 1.0); }
/// Of a square whose second side is an angle.
vec2 area_folded_polar(vec2 u) { return vec2(1.0 - abs(2.0 * u.x - 1.0), u.y); }

/// Sums over points: what all of them would reflect, and what arrives of it.
struct AreaTally { vec3 lit, seen; };

void area_count(inout AreaTally tally, AreaSample s, AreaLight light, LightReceiver r, MODEL_PARAMS params)
{
    vec3 f = light_reflected(r, params, s.direction) * s.solid_angle;
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
#ifdef AREA_MAP_SHADOWS
uniform int uShadowRect;
#endif
uniform int uRectFirst, uRectEnd;
#endif
#ifdef DISK_LIGHTS
uniform samplerBuffer uDiskLights;
#ifdef AREA_MAP_SHADOWS
uniform int uShadowDisk;
#endif
uniform int uDiskFirst, uDiskEnd;
#endif
#ifdef SPHERE_LIGHTS
uniform samplerBuffer uSphereLights;
#ifdef AREA_MAP_SHADOWS
uniform int uShadowSphere;
#endif
uniform int uSphereFirst, uSphereEnd;
#endif
#ifdef TUBE_LIGHTS
uniform samplerBuffer uTubeLights;
#ifdef AREA_MAP_SHADOWS
uniform int uShadowTube;
#endif
uniform int uTubeFirst, uTubeEnd;
#endif

#ifdef MIRRORED_LIGHTS
#include "light/area_ray.glsl"

/// The nearest light with a body on a ray so far.
struct AreaNearest { float distance; vec3 radiance; float slot; int type; };

void area_offer(inout AreaNearest nearest, float distance, AreaLight light, int type)
{
    if (distance < nearest.distance)
        nearest = AreaNearest(distance, light.radiance, light.slot, type);
}

/// What an ideal mirror shows: the nearest body that the mirrored ray meets, if it is of a type that MIRRORED_TYPE names
/// (-1: of any; else in the order rect, disk, sphere, tube).
vec3 mirrored_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 direction = normalize(2.0 * r.wo.z * r.frame.n - r.wo_w);
    AreaNearest nearest = AreaNearest(AREA_MISSED, vec3(0.0), -1.0, -1);
    int i = 0;
#ifdef RECT_LIGHTS
    i = uRectFirst;
    do {
        AreaLight l = area_light(uRectLights, i, r);
        area_offer(nearest, area_rect_ray(l.center, l.facing, l.axis, l.a, l.b, direction), l, 0);
    } while (++i < uRectEnd);
#endif
#ifdef DISK_LIGHTS
    i = uDiskFirst;
    do {
        AreaLight l = area_light(uDiskLights, i, r);
        area_offer(nearest, area_disk_ray(l.center, l.facing, l.a, direction), l, 1);
    } while (++i < uDiskEnd);
#endif
#ifdef SPHERE_LIGHTS
    i = uSphereFirst;
    do {
        AreaLight l = area_light(uSphereLights, i, r);
        area_offer(nearest, area_sphere_ray(l.center, l.a, direction), l, 2);
    } while (++i < uSphereEnd);
#endif
#ifdef TUBE_LIGHTS
    i = uTubeFirst;
    do {
        AreaLight l = area_light(uTubeLights, i, r);
        area_offer(nearest, area_tube_ray(l.center, l.axis * l.a, l.b, direction), l, 3);
    } while (++i < uTubeEnd);
#endif
    vec3 shown = nearest.radiance * model_mirror(r.wo.z, dot(r.wo.xy, r.wo.xy), params);
#ifdef AREA_SHADOWS
    shown *= light_visibility_by_ray(nearest.slot, r, direction, nearest.type >= 0 ? nearest.distance : 0.0);
#endif
    bool shows = r.wo.z > 0.0 && nearest.type >= 0 && (MIRRORED_TYPE < 0 || nearest.type == MIRRORED_TYPE);
    return shows ? shown : vec3(0.0);
}
#else
#ifdef RECT_LIGHTS
#ifdef AREA_SAMPLED
AreaTally rect_points(int i, AreaLight light, LightReceiver r, MODEL_PARAMS params)
{
    AreaRectView view = area_rect_view(light.center, light.facing, light.axis, light.a, light.b);
    uvec2 shift = area_shift(i, 0);
    AreaTally tally = AreaTally(vec3(0.0), vec3(0.0));
    int point = uAreaPointsFirst;
    do
        area_count(tally, area_rect_sample(view, area_folded(area_point(shift, point))), light, r, params);
    while (++point < uAreaPointsEnd);
    light_loop_ended(point >= uAreaPointsEnd);
#ifdef AREA_SPLIT
    // Other draws count the rest of what arrives; what is lit is that of all points.
    tally.lit = vec3(0.0);
    point = 0;
    do {
        AreaSample s = area_rect_sample(view, area_folded(area_point(shift, point)));
        tally.lit += light_reflected(r, params, s.direction) * s.solid_angle;
    } while (++point < uAreaPointsAll);
    light_loop_ended(point >= uAreaPointsAll);
#endif
    return tally;
}
#endif

vec3 rect_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    AreaLight light = area_light(uRectLights, i, r);
#if defined(AREA_SAMPLED) && defined(AREA_ANALYTIC)
    vec3 reflected = area_arriving(rect_points(i, light, r, params), area_reflected_rect(light, r, params));
#elif defined(AREA_SAMPLED)
    vec3 reflected = rect_points(i, light, r, params).seen / float(uAreaPointsAll);
#else
    vec3 reflected = area_reflected_rect(light, r, params);
#endif
#ifdef AREA_HARD_SHADOWS
    reflected *= area_center_visible(light, r);
#endif
#ifdef AREA_MAP_SHADOWS
    reflected *= area_map_visible(uShadowRect, light, r, 4.0 * light.a * light.b);
#endif
    return light.radiance * reflected;
}

vec3 rect_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uRectFirst;
    do
        sum += rect_light(i, r, params);
    while (++i < uRectEnd);
    light_loop_ended(i >= uRectEnd);
    return sum;
}
#endif

#ifdef DISK_LIGHTS
#ifdef AREA_SAMPLED
AreaTally disk_points(int i, AreaLight light, LightReceiver r, MODEL_PARAMS params)
{
    AreaDiskView view = area_disk_view(light.center, light.facing, light.a);
    uvec2 shift = area_shift(i, 1);
    AreaTally tally = AreaTally(vec3(0.0), vec3(0.0));
    int point = uAreaPointsFirst;
    do
        area_count(tally, area_disk_sample(view, area_folded_polar(area_point(shift, point))), light, r, params);
    while (++point < uAreaPointsEnd);
    light_loop_ended(point >= uAreaPointsEnd);
#ifdef AREA_SPLIT
    // Other draws count the rest of what arrives; what is lit is that of all points.
    tally.lit = vec3(0.0);
    point = 0;
    do {
        AreaSample s = area_disk_sample(view, area_folded_polar(area_point(shift, point)));
        tally.lit += light_reflected(r, params, s.direction) * s.solid_angle;
    } while (++point < uAreaPointsAll);
    light_loop_ended(point >= uAreaPointsAll);
#endif
    return tally;
}
#endif

vec3 disk_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    AreaLight light = area_light(uDiskLights, i, r);
#if defined(AREA_SAMPLED) && defined(AREA_ANALYTIC)
    vec3 reflected = area_arriving(disk_points(i, light, r, params), area_reflected_disk(light, r, params));
#elif defined(AREA_SAMPLED)
    vec3 reflected = disk_points(i, light, r, params).seen / float(uAreaPointsAll);
#else
    vec3 reflected = area_reflected_disk(light, r, params);
#endif
#ifdef AREA_HARD_SHADOWS
    reflected *= area_center_visible(light, r);
#endif
#ifdef AREA_MAP_SHADOWS
    reflected *= area_map_visible(uShadowDisk, light, r, PI * light.a * light.a);
#endif
    return light.radiance * reflected;
}

vec3 disk_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uDiskFirst;
    do
        sum += disk_light(i, r, params);
    while (++i < uDiskEnd);
    light_loop_ended(i >= uDiskEnd);
    return sum;
}
#endif

#ifdef SPHERE_LIGHTS
#ifdef AREA_SAMPLED
AreaTally sphere_points(int i, AreaLight light, LightReceiver r, MODEL_PARAMS params)
{
    AreaSphereView view = area_sphere_view(light.center, light.a);
    uvec2 shift = area_shift(i, 2);
    AreaTally tally = AreaTally(vec3(0.0), vec3(0.0));
    int point = uAreaPointsFirst;
    do
        area_count(tally, area_sphere_sample(view, area_folded_polar(area_point(shift, point))), light, r, params);
    while (++point < uAreaPointsEnd);
    light_loop_ended(point >= uAreaPointsEnd);
#ifdef AREA_SPLIT
    // Other draws count the rest of what arrives; what is lit is that of all points.
    tally.lit = vec3(0.0);
    point = 0;
    do {
        AreaSample s = area_sphere_sample(view, area_folded_polar(area_point(shift, point)));
        tally.lit += light_reflected(r, params, s.direction) * s.solid_angle;
    } while (++point < uAreaPointsAll);
    light_loop_ended(point >= uAreaPointsAll);
#endif
    return tally;
}
#endif

vec3 sphere_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    AreaLight light = area_light(uSphereLights, i, r);
#if defined(AREA_SAMPLED) && defined(AREA_ANALYTIC)
    vec3 reflected = area_arriving(sphere_points(i, light, r, params), area_reflected_sphere(light, r, params));
#elif defined(AREA_SAMPLED)
    vec3 reflected = sphere_points(i, light, r, params).seen / float(uAreaPointsAll);
#else
    vec3 reflected = area_reflected_sphere(light, r, params);
#endif
#ifdef AREA_HARD_SHADOWS
    reflected *= area_center_visible(light, r);
#endif
#ifdef AREA_MAP_SHADOWS
    reflected *= area_map_visible(uShadowSphere, light, r, PI * light.a * light.a);
#endif
    return light.radiance * reflected;
}

vec3 sphere_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uSphereFirst;
    do
        sum += sphere_light(i, r, params);
    while (++i < uSphereEnd);
    light_loop_ended(i >= uSphereEnd);
    return sum;
}
#endif

#ifdef TUBE_LIGHTS
#ifdef AREA_SAMPLED
AreaTally tube_points(int i, AreaLight light, LightReceiver r, MODEL_PARAMS params)
{
    AreaTubeView view = area_tube_view(light.center, light.axis * light.a, light.b);
    uvec2 shift = area_shift(i, 3);
    AreaTally tally = AreaTally(vec3(0.0), vec3(0.0));
    int point = uAreaPointsFirst;
    do
        area_count(tally, area_tube_sample(view, area_folded(area_point(shift, point))), light, r, params);
    while (++point < uAreaPointsEnd);
    light_loop_ended(point >= uAreaPointsEnd);
#ifdef AREA_SPLIT
    // Other draws count the rest of what arrives; what is lit is that of all points.
    tally.lit = vec3(0.0);
    point = 0;
    do {
        AreaSample s = area_tube_sample(view, area_folded(area_point(shift, point)));
        tally.lit += light_reflected(r, params, s.direction) * s.solid_angle;
    } while (++point < uAreaPointsAll);
    light_loop_ended(point >= uAreaPointsAll);
#endif
    return tally;
}
#endif

vec3 tube_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    AreaLight light = area_light(uTubeLights, i, r);
#if defined(AREA_SAMPLED) && defined(AREA_ANALYTIC)
    vec3 reflected = area_arriving(tube_points(i, light, r, params), area_reflected_tube(light, r, params));
#elif defined(AREA_SAMPLED)
    vec3 reflected = tube_points(i, light, r, params).seen / float(uAreaPointsAll);
#else
    vec3 reflected = area_reflected_tube(light, r, params);
#endif
#ifdef AREA_HARD_SHADOWS
    reflected *= area_center_visible(light, r);
#endif
#ifdef AREA_MAP_SHADOWS
    reflected *= area_map_visible(uShadowTube, light, r, (4.0 * light.a + PI * light.b) * light.b);
#endif
    return light.radiance * reflected;
}

vec3 tube_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uTubeFirst;
    do
        sum += tube_light(i, r, params);
    while (++i < uTubeEnd);
    light_loop_ended(i >= uTubeEnd);
    return sum;
}
#endif
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
    sum += rect_lights(r, params);
#endif
#ifdef DISK_LIGHTS
    sum += disk_lights(r, params);
#endif
#ifdef SPHERE_LIGHTS
    sum += sphere_lights(r, params);
#endif
#ifdef TUBE_LIGHTS
    sum += tube_lights(r, params);
#endif
#endif
    return sum;
}
