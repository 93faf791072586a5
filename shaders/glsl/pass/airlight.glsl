/// airlight.glsl - airlight of all point and spot lights along a ray, by Gauss' rule on each arc.
///
/// Includers have a loop a type behind AIRLIGHT_POINTS and AIRLIGHT_SPOTS. Lights are those of pass/lights.glsl; nothing
/// shadows airlight.
#include "light/airlight.glsl"

uniform vec2 uAirlightNodes[AIRLIGHT_NODES];  // place in 0..1, weight; weights sum to 1
uniform vec3 uAirlightExtinction;             // 1/m; 0 in channels that do not scatter
uniform vec3 uAirlightScattering;
uniform float uAirlightAnisotropy;
uniform float uAirlightCut;

#ifdef AIRLIGHT_POINTS
uniform int uAirlightPointFirst, uAirlightPointEnd;

vec3 airlight_of_point(int i, vec3 origin, vec3 direction, float distance)
{
    vec4 light = texelFetch(uPointLights, 2 * i);
    AirlightArc arc = airlight_arc(light.xyz - origin, direction, distance, uAirlightCut, light.w);
    vec3 sum = vec3(0.0);
    int node = 0;
    do {
        AirlightPoint point = airlight_point(arc, uAirlightNodes[node].x, uAirlightAnisotropy);
        float strength = uAirlightNodes[node].y * point.phase * punctual_window(point.r * point.r, light.w);
        sum += strength * airlight_dimming(uAirlightExtinction, point.way);
    } while (++node < AIRLIGHT_NODES);
    return texelFetch(uPointLights, 2 * i + 1).xyz * sum * ((arc.to - arc.from) / arc.h);
}

vec3 airlight_of_points(vec3 origin, vec3 direction, float distance)
{
    vec3 sum = vec3(0.0);
    int i = uAirlightPointFirst;
    do
        sum += airlight_of_point(i, origin, direction, distance);
    while (++i < uAirlightPointEnd);
    return sum * uAirlightScattering;
}
#endif

#ifdef AIRLIGHT_SPOTS
uniform int uAirlightSpotFirst, uAirlightSpotEnd;

vec3 airlight_of_spot(int i, vec3 origin, vec3 direction, float distance)
{
    vec4 light = texelFetch(uSpotLights, AIRLIGHT_SPOT_TEXELS * i);
    vec4 intensity = texelFetch(uSpotLights, AIRLIGHT_SPOT_TEXELS * i + 1);
    vec4 axis = texelFetch(uSpotLights, AIRLIGHT_SPOT_TEXELS * i + 2);
    AirlightArc arc = airlight_arc(light.xyz - origin, direction, distance, uAirlightCut, light.w);
    AirlightWedge wedge = airlight_wedge(arc, direction, axis.xyz, axis.w / intensity.w);
    vec3 sum = vec3(0.0);
    int node = 0;
    do {
        AirlightPoint point = airlight_point(arc, uAirlightNodes[node].x, uAirlightAnisotropy);
        float strength = uAirlightNodes[node].y * point.phase * punctual_window(point.r * point.r, light.w)
                         * airlight_cone(wedge, point.angle, intensity.w, axis.w);
        sum += strength * airlight_dimming(uAirlightExtinction, point.way);
    } while (++node < AIRLIGHT_NODES);
    return intensity.xyz * sum * ((arc.to - arc.from) / arc.h);
}

vec3 airlight_of_spots(vec3 origin, vec3 direction, float distance)
{
    vec3 sum = vec3(0.0);
    int i = uAirlightSpotFirst;
    do
        sum += airlight_of_spot(i, origin, direction, distance);
    while (++i < uAirlightSpotEnd);
    return sum * uAirlightScattering;
}
#endif

/// Radiance of all of them.
vec3 airlight_of_lamps(vec3 origin, vec3 direction, float distance)
{
    vec3 sum = vec3(0.0);
#ifdef AIRLIGHT_POINTS
    sum += airlight_of_points(origin, direction, distance);
#endif
#ifdef AIRLIGHT_SPOTS
    sum += airlight_of_spots(origin, direction, distance);
#endif
    return sum;
}
