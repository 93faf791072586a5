/// accumulate.frag - a jittered frame's share of the mean of all; blended additively.
uniform sampler2D uRadiance;
uniform float uWeight;
layout(location = 0) out vec4 oRadiance;

void main() { oRadiance = uWeight * texelFetch(uRadiance, ivec2(gl_FragCoord.xy), 0); }
