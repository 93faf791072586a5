/// pixel_lattice.glsl - points of the unit square, well spread within a pixel and different from pixel to pixel.
///
/// value  a lattice whose first 2^m points are a lattice for every m, shifted by a hash: in [0, 1)^2, steps of 2^-24
/// source Hickernell et al., "Extensible lattice sequences", SIAM J. Sci. Comput. 22(3), 2000; generator 1, 182667 of
///        Cools, Kuo, Nuyens, ibid. 28(6), 2006; Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3),
///        2020: pcg3d
/// stable 32-bit integers, which wrap around: no digit is lost

/// A hash of three numbers as two.
uvec2 lattice_hash(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v.xy;
}

uint lattice_reversed(uint i)
{
    i = ((i >> 1u) & 0x55555555u) | ((i & 0x55555555u) << 1u);
    i = ((i >> 2u) & 0x33333333u) | ((i & 0x33333333u) << 2u);
    i = ((i >> 4u) & 0x0f0f0f0fu) | ((i & 0x0f0f0f0fu) << 4u);
    i = ((i >> 8u) & 0x00ff00ffu) | ((i & 0x00ff00ffu) << 8u);
    return (i >> 16u) | (i << 16u);
}

vec2 lattice_point(uvec2 shift, int i)
{
    uvec2 u = shift + lattice_reversed(uint(i)) * uvec2(1u, 182667u);
    return vec2(u >> 8u) * (1.0 / 16777216.0);
}
