#include "colour.glsl"

/// Drivers' pow() is good to a few 1e-6 only.
/// @test round_trip  @tag srgb
/// @in c: uniform(0, 1)
void test_round_trip(vec3 c) { check_abs(linear_from_srgb(srgb_from_linear(c)), c, 2e-5); }

/// @test stays_in_range  @tag srgb
/// @in c: uniform(0, 1)
/// @expect bounded(0, 1.00001)
vec3 test_range(vec3 c) { return srgb_from_linear(c); }

/// Both pieces meet, to the 5e-7 by which the standard's rounded constants miss each other.
/// @test brighter_stays_brighter  @tag srgb
/// @in x: uniform(0, 1)
/// @expect monotone increasing within abs 2e-6
float test_monotone(float x) { return linear_from_srgb(vec3(x)).g; }

/// @test grey_keeps_its_value
/// @in x: special(positive)
/// @in scale: values(1, 0.5)
void test_grey(float x, float scale)
{
    assume(x < 1e30);
    check_near(luminance(vec3(x * scale)), x * scale, 1e-6);
}

/// @test known_codes
/// @in code: csv("srgb.csv", code)
/// @expect equals csv("srgb.csv", linear) within rel 1e-5
float test_codes(float code) { return linear_from_srgb(vec3(code / 255.0)).r; }
