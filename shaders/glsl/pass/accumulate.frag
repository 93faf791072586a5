/// accumulate.frag - a jittered frame's share of the mean of all; blended additively. RADIANCE_16F: the frame is in half
/// floats, where some drivers keep the largest, 65504, in place of what is beyond: that is infinite here.
uniform sampler2D uRadiance;
uniform float uWeight;
layout(location = 0) out vec4 oRadiance;

void main()
{
    vec4 radiance = texelFetch(uRadiance, ivec2(gl_FragCoord.xy), 0);
#ifdef RADIANCE_16F
    const float infinity = uintBitsToFloat(0x7f800000u);
    radiance = mix(radiance, vec4(infinity), greaterThanEqual(radiance, vec4(65504.0)));
#endif
    oRadiance = uWeight * radiance;
}
