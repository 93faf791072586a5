/// octahedral.glsl - unit vectors as points of a square.
///
/// value  the sphere is projected onto the octahedron |x| + |y| + |z| = 1, whose lower half is folded out
/// domain any unit vector; decoding accepts the whole square
/// source Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014
/// stable integer codes leave out one of their 2^bits steps, so that 0 is a code and the axes are exact
/// error  32-bit float codes 3.2e-7 rad; 16-bit codes 6.4e-5 rad, 2.3e-5 on average; 8-bit codes 1.7e-2 rad, 5.9e-3 on
///        average (tests/shading/octahedral_test.cpp)

/// Never sign(): it gives 0 at 0.
vec2 octahedral_sign(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

/// Into [-1, 1]^2. Only the direction of n counts; the zero vector is taken as +z.
vec2 octahedral_encode(vec3 n)
{
    vec2 p = n.xy / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-37);
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * octahedral_sign(p);
}

vec3 octahedral_decode(vec2 p)
{
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    n.xy -= octahedral_sign(p) * max(-n.z, 0.0);
    return normalize(n);
}

/// Into [0, 1]^2, to be stored in RG16 (unsigned normalised), whose conversion rounds to the nearest of 65535 steps.
vec2 octahedral_encode_unorm16(vec3 n) { return octahedral_encode(n) * (32767.0 / 65535.0) + 32767.0 / 65535.0; }

vec3 octahedral_decode_unorm16(vec2 stored)
{
    return octahedral_decode((floor(stored * 65535.0 + 0.5) - 32767.0) / 32767.0);
}

/// Into [0, 1]^2, to be stored in RG8.
vec2 octahedral_encode_unorm8(vec3 n) { return octahedral_encode(n) * (127.0 / 255.0) + 127.0 / 255.0; }

vec3 octahedral_decode_unorm8(vec2 stored)
{
    return octahedral_decode((floor(stored * 255.0 + 0.5) - 127.0) / 127.0);
}
