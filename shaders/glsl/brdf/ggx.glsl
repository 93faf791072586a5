/// ggx.glsl - microfacets with the slopes of Trowbridge and Reitz, masked as Smith does. Registry name: ggx.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = k_d / pi + k_s F D G / (4 cos(theta_i) cos(theta_o)),
///        D = 1 / (pi ax ay (hx^2 / ax^2 + hy^2 / ay^2 + hz^2)^2), G height-correlated
/// frame  Dirs d: local, z = shading normal, x = tangent (common/dirs.glsl)
/// params diffuse   0..1      per channel, no unit: k_d
///        specular  0..1      per channel, no unit: k_s
///        alpha_x   0.0001..1  no unit: width along the turned tangent
///        alpha_y   0.0001..1  no unit: width across it
///        rotation  -7..7     rad: turns the tangent about the normal, counter-clockwise
///        fresnel   0 schlick, 1 dielectric, 2 conductor
///        f0        0..1      per channel, no unit: reflectance at normal incidence
///        eta       0.01..20  per channel, no unit: index of refraction
///        k         0..20     per channel, no unit: extinction coefficient
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Trowbridge and Reitz, JOSA 65(5), 1975; Walter et al., EGSR 2007; Heitz, JCGT 3(2), 2014
/// stable sums of squares of the unnormalised half vector; masking by lengths of stretched vectors, without tangents
/// error  relative, at most 4 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/ggx.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/fresnel.glsl"
#include "common/half.glsl"
#include "common/numeric.glsl"

struct GgxParams { vec3 diffuse; vec3 specular; float alpha_x; float alpha_y; float rotation; int fresnel; vec3 f0; vec3 eta; vec3 k; };

/// `v` with its tangential part turned back by the angle whose cosine and sine are `turn`, and stretched by `alpha`.
vec3 ggx_stretched(vec3 v, vec2 turn, vec2 alpha)
{
    return vec3(alpha * vec2(turn.x * v.x + turn.y * v.y, turn.x * v.y - turn.y * v.x), v.z);
}

/// D G cos(theta_i) / (4 cos(theta_i) cos(theta_o))
float ggx_lobe(Dirs d, float alpha_x, float alpha_y, float rotation)
{
    vec2 turn = numeric_cos_sin(rotation);
    vec2 alpha = vec2(alpha_x, alpha_y);
    vec3 h = ggx_stretched(d.h, turn, 1.0 / alpha);
    float u = dot(d.h, d.h) / max(dot(h, h), 1e-37);
    float masking_i = length(ggx_stretched(d.wi, turn, alpha));
    float masking_o = length(ggx_stretched(d.wo, turn, alpha));
    return INV_TWO_PI * u * u / (alpha_x * alpha_y * (masking_o + d.wo.z / d.wi.z * masking_i));
}

vec3 ggx_f_cos(Dirs d, GgxParams p)
{
    Half h = half_make(d);
    vec3 fresnel = fresnel_reflectance(p.fresnel, p.f0, p.eta, p.k, h.vh, h.s2);
    vec3 f = p.diffuse * (INV_PI * d.wi.z) + p.specular * fresnel * ggx_lobe(d, p.alpha_x, p.alpha_y, p.rotation);
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

/// k_d, and what the lobe reflects at normal incidence.
vec3 ggx_ambient(GgxParams p) { return p.diffuse + p.specular * fresnel_normal_reflectance(p.fresnel, p.f0, p.eta, p.k); }

/// Roughness r of the isotropic lobe of as large a peak: r^2 = sqrt(ax ay).
float ggx_roughness(GgxParams p) { return sqrt(sqrt(p.alpha_x * p.alpha_y)); }

/// Lambert's part, and the lobe's weights for lights with a body.
AreaWeights ggx_area(GgxParams p) { return area_microfacet(p.diffuse, p.specular, p.fresnel, p.f0); }
