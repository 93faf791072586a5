/// map.frag - depth alone, with holes where a mask cuts them.
///
/// Depth from 0 to 1 comes from the clip coordinates. Without clip control a perspective's, reach / z, would lose its
/// digits on the way through -1 to 1: then it is written here.
#ifdef ALPHA_MASK
#include "generated/material.glsl"
#endif
#ifdef WRITE_DEPTH
uniform float uReach;  // where a perspective map begins, m; 0: light is parallel
#endif

void main()
{
#ifdef ALPHA_MASK
    if (surface_alpha() < uAlphaCutoff)
        discard;
#endif
#ifdef WRITE_DEPTH
    gl_FragDepth = uReach > 0.0 ? min(uReach * gl_FragCoord.w, 1.0) : gl_FragCoord.z;
#endif
}
