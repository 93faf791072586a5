/// fog.frag - fog over the opaque picture: blended with (1, T), T of the second output.
///
/// FOG_BACKGROUND: where no surface is, the way has no end. FOG_DIMS: only what is there is dimmed, in one of several
/// contributions; blended with (0, T).
#include "pass/fog.glsl"
#include "pass/gbuffer_read.glsl"

#ifdef FOG_DIMS
layout(location = 0) out vec4 oTransmittance;
#else
layout(location = 0, index = 0) out vec4 oRadiance;
layout(location = 0, index = 1) out vec4 oTransmittance;
#endif

void main()
{
    vec3 ray = gbuffer_ray();
    float length_per_z = length(ray);
#ifdef FOG_BACKGROUND
    float distance = uintBitsToFloat(0x7f800000u);
#else
    float distance = gbuffer_z() * length_per_z;
#endif
    vec3 depth = fog_depth_along(gbuffer_position(0.0, ray), ray / length_per_z, distance);
    oTransmittance = vec4(fog_transmittance(depth), 1.0);
#ifndef FOG_DIMS
    oRadiance = vec4(uFogRadiance * fog_opacity(depth), 0.0);
#endif
}
