// Reciprocity of a model whose terms cancel: the allowance follows their sizes, not their sum.
#include "brdf/oren_nayar.glsl"

/// @test oren_nayar_is_reciprocal  @tag brdf  @inputs 32768
void test_oren_nayar(Dirs d, OrenNayarParams p)
{
    vec3 there = oren_nayar_f_cos(d, p) * d.wo.z;
    vec3 back = oren_nayar_f_cos(Dirs(d.wo, d.wi, d.h), p) * d.wi.z;
    assume(d.wi.z > 1e-15 && d.wo.z > 1e-15);  // their product is no float below

    // What the terms of f_r are at most, in units of rho / pi: 1, 0.45 tan(b), 0.125 tan((a + b) / 2) and 0.34 rho.
    float sin_i = length(d.wi.xy);
    float sin_o = length(d.wo.xy);
    float tan_b = d.wi.z > d.wo.z ? sin_i / d.wi.z : sin_o / d.wo.z;
    float tan_mean = (sin_i + sin_o) / (d.wi.z + d.wo.z);
    float sizes = d.wi.z * d.wo.z * (1.34 + 0.45 * tan_b + 0.125 * tan_mean);
    vec3 allowed = 4e-6 * INV_PI * sizes * p.diffuse + 1e-36;  // 64 roundings
    check_abs(there.x, back.x, allowed.x);
    check_abs(there.y, back.y, allowed.y);
    check_abs(there.z, back.z, allowed.z);
}
