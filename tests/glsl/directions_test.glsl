// Octahedral codes and local frames.
#include "common/dirs.glsl"
#include "common/half.glsl"
#include "common/octahedral.glsl"

/// @test octahedral_stays_in_the_square  @tag directions
/// @in n: unit_sphere
/// @expect bounded(-1, 1)
vec2 test_octahedral_square(vec3 n) { return octahedral_encode(n); }

/// @test octahedral_there_and_back  @tag directions
/// @in n: unit_sphere
void test_octahedral_back(vec3 n) { check_abs(octahedral_decode(octahedral_encode(n)), n, 4e-7); }

/// @test octahedral_axes_are_exact  @tag directions
/// @in n: values((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
void test_octahedral_axes(vec3 n)
{
    check_equal(octahedral_decode(octahedral_encode(n)), n);
    check_equal(octahedral_decode_unorm16(octahedral_encode_unorm16(n)), n);
}

/// @test octahedral_decodes_the_whole_square  @tag directions
/// @in p: uniform(-1, 1)
void test_octahedral_decode(vec2 p) { check_near(length(octahedral_decode(p)), 1.0, 3e-7); }

/// @test octahedral_of_nothing_is_finite  @tag directions
/// @in n: values((0, 0, 0), (0x1p-149, 0, 0), (0, -0x1p-126, 0x1p-149))
/// @expect finite
vec2 test_octahedral_zero(vec3 n) { return octahedral_encode(n); }

/// @test frames_are_orthonormal  @tag directions
/// @in n: unit_sphere
void test_frame(vec3 n)
{
    Frame f = frame_from_normal(n);
    check_abs(vec3(dot(f.t, f.b), dot(f.b, f.n), dot(f.n, f.t)), vec3(0.0), 5e-7);
    check_near(vec3(length(f.t), length(f.b), length(f.n)), vec3(1.0), 5e-7);
    check_near(dot(cross(f.t, f.b), f.n), 1.0, 1e-6);
}

/// In the vertex stage too, where surfaces build theirs.
/// @test frames_are_orthonormal_in_vertex_shaders  @tag directions  @stage vertex
/// @in n: unit_sphere
void test_frame_vertex(vec3 n) { test_frame(n); }

/// @test tangents_survive_their_code  @tag directions
/// @in n: unit_sphere
/// @in tangent: unit_sphere
/// @in handed: values(1, -1)
void test_tangent_code(vec3 n, vec3 tangent, float handed)
{
    assume(abs(dot(n, tangent)) < 0.99);
    Frame f = frame_from_normal_tangent(n, vec4(tangent, handed));
    Frame g = frame_decode_tangent(f.n, frame_encode_tangent(f));
    check_abs(g.t, f.t, 3e-6);
    check_abs(g.b, f.b, 3e-6);
}

/// @test half_vectors_are_finite  @tag directions
/// @in wi: hemisphere
/// @in wo: grazing_hemisphere(1e-7)
void test_half(vec3 wi, vec3 wo)
{
    Half h = half_make(Dirs(wi, wo, wi + wo));
    check_finite(vec4(h.h2, h.vh, h.s2, h.tan2));
    check_abs(h.vh * h.vh + h.s2, 1.0, 1e-6);
    check(h.nh2 >= 0.0 && h.nh2 <= 1.0);
}
