/// peel_start.frag - the layer behind all blended ones: what is opaque, or the far plane.
uniform sampler2D uDepth;
layout(location = 0) out uvec2 oLayer;

void main()
{
    uint depth = floatBitsToUint(texelFetch(uDepth, ivec2(gl_FragCoord.xy), 0).x);
#ifdef LINEAR_Z
    depth = ~depth;
#endif
    oLayer = uvec2(depth, 0u);
}
