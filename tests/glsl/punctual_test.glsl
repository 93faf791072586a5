// Lights without extent.
#include "light/punctual.glsl"

/// @test attenuation_is_finite  @tag punctual
/// @in direction: unit_sphere
/// @in distance: log_uniform(1e-15, 1e18)
/// @in inv_range2: values(0, 1e-6, 1, 1e6)
void test_finite(vec3 direction, float distance, float inv_range2)
{
    PunctualGeometry g = punctual_geometry(direction * distance, inv_range2);
    check_finite(vec4(g.wi, g.attenuation));
    check(g.attenuation >= 0.0);
    check_abs(g.wi, direction, 1e-6);
}

/// @test attenuation_falls_with_the_square  @tag punctual
/// @in distance: log_uniform(1e-5, 1e10)
void test_square(float distance)
{
    float near = punctual_geometry(vec3(0.0, distance, 0.0), 0.0).attenuation;
    float far = punctual_geometry(vec3(0.0, 2.0 * distance, 0.0), 0.0).attenuation;
    check_near(near, 4.0 * far, 1e-6);
}

/// @test nothing_beyond_the_range  @tag punctual
/// @in distance: uniform(0.5, 3)
/// @expect bounded(0, 4)
/// @expect monotone decreasing in distance within 8 ulp
float test_range(float distance) { return punctual_geometry(vec3(0.0, 0.0, distance), 1.0).attenuation; }

/// @test a_light_at_the_point_lights_nothing  @tag punctual
/// @in inv_range2: values(0, 1)
/// @expect equals (0, 0, 0, 0)
vec4 test_at_the_point(float inv_range2)
{
    PunctualGeometry g = punctual_geometry(vec3(0.0), inv_range2);
    return vec4(g.wi, g.attenuation);
}

/// @test cones_are_between_0_and_1  @tag punctual
/// @in axis: unit_sphere
/// @in wi: unit_sphere
/// @in scale: log_uniform(1e-3, 1000)
/// @in offset: uniform(-1000, 1000)
/// @expect bounded(0, 1)
float test_cone(vec3 axis, vec3 wi, float scale, float offset) { return spot_attenuation(axis, wi, scale, offset); }
