/// lights.glsl - sums the lights of each type at a point; those with a body: pass/area_lights.glsl.
///
/// Each punctual light is three (directional: two) texels of a buffer, in camera-relative world space. Loops are do-while behind
/// a define, so that a type without lights costs nothing, also where both sides of a branch are executed.
/// Lights that reach everything come first; those with a range are listed by cluster: tiles of 64 x 64 pixels and
/// slices of depth.
#include "common/dirs.glsl"
#include "light/punctual.glsl"

/// What all lights of a fragment share.
struct LightReceiver {
    vec3 position;  // relative to the eye, world axes, m
    vec3 wo_w;      // unit, to the eye
    Frame frame;
    vec3 wo;        // wo_w in the frame
    float z;        // distance along the view axis, m
#ifdef SHADOWS
    vec3 geometric_normal;  // of the triangle, unit, world axes, towards the eye
    float behind;           // what the surface lets through of light from its other side, 0..1
#endif
};

LightReceiver light_receiver(vec3 position, vec3 ray, float z, Frame frame)
{
    LightReceiver r;
    r.position = position;
    r.wo_w = -normalize(ray);
    r.frame = frame;
    r.wo = frame_to_local(frame, r.wo_w);
    r.z = z;
    return r;
}

#ifdef SHADOWS
#include "shadow/visibility.glsl"
#endif

/// Where lights cast rays, a driver may end the loop over them before the last: see ray_unfinished.
void light_loop_ended(bool after_all)
{
#ifdef SHADOW_RAYS
    ray_unfinished = ray_unfinished || !after_all;
#endif
}

/// Infinite where a ray was cut short: the picture is then an error.
float light_alpha(float alpha)
{
#ifdef SHADOW_RAYS
    return ray_unfinished ? uintBitsToFloat(0x7f800000u) : alpha;
#else
    return alpha;
#endif
}

vec3 light_reflected(LightReceiver r, MODEL_PARAMS params, vec3 wi_w)
{
    return model_f_cos(dirs_make_wo(r.frame, r.wo, wi_w, r.wo_w), params);
}

#ifdef DIRECTIONAL_LIGHTS
uniform samplerBuffer uDirectionalLights;  // to the light (unit), shadow's slot; irradiance, -
uniform int uDirectionalFirst, uDirectionalEnd;

vec3 directional_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uDirectionalFirst;
    do {
        vec4 light = texelFetch(uDirectionalLights, 2 * i);
        vec3 irradiance = texelFetch(uDirectionalLights, 2 * i + 1).xyz;
#ifdef DIRECTIONAL_SHADOWS
        irradiance *= light_visibility_directional(light.w, r, light.xyz);
#endif
        sum += irradiance * light_reflected(r, params, light.xyz);
    } while (++i < uDirectionalEnd);
    light_loop_ended(i >= uDirectionalEnd);
    return sum;
}
#endif

#if defined(POINT_CLUSTERS) || defined(SPOT_CLUSTERS)
uniform vec3 uClusterZ;       // slice = clamp(log2(z) * x + y, 0, z - 1)
uniform ivec2 uClusterTiles;  // number of tiles across and up
uniform usamplerBuffer uClusterIndices;

int light_cluster(float z)
{
    ivec2 tile = ivec2(gl_FragCoord.xy) / 64;
    int slice = int(clamp(log2(max(z, 1e-30)) * uClusterZ.x + uClusterZ.y, 0.0, uClusterZ.z - 1.0));
    return (slice * uClusterTiles.y + tile.y) * uClusterTiles.x + tile.x;
}
#endif

#if defined(POINT_LIGHTS) || defined(POINT_CLUSTERS)
uniform samplerBuffer uPointLights;  // position, 1/range^2; radiant intensity, shadow's slot

vec3 point_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    vec4 light = texelFetch(uPointLights, 2 * i);
    vec4 intensity = texelFetch(uPointLights, 2 * i + 1);
    vec3 to_light = light.xyz - r.position;
    PunctualGeometry g = punctual_geometry(to_light, light.w);
#ifdef POINT_SHADOWS
    g.attenuation *= light_visibility_point(intensity.w, r, g.wi, g.attenuation > 0.0 ? dot(to_light, g.wi) : 0.0);
