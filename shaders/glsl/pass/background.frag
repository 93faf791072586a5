/// background.frag - the environment where no surface is.
#include "pass/gbuffer_read.glsl"
#include "light/environment.glsl"

layout(location = 0) out vec4 oRadiance;

void main() { oRadiance = vec4(environment_radiance(normalize(gbuffer_ray())), 1.0); }
