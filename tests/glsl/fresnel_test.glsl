// Fresnel's equations as every model uses them.
#include "common/fresnel.glsl"

float sine_squared(float c) { return (1.0 - c) * (1.0 + c); }

/// @test reflectance_is_between_0_and_1  @tag fresnel
/// @in eta: uniform(1.0001, 4)
/// @in k: uniform(0, 10)
/// @in c: uniform(0, 1)
/// @expect bounded(0, 1.000001)
vec3 test_bounded(float eta, float k, float c) { return fresnel_exact(vec3(eta), vec3(k), c, sine_squared(c)); }

/// @test grazing_light_is_reflected_whole  @tag fresnel
/// @in eta: uniform(0.1, 10)
/// @in k: uniform(0, 10)
/// @expect equals (1, 1, 1) within rel 1e-6
vec3 test_grazing(float eta, float k) { return fresnel_exact(vec3(eta), vec3(k), 0.0, 1.0); }

/// ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2)
/// @test normal_incidence  @tag fresnel
/// @in eta: uniform(1.01, 4)
/// @in k: uniform(0, 10)
/// @expect equals normal_reflectance within rel 4e-6
vec3 test_normal(float eta, float k) { return fresnel_exact(vec3(eta), vec3(k), 1.0, 0.0); }
vec3 normal_reflectance(float eta, float k)
{
    return vec3(((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k));
}

/// @test total_reflection  @tag fresnel
/// @in eta: uniform(0.2, 0.9)
/// @in c: uniform(0, 1)
void test_total(float eta, float c)
{
    assume(sine_squared(c) > 1.001 * eta * eta);
    check_near(fresnel_exact(vec3(eta), vec3(0.0), c, sine_squared(c)), vec3(1.0), 1e-5);
}

/// @test schlick_falls_with_the_cosine  @tag fresnel
/// @in f0: uniform(0, 1)
/// @in c: uniform(0, 1)
/// @expect bounded(0, 1.0000001)
/// @expect monotone decreasing in c within 4 ulp
vec3 test_schlick(float f0, float c) { return fresnel_schlick(vec3(f0), c, sine_squared(c)); }

/// @test dielectrics_ignore_extinction  @tag fresnel
/// @in eta: uniform(1, 3)
/// @in k: uniform(0, 10)
/// @in c: uniform(0, 1)
void test_dielectric(float eta, float k, float c)
{
    check_equal(fresnel_reflectance(FRESNEL_DIELECTRIC, vec3(0.5), vec3(eta), vec3(k), c, sine_squared(c)),
                fresnel_exact(vec3(eta), vec3(0.0), c, sine_squared(c)));
}
