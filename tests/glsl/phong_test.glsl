// Which of Phong's forms are reciprocal.
#include "brdf/blinn_phong.glsl"
#include "brdf/phong.glsl"

void check_reciprocal(vec3 there, vec3 back, Dirs d)
{
    assume(min(min(there.x, there.y), min(there.z, min(min(back.x, back.y), back.z))) > 1e-30);
    check_near(there * d.wo.z, back * d.wi.z, 2e-6);
}

/// @test phong_energy_form_is_reciprocal  @tag brdf
/// @in normalization: values(1)
void test_phong(Dirs d, PhongParams p) { check_reciprocal(phong_f_cos(d, p), phong_f_cos(Dirs(d.wo, d.wi, d.h), p), d); }

/// @test blinn_phong_energy_form_is_reciprocal  @tag brdf
/// @in normalization: values(1)
void test_blinn_phong(Dirs d, BlinnPhongParams p)
{
    check_reciprocal(blinn_phong_f_cos(d, p), blinn_phong_f_cos(Dirs(d.wo, d.wi, d.h), p), d);
}

/// @test phong_classic_form_is_not_reciprocal  @tag brdf
/// @in normalization: values(0)
/// @must_fail its highlight has no cosine
void test_classic_phong(Dirs d, PhongParams p) { test_phong(d, p); }

/// @test blinn_phong_classic_form_is_not_reciprocal  @tag brdf
/// @in normalization: values(0)
/// @must_fail its highlight has no cosine
void test_classic_blinn_phong(Dirs d, BlinnPhongParams p) { test_blinn_phong(d, p); }
