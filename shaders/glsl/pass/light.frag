/// light.frag - adds the light of one type, reflected by the surfaces of one model.
///
/// The defines name the type (DIRECTIONAL_LIGHTS, POINT_LIGHTS, ...); pixels of other models are masked by stencil.
#include "pass/gbuffer_read.glsl"
#include "generated/material.glsl"
#include "pass/lights.glsl"

layout(location = 0) out vec4 oRadiance;

void main()
{
    float z = gbuffer_z();
    vec3 ray = gbuffer_ray();
#ifdef USES_TANGENT
    Frame frame = frame_decode_tangent(gbuffer_normal(), texelFetch(uTangent, gbuffer_pixel(), 0).x);
#else
    Frame frame = frame_from_normal(gbuffer_normal());
#endif
    LightReceiver receiver = light_receiver(gbuffer_position(z, ray), ray, z, frame);
#ifdef SHADOWS
    receiver.geometric_normal = gbuffer_geometric_normal();
    receiver.behind = 0.0;
#endif
    vec3 radiance = all_lights(receiver, gbuffer_read_params());
    oRadiance = vec4(radiance, light_alpha(0.0));
}
