/// fog.glsl - fog between the eye and a place that a pixel shows, with its own radiance and the airlight of lamps.
///
/// FOG_HEIGHT: the density falls off with height. AIRLIGHT: point and spot lights are scattered to the eye.
#include "light/fog.glsl"

uniform vec3 uFogRadiance;
#ifdef FOG_HEIGHT
uniform vec3 uFogLogDensity;  // at the eye; fog.glsl's log_density
uniform float uFogFalloff;    // 1/m
#else
uniform vec3 uFogExtinction;
#endif

/// Optical depth from a place at `origin` (relative to the eye, world axes) over `distance` metres (or infinity) along
/// `direction`, unit.
vec3 fog_depth_along(vec3 origin, vec3 direction, float distance)
{
#ifdef FOG_HEIGHT
    return fog_depth_by_height(uFogLogDensity - uFogFalloff * origin.y, uFogFalloff * direction.y, distance);
#else
    return fog_depth(uFogExtinction, distance);
#endif
}
