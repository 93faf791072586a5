/// airlight.glsl - light of a lamp that homogeneous fog scatters once into a ray.
///
/// value  airlight_at: integrand per unit of the arc, in 1/sr; times scattering (1/m), radiant intensity (W/sr), the arc's
///        length and 1 / h it is radiance
/// frame  positions relative to the ray's start, world axes; direction unit
/// params extinction 1/m; anisotropy g, -0.999..0.999; inv_range2 1 / range^2 in 1/m^2, 0: no range;
///        cut: metres by which the way over a point may be longer than the straight one before nothing arrives
/// domain distances 1e-15..1e18 m, the ray's length to infinity; never NaN, never negative. Rays pass no nearer to the
///        light than AIRLIGHT_NEAREST
/// source Kulla and Fajardo, Importance Sampling Techniques for Path Tracing in Participating Media, EGSR 2012: with equal
///        angles about the light 1 / r^2 is gone; Henyey and Greenstein, 1941
/// stable all lengths by the law of sines from angles that are sums of positive ones; the smaller of an angle and its
///        supplement; 1 - cos from sines of half angles
/// error  with 8 nodes 2e-3 of point lights and 7e-4 of spots on average, g from -0.9 to 0.9; with 64, 5e-6 and 1.4e-5
///        (tests/shading/airlight_test.cpp)
/// twin   engine/shading/fog.cpp
#include "common/constants.glsl"
#include "common/numeric.glsl"
#include "light/punctual.glsl"

const float AIRLIGHT_NEAREST = 1e-6;

/// A way as seen from the light: a triangle of start, end and light.
struct AirlightArc {
    float h;            // distance from the light to the ray's line
    float r;            // from the light to the start
    float start_angle;  // at the start, between the ray and the way to the light
    float end_angle;    // at the end, between the way back and the way to the light
    float width;        // at the light, between start and end
    float from, to;     // the part that counts, of 0..width
    vec3 aside;         // unit, from the ray's line to the light
};

/// The angle of (x, y) for y >= 0, in 0..pi.
float airlight_angle(float x, float y) { return x >= 0.0 ? numeric_angle(x, y) : PI - numeric_angle(-x, y); }

/// The part of an arc within `half_width` of `center`, an angle from -pi to pi from its start.
void airlight_clip(inout AirlightArc arc, float center, float half_width)
{
    // Of the angles that differ by a turn, the one next to the arc's middle.
    center += center < 0.5 * arc.width - PI ? TWO_PI : 0.0;
    arc.from = max(arc.from, center - half_width);
    arc.to = max(arc.from, min(arc.to, center + half_width));
}

AirlightArc airlight_arc(vec3 to_light, vec3 direction, float distance, float cut, float inv_range2)
{
    AirlightArc arc;
    float p = dot(to_light, direction);
    vec3 aside = to_light - p * direction;
    float off = length(cross(to_light, direction));
    arc.h = max(off, AIRLIGHT_NEAREST);
    arc.aside = aside * (1.0 / max(length(aside), 1e-30));
    arc.r = length(vec2(p, arc.h));
    // Where the way over a point of the ray is longer than the straight one by `cut`.
    float end = min(distance, 0.5 * cut * ((2.0 * arc.r + cut) / (arc.r - p + cut)));
    float rest = end - p;
    float r_end = length(vec2(rest, arc.h));
    float cos_start = p / arc.r, sin_start = arc.h / arc.r;
    float cos_end = rest / r_end, sin_end = arc.h / r_end;
    arc.start_angle = airlight_angle(cos_start, sin_start);
    arc.end_angle = airlight_angle(cos_end, sin_end);
    arc.width = airlight_angle(sin_start * sin_end - cos_start * cos_end, sin_start * (end / r_end));
    arc.from = 0.0;
    arc.to = arc.width;
    // The range is a sphere: its part of the ray lies about the point nearest to the light.
    float share2 = arc.h * arc.h * inv_range2;
    float reach = inv_range2 > 0.0 ? numeric_angle(arc.h * sqrt(inv_range2), sqrt(max(1.0 - share2, 0.0))) : HALF_PI;
    airlight_clip(arc, HALF_PI - arc.start_angle, share2 < 1.0 ? reach : 0.0);
    return arc;
}

