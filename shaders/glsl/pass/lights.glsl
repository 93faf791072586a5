/// lights.glsl - sums the punctual lights of each type at a point.
///
/// Each light is three (directional: two) texels of a buffer, in camera-relative world space. Loops are do-while behind
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
};

LightReceiver light_receiver(vec3 position, vec3 ray, float z, Frame frame)
{
    vec3 wo_w = -normalize(ray);
    return LightReceiver(position, wo_w, frame, frame_to_local(frame, wo_w), z);
}

vec3 light_reflected(LightReceiver r, MODEL_PARAMS params, vec3 wi_w)
{
    return model_f_cos(dirs_make_wo(r.frame, r.wo, wi_w, r.wo_w), params);
}

#ifdef DIRECTIONAL_LIGHTS
uniform samplerBuffer uDirectionalLights;  // to the light (unit), -; irradiance, -
uniform int uDirectionalFirst, uDirectionalEnd;

vec3 directional_lights(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
    int i = uDirectionalFirst;
    do {
        vec3 wi_w = texelFetch(uDirectionalLights, 2 * i).xyz;
        sum += texelFetch(uDirectionalLights, 2 * i + 1).xyz * light_reflected(r, params, wi_w);
    } while (++i < uDirectionalEnd);
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
uniform samplerBuffer uPointLights;  // position, 1/range^2; radiant intensity, -

vec3 point_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    vec4 light = texelFetch(uPointLights, 2 * i);
    PunctualGeometry g = punctual_geometry(light.xyz - r.position, light.w);
    return texelFetch(uPointLights, 2 * i + 1).xyz * (g.attenuation * light_reflected(r, params, g.wi));
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
    }
    return sum;
}
#endif

#if defined(SPOT_LIGHTS) || defined(SPOT_CLUSTERS)
uniform samplerBuffer uSpotLights;  // position, 1/range^2; radiant intensity, cone scale; axis (unit), cone offset

vec3 spot_light(int i, LightReceiver r, MODEL_PARAMS params)
{
    vec4 light = texelFetch(uSpotLights, 3 * i);
    vec4 intensity = texelFetch(uSpotLights, 3 * i + 1);
    vec4 axis = texelFetch(uSpotLights, 3 * i + 2);
    PunctualGeometry g = punctual_geometry(light.xyz - r.position, light.w);
    float cone = spot_attenuation(axis.xyz, g.wi, intensity.w, axis.w);
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
    }
    return sum;
}
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
    return sum;
}
