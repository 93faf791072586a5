/// airlight.frag - adds the light of one type of lamps that fog scatters on the way to what a pixel shows.
///
/// FOG_BACKGROUND: where no surface is, the way has no end.
#ifdef AIRLIGHT_POINTS
uniform samplerBuffer uPointLights;
#endif
#ifdef AIRLIGHT_SPOTS
uniform samplerBuffer uSpotLights;
#endif
#include "pass/airlight.glsl"
#include "pass/gbuffer_read.glsl"

layout(location = 0) out vec4 oRadiance;

void main()
{
    vec3 ray = gbuffer_ray();
    float length_per_z = length(ray);
#ifdef FOG_BACKGROUND
    float distance = uintBitsToFloat(0x7f800000u);
#else
    float distance = gbuffer_z() * length_per_z;
#endif
    oRadiance = vec4(airlight_of_lamps(gbuffer_position(0.0, ray), ray / length_per_z, distance), 0.0);
}