#endif
    return intensity.xyz * (g.attenuation * light_reflected(r, params, g.wi));
}
#endif
#ifdef POINT_LIGHTS
uniform int uPointFirst, uPointEnd;

vec3 point_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uPointFirst;
    do
        sum += point_light(i, r, params);
    while (++i < uPointEnd);
    light_loop_ended(i >= uPointEnd);
    return sum;
}
#endif
#ifdef POINT_CLUSTERS
uniform usamplerBuffer uPointClusters;  // first, count

vec3 point_lights_of_cluster(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    ivec2 list = ivec2(texelFetch(uPointClusters, light_cluster(r.z)).xy);
    int i = list.x;
    if (list.y > 0) {
        do
            sum += point_light(int(texelFetch(uClusterIndices, i).x), r, params);
        while (++i < list.x + list.y);
        light_loop_ended(i >= list.x + list.y);
    }
    return sum;
}
#endif

#if defined(SPOT_LIGHTS) || defined(SPOT_CLUSTERS)
// position, 1/range^2; radiant intensity, cone scale; axis (unit), cone offset; with shadows also -, shadow's slot
uniform samplerBuffer uSpotLights;
#ifdef SPOT_SHADOWS
const int SPOT_TEXELS = 4;
#else
const int SPOT_TEXELS = 3;
#endif

vec3 spot_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    vec4 light = texelFetch(uSpotLights, SPOT_TEXELS * i);
    vec4 intensity = texelFetch(uSpotLights, SPOT_TEXELS * i + 1);
    vec4 axis = texelFetch(uSpotLights, SPOT_TEXELS * i + 2);
    vec3 to_light = light.xyz - r.position;
    PunctualGeometry g = punctual_geometry(to_light, light.w);
    float cone = spot_attenuation(axis.xyz, g.wi, intensity.w, axis.w);
#ifdef SPOT_SHADOWS
    cone *= light_visibility_spot(texelFetch(uSpotLights, SPOT_TEXELS * i + 3).w, r, g.wi,
                                  g.attenuation * cone > 0.0 ? dot(to_light, g.wi) : 0.0);
#endif
    return intensity.xyz * (g.attenuation * cone * light_reflected(r, params, g.wi));
}
#endif
#ifdef SPOT_LIGHTS
uniform int uSpotFirst, uSpotEnd;

vec3 spot_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uSpotFirst;
    do
        sum += spot_light(i, r, params);
    while (++i < uSpotEnd);
    light_loop_ended(i >= uSpotEnd);
    return sum;
}
#endif
#ifdef SPOT_CLUSTERS
uniform usamplerBuffer uSpotClusters;  // first, count

vec3 spot_lights_of_cluster(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    ivec2 list = ivec2(texelFetch(uSpotClusters, light_cluster(r.z)).xy);
    int i = list.x;
    if (list.y > 0) {
        do
            sum += spot_light(int(texelFetch(uClusterIndices, i).x), r, params);
        while (++i < list.x + list.y);
        light_loop_ended(i >= list.x + list.y);
    }
    return sum;
}
#endif

#if defined(RECT_LIGHTS) || defined(DISK_LIGHTS) || defined(SPHERE_LIGHTS) || defined(TUBE_LIGHTS)
#define AREA_LIGHTS
#include "pass/area_lights.glsl"
#endif

#ifdef ENVIRONMENT_LIGHT
#include "pass/environment.glsl"
#endif

/// Light of every type that the defines name.
vec3 all_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
#ifdef DIRECTIONAL_LIGHTS
    sum += directional_lights(r, params);
#endif
#ifdef POINT_LIGHTS
    sum += point_lights(r, params);
#endif
#ifdef POINT_CLUSTERS
    sum += point_lights_of_cluster(r, params);
#endif
#ifdef SPOT_LIGHTS
    sum += spot_lights(r, params);
#endif
#ifdef SPOT_CLUSTERS
    sum += spot_lights_of_cluster(r, params);
#endif
#if defined(AREA_LIGHTS) && !defined(ENVIRONMENT_ALONE)
    sum += all_area_lights(r, params);
#endif
#ifdef ENVIRONMENT_LIGHT
    sum += environment_light(r, params);
#endif
    return sum;
}
