/// cook_torrance.glsl - microfacets with Beckmann's slopes and masking in V-grooves. Registry name: cook_torrance.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = k_d / pi + k_s F D G / (4 cos(theta_i) cos(theta_o)), D normalised:
///        D = exp(-tan^2(theta_h) / m^2) / (pi m^2 cos^4(theta_h)), G = min(1, 2 N.H N.V / V.H, 2 N.H N.L / V.H)
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params diffuse   0..1      per channel, no unit: k_d
///        specular  0..1      per channel, no unit: k_s
///        m         1e-05..10  no unit: slope of the facets, sqrt(2) times their RMS slope along one direction
///        fresnel   0 schlick, 1 dielectric, 2 conductor
///        f0        0..1      per channel, no unit: reflectance at normal incidence
///        eta       0.01..20  per channel, no unit: index of refraction
///        k         0..20     per channel, no unit: extinction coefficient
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Cook and Torrance, SIGGRAPH 1981 and ACM TOG 1(1), 1982
/// stable G / (4 N.V) = min(1 / (4 N.V), N.L (N.L + N.V) / (max(N.L, N.V) |h|^2)) with h = wi + wo: no factor can be 0/0;
///        tan(theta_h) = |h.xy| / h.z
/// error  relative, at most 3 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/cook_torrance.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/fresnel.glsl"
#include "common/half.glsl"
#include "common/numeric.glsl"

struct CookTorranceParams { vec3 diffuse; vec3 specular; float m; int fresnel; vec3 f0; vec3 eta; vec3 k; };

/// D of Beckmann's distribution with slope m; 0 far out, where it is below 1e-37 of its peak.
float cook_torrance_distribution(Half h, float m)
{
    float q = min(1.0 + h.tan2, 1e9);  // 1 / cos^2(theta_h)
    return INV_PI * q * q / (m * m) * numeric_exp(-h.tan2 / (m * m));
}

/// G cos(theta_i) / (4 cos(theta_i) cos(theta_o))
float cook_torrance_masking(Dirs d, Half h)
{
    float li = d.wi.z;
    float lo = d.wo.z;
    return min(0.25 / lo, li / max(li, lo) * ((li + lo) / h.h2));
}

vec3 cook_torrance_f_cos(Dirs d, CookTorranceParams p)
{
    Half h = half_make(d);
    vec3 fresnel = fresnel_reflectance(p.fresnel, p.f0, p.eta, p.k, h.vh, h.s2);
    float lobe = cook_torrance_distribution(h, p.m) * cook_torrance_masking(d, h);
    vec3 f = p.diffuse * (INV_PI * d.wi.z) + p.specular * fresnel * lobe;
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

/// k_d, and what the lobe reflects at normal incidence.
vec3 cook_torrance_ambient(CookTorranceParams p)
{
    return p.diffuse + p.specular * fresnel_normal_reflectance(p.fresnel, p.f0, p.eta, p.k);
}

/// Roughness r of the lobe of like width: r^2 = m.
float cook_torrance_roughness(CookTorranceParams p) { return sqrt(min(p.m, 1.0)); }

/// Lambert's part, and the lobe's weights for lights with a body.
AreaWeights cook_torrance_area(CookTorranceParams p) { return area_microfacet(p.diffuse, p.specular, p.fresnel, p.f0); }
