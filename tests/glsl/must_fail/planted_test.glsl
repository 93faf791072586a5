// Faults planted on purpose: each must be found. Nothing here may pass.
#include "brdf/lambert.glsl"

// What the compiler can't see through: x is never that large.
float hidden_zero(float x) { return x > 1e30 ? 1.0 : 0.0; }

/// @test planted_nan  @tag planted
/// @in x: uniform(0, 1)
/// @expect finite
/// @must_fail 0 / 0 near 0.5
float planted_nan(float x) { return abs(x - 0.5) < 0.001 ? hidden_zero(x) / hidden_zero(x) : x; }

/// @test planted_nan_is_not_bounded  @tag planted
/// @in x: uniform(0, 1)
/// @expect bounded(-inf, inf)
/// @must_fail NaN is within no bounds
float planted_nan_bounded(float x) { return planted_nan(x); }

/// @test planted_nan_is_not_near  @tag planted
/// @in x: uniform(0, 1)
/// @must_fail NaN is near nothing
void planted_nan_near(float x) { check_abs(planted_nan(x), x, 1e30); }

/// @test planted_nan_is_not_less  @tag planted
/// @in x: uniform(0, 1)
/// @must_fail NaN is less than nothing
void planted_nan_less(float x) { check_less_equal(planted_nan(x), 2.0); }

/// @test planted_infinity  @tag planted
/// @in x: uniform(0, 1)
/// @expect finite
/// @must_fail 1 / 0 where x is 1
float planted_infinity(float x) { return 1.0 / (1.0 - x); }

/// @test planted_infinity_is_found_by_checks  @tag planted
/// @in x: uniform(0, 1)
/// @must_fail 1 / 0 where x is 1
void planted_infinity_check(float x) { check_finite(planted_infinity(x)); }

/// @test planted_infinite_input  @tag planted
/// @in x: special(inf)
/// @expect finite
/// @must_fail infinity must arrive as it is
float planted_input(float x) { return x; }

/// @test planted_nan_input  @tag planted
/// @in x: values(bits(0x7fc00001))
/// @expect finite
/// @must_fail NaN must arrive as it is
float planted_nan_input(float x) { return x; }

/// @test planted_one_ulp  @tag planted
/// @in x: uniform(0.5, 2)
/// @expect equals itself
/// @must_fail one unit in the last place is a difference
float planted_one_ulp(float x) { return uintBitsToFloat(floatBitsToUint(x) + 1u); }
float itself(float x) { return x; }

/// @test planted_two_ulp_of_one  @tag planted
/// @in x: uniform(0.5, 2)
/// @must_fail two units are more than one
void planted_two_ulp(float x) { check_ulp(uintBitsToFloat(floatBitsToUint(x) + 2u), x, 1); }

/// @test planted_wrong_sign  @tag planted
/// @in x: log_uniform(1e-30, 1e-10)
/// @expect equals itself within rel 1
/// @must_fail tiny and negative is not tiny and positive
float planted_sign(float x) { return -x; }

/// @test planted_negative_zero_is_equal_but_its_inverse_is_not  @tag planted
/// @in x: values(0)
/// @expect equals inf
/// @must_fail 1 / -0 is -inf
float planted_zero(float x) { return 1.0 / -x; }

/// @test planted_step_down  @tag planted
/// @in x: uniform(0, 1)
/// @expect monotone increasing
/// @must_fail falls by a hundredth at 0.7
float planted_step(float x) { return x - (x > 0.7 ? 0.01 : 0.0); }

/// @test planted_plateau  @tag planted
/// @in x: uniform(0, 1)
/// @expect monotone strictly increasing
/// @must_fail constant below 0.1
float planted_plateau(float x) { return max(x, 0.1); }

/// @test planted_monotone_in_the_other_direction  @tag planted
/// @in x: grid(0, 1, 64)
/// @expect monotone decreasing
/// @must_fail it rises
float planted_rise(float x) { return x; }

/// @test planted_out_of_bounds  @tag planted
/// @in v: unit_sphere
/// @expect bounded(-1, 0.999)
/// @must_fail axes reach 1
vec3 planted_bounds(vec3 v) { return v; }

/// @test planted_constant  @tag planted
/// @in x: values(3)
/// @expect equals 4 within 1 ulp or rel 0.1 or abs 0.5
/// @must_fail 3 is not 4 by any of these
float planted_constant(float x) { return x; }

/// @test planted_column  @tag planted
/// @in x: csv("squares.csv", x)
/// @expect equals csv("squares.csv", square) within 1 ulp
/// @must_fail the last row is wrong
float planted_column(float x) { return x * x; }

/// @test planted_false  @tag planted
/// @in i: uniform(0, 1000)
/// @must_fail 777 is not even
bool planted_false(int i) { return i != 777; }

/// @test planted_in_vertex_shader  @tag planted  @stage vertex
/// @in x: uniform(0, 1)
/// @expect bounded(0, 0.5)
/// @must_fail found in the vertex stage too
float planted_vertex(float x) { return x; }

/// 8 x 2^-24 x 16 is 7.6e-6: the derived tolerance finds a hundred-thousandth.
/// @test planted_wrong_twin  @tag planted
/// @expect twin lambert
/// @must_fail too bright by 1e-5
vec3 planted_twin(Dirs d, LambertParams p) { return lambert_f_cos(d, p) * 1.00001; }

/// @test planted_asymmetry  @tag planted  @model lambert
/// @must_fail brighter to one side
void planted_asymmetry(Dirs d, LambertParams p)
{
    vec3 there = lambert_f_cos(d, p) / d.wi.z * (d.wi.x > 0.9 ? 1.001 : 1.0);
    vec3 back = lambert_f_cos(Dirs(d.wo, d.wi, d.h), p) / d.wo.z * (d.wo.x > 0.9 ? 1.001 : 1.0);
    check_near(there, back, 1e-6);
}
