/// gbuffer_normal.glsl - the normal as the G-buffer stores it: 2x16 bits, or 2x32 where NORMAL_32F.
#include "common/octahedral.glsl"

/// The normal as it is read back, from which encoded tangents are measured.
vec3 gbuffer_stored_normal(vec3 n)
{
#ifdef NORMAL_32F
    return octahedral_decode(octahedral_encode(n));
#else
    return octahedral_decode_unorm16(octahedral_encode_unorm16(n));
#endif
}

#ifdef NORMAL_32F
vec2 gbuffer_encode_normal(vec3 n) { return octahedral_encode(n); }
vec3 gbuffer_decode_normal(vec2 stored) { return octahedral_decode(stored); }
#else
vec2 gbuffer_encode_normal(vec3 n) { return octahedral_encode_unorm16(n); }
vec3 gbuffer_decode_normal(vec2 stored) { return octahedral_decode_unorm16(stored); }
#endif
