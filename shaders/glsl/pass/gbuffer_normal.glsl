/// gbuffer_normal.glsl - the normal as the G-buffer stores it: 2x16 bits, 2x32 where NORMAL_32F, 2x8 where NORMAL_8.
#include "common/octahedral.glsl"

#if defined(NORMAL_32F)
vec2 gbuffer_encode_normal(vec3 n) { return octahedral_encode(n); }
vec3 gbuffer_decode_normal(vec2 stored) { return octahedral_decode(stored); }
#elif defined(NORMAL_8)
vec2 gbuffer_encode_normal(vec3 n) { return octahedral_encode_unorm8(n); }
vec3 gbuffer_decode_normal(vec2 stored) { return octahedral_decode_unorm8(stored); }
#else
vec2 gbuffer_encode_normal(vec3 n) { return octahedral_encode_unorm16(n); }
vec3 gbuffer_decode_normal(vec2 stored) { return octahedral_decode_unorm16(stored); }
#endif

/// The normal as it is read back, from which encoded tangents are measured.
vec3 gbuffer_stored_normal(vec3 n) { return gbuffer_decode_normal(gbuffer_encode_normal(n)); }
