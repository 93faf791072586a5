/// peel.frag - finds the farthest blended fragment in front of the layer that was found last.
#include "pass/peel.glsl"
#include "pass/surface.glsl"

layout(location = 0) out uvec2 oLayer;

void main()
{
#ifdef ALPHA_MASK
    if (surface_alpha() < uAlphaCutoff)
        discard;
#endif
    uvec2 key = peel_key();
    if (!peel_in_front(key, peel_layer()))
        discard;
    oLayer = key;
}
