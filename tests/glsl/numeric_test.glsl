// Properties of common/numeric.glsl. Its error bounds against double are in tests/shading/glsl_basics_test.cpp.
#include "common/numeric.glsl"

/// @test exp_is_positive_and_finite  @tag numeric
/// @in x: any
/// @expect finite
/// @expect bounded(0, 1.7e38)
float test_exp(float x) { return numeric_exp(x); }

/// @test exp_grows  @tag numeric
/// @in x: uniform(-90, 90)
/// @expect monotone increasing within 4 ulp
float test_exp_grows(float x) { return numeric_exp(x); }

/// @test exp_of_0_is_1  @tag numeric
/// @in x: values(0, -0)
/// @expect equals 1
float test_exp_of_0(float x) { return numeric_exp(x); }

/// @test log_grows  @tag numeric
/// @in x: log_uniform(1.2e-38, 3e38)
/// @expect finite
/// @expect monotone increasing within 4 ulp or abs 1e-7
float test_log_grows(float x) { return numeric_log(x); }

/// @test log_of_1_is_0  @tag numeric
/// @in x: values(1)
/// @expect equals 0
float test_log_of_1(float x) { return numeric_log(x); }

/// @test log_is_finite_everywhere  @tag numeric
/// @in x: special(positive, inf)
/// @expect finite
float test_log_special(float x) { return numeric_log(x); }

/// @test exp_undoes_log  @tag numeric
/// @in x: log_uniform(1e-30, 1e30)
void test_exp_log(float x)
{
    float y = numeric_log(x);
    check_near(numeric_exp(y), x, 5e-7 * (1.0 + abs(y)));
}

/// @test log1p_grows  @tag numeric
/// @in x: log_uniform(1e-30, 1e30)
/// @expect monotone increasing within 4 ulp
float test_log1p_grows(float x) { return numeric_log1p(x); }

/// Near 0 log1p(x) is x - x^2 / 2.
/// @test log1p_near_0  @tag numeric
/// @in x: log_uniform(1e-30, 1e-4)
/// @expect equals log1p_series within rel 3e-7
float test_log1p_near_0(float x) { return numeric_log1p(x); }
float log1p_series(float x) { return x * (1.0 - x * 0.5); }

/// @test log1p_is_finite_above_minus_1  @tag numeric
/// @in x: uniform(-0.99999994, 100)
/// @expect finite
float test_log1p_finite(float x) { return numeric_log1p(x); }

/// @test pow_of_1  @tag numeric
/// @in y: uniform(-1000, 1000)
/// @expect equals 1
float test_pow_of_1(float y) { return numeric_pow(1.0, y); }

/// @test pow_is_finite  @tag numeric
/// @in x: uniform(0, 1)
/// @in y: log_uniform(1e-3, 1e6)
/// @expect bounded(0, 1.0000001)
float test_pow_finite(float x, float y) { return numeric_pow(x, y); }

/// @test cos_sin_has_length_1  @tag numeric
/// @in x: uniform(-1000, 1000)
void test_cos_sin(float x) { check_near(length(numeric_cos_sin(x)), 1.0, 5e-7); }

/// @test cos_is_even_sin_is_odd  @tag numeric
/// @in x: uniform(0, 1000)
void test_cos_sin_symmetry(float x)
{
    vec2 there = numeric_cos_sin(x);
    vec2 back = numeric_cos_sin(-x);
    check_abs(there, vec2(back.x, -back.y), 4e-7);
}

/// @test angle_grows_with_y  @tag numeric
/// @in x: log_uniform(1e-10, 1e10)
/// @in y: log_uniform(1e-10, 1e10)
/// @expect bounded(0, 1.5707965)
/// @expect monotone increasing in y within 8 ulp
float test_angle(float x, float y) { return numeric_angle(x, y); }

/// @test angle_of_axes  @tag numeric
/// @in x: values(0, 1)
/// @in y: values(0)
/// @expect equals 0
float test_angle_of_x_axis(float x, float y) { return numeric_angle(x, y); }

/// @test erfc_falls  @tag numeric
/// @in x: uniform(0, 9)
/// @expect bounded(0, 1.0000002)
/// @expect monotone decreasing within rel 1e-6
float test_erfc(float x) { return numeric_erfc(x); }
