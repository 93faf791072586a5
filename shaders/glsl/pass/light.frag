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
    Frame frame = frame_from_normal(gbuffer_normal());
    LightReceiver receiver = light_receiver(gbuffer_position(z, ray), ray, z, frame);
    oRadiance = vec4(all_lights(receiver, gbuffer_read_params()), 0.0);
}