/// A spot's cone in the plane of ray and light: a wedge.
struct AirlightWedge {
    float middle;  // angle from the arc's start
    float shadow;  // length of the axis's projection into the plane
    float out2;    // square of what of the axis stands out of the plane
};

/// Clips the arc to the cone. `opening` is 1 - cos of the outer angle.
AirlightWedge airlight_wedge(inout AirlightArc arc, vec3 direction, vec3 axis, float opening)
{
    AirlightWedge wedge;
    float along = dot(axis, direction);
    float across = dot(axis, arc.aside);
    float out_of_plane = dot(axis, cross(direction, arc.aside));
    wedge.out2 = out_of_plane * out_of_plane;
    wedge.shadow = length(vec2(along, across));
    // The way to the start is turned by start_angle from the reverse of the ray, towards the light.
    vec2 turn = numeric_cos_sin(arc.start_angle);
    float c = turn.x, s = turn.y;
    float x = -along * c - across * s;
    float y = along * s - across * c;
    wedge.middle = y < 0.0 ? -airlight_angle(x, -y) : airlight_angle(x, y);
    float sin2 = opening * (2.0 - opening);
    float half_width = numeric_angle(1.0 - opening, sqrt(max(sin2 - wedge.out2, 0.0)));
    airlight_clip(arc, wedge.middle, wedge.out2 < sin2 ? half_width : 0.0);
    return wedge;
}

/// (1 - g^2) / (4 pi (1 + g^2 - 2 g c)^(3/2)) with 1 - c and 1 + c of the cosine c of scattering.
float airlight_phase(float one_minus_c, float one_plus_c, float anisotropy)
{
    float g = abs(anisotropy);
    float q = (1.0 - g) * (1.0 - g) + 2.0 * g * (anisotropy < 0.0 ? one_plus_c : one_minus_c);
    return (1.0 - g) * (1.0 + g) * INV_FOUR_PI / (q * sqrt(q));
}

/// Where a share of the arc's part ends: the ways, and the phase function.
struct AirlightPoint {
    float angle;   // from the arc's start
    float r;       // to the light
    float way;     // light - point - start
    float phase;   // 1/sr
};

AirlightPoint airlight_point(AirlightArc arc, float share, float anisotropy)
{
    AirlightPoint point;
    point.angle = mix(arc.from, arc.to, share);
    float ahead = arc.start_angle + point.angle;
    float behind = arc.end_angle + (arc.width - point.angle);
    float half_angle = 0.5 * min(ahead, behind);
    vec2 turn = numeric_cos_sin(half_angle);
    float c = turn.x, s = turn.y;
    float inv_sine = 1.0 / max(2.0 * s * c, 1e-30);
    point.r = arc.h * inv_sine;
    point.way = point.r + arc.r * numeric_cos_sin(point.angle).y * inv_sine;
    float near = 2.0 * s * s, far = 2.0 * c * c;
    // Light goes on straight where it comes from behind the point, as seen from the start.
    point.phase = ahead < behind ? airlight_phase(near, far, anisotropy) : airlight_phase(far, near, anisotropy);
    return point;
}

/// spot_attenuation of a point; scale and offset as there.
float airlight_cone(AirlightWedge wedge, float angle, float scale, float offset)
{
    float s = numeric_cos_sin(0.5 * (angle - wedge.middle)).y;
    float one_minus_cos = wedge.out2 / (1.0 + wedge.shadow) + 2.0 * wedge.shadow * s * s;
    float t = clamp(offset - scale * one_minus_cos, 0.0, 1.0);
    return t * t;
}

/// e^(-extinction way); AIRLIGHT_GREY: alike in all channels.
vec3 airlight_dimming(vec3 extinction, float way)
{
#ifdef AIRLIGHT_GREY
    return vec3(numeric_exp(-extinction.x * way));
#else
    return vec3(numeric_exp(-extinction.x * way), numeric_exp(-extinction.y * way), numeric_exp(-extinction.z * way));
#endif
}
