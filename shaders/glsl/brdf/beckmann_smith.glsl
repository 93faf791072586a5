/// beckmann_smith.glsl - microfacets with Beckmann's slopes, masked as Smith does. Registry name: beckmann_smith.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = k_d / pi + k_s F D G / (4 cos(theta_i) cos(theta_o)), D normalised Beckmann,
///        G = 1 / (1 + Lambda_i + Lambda_o) (correlated) or 1 / ((1 + Lambda_i)(1 + Lambda_o)) (separable),
///        Lambda = (exp(-x^2) / (x sqrt(pi)) - erfc(x)) / 2, x = 1 / (m tan(theta))
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params diffuse   0..1      per channel, no unit: k_d
///        specular  0..1      per channel, no unit: k_s
///        m         1e-05..10  no unit: slope of the facets, sqrt(2) times their RMS slope along one direction
///        masking   0 correlated, 1 separable
///        fresnel   0 schlick, 1 dielectric, 2 conductor
///        f0        0..1      per channel, no unit: reflectance at normal incidence
///        eta       0.01..20  per channel, no unit: index of refraction
///        k         0..20     per channel, no unit: extinction coefficient
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Walter et al., EGSR 2007; Heitz, JCGT 3(2), 2014
/// stable cos(theta) Lambda has no division by cos(theta); tan(theta_h) = |h.xy| / h.z
/// error  relative, at most 3 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/beckmann_smith.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/fresnel.glsl"
#include "common/half.glsl"
#include "common/numeric.glsl"

struct BeckmannSmithParams { vec3 diffuse; vec3 specular; float m; int masking; int fresnel; vec3 f0; vec3 eta; vec3 k; };

/// cos(theta) Lambda for the direction w above the surface.
float beckmann_smith_cos_lambda(vec3 w, float m)
{
    float spread = m * length(w.xy);
    float x = min(w.z / max(spread, 1e-30), 10.0);  // Lambda(10) is 0 in floats
    return 0.5 * max(0.564189584 * spread * numeric_exp(-x * x) - w.z * numeric_erfc(x), 0.0);
}

/// D G cos(theta_i) / (4 cos(theta_i) cos(theta_o))
float beckmann_smith_lobe(Dirs d, Half h, float m, int masking)
{
    float q = min(1.0 + h.tan2, 1e9);
    float distribution = INV_PI * q * q / (m * m) * numeric_exp(-h.tan2 / (m * m));
    float li = beckmann_smith_cos_lambda(d.wi, m) / d.wi.z;
    float lo = beckmann_smith_cos_lambda(d.wo, m);
    float masked = masking == 0 ? d.wo.z + lo + d.wo.z * li : (d.wo.z + lo) * (1.0 + li);
    return 0.25 * distribution / masked;
}

vec3 beckmann_smith_f_cos(Dirs d, BeckmannSmithParams p)
{
    Half h = half_make(d);
    vec3 fresnel = fresnel_reflectance(p.fresnel, p.f0, p.eta, p.k, h.vh, h.s2);
    vec3 f = p.diffuse * (INV_PI * d.wi.z) + p.specular * fresnel * beckmann_smith_lobe(d, h, p.m, p.masking);
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

/// k_d, and what the lobe reflects at normal incidence.
vec3 beckmann_smith_ambient(BeckmannSmithParams p)
{
    return p.diffuse + p.specular * fresnel_normal_reflectance(p.fresnel, p.f0, p.eta, p.k);
}

/// Roughness r of the lobe of like width: r^2 = m.
float beckmann_smith_roughness(BeckmannSmithParams p) { return sqrt(min(p.m, 1.0)); }

/// Lambert's part, and the lobe's weights for lights with a body.
AreaWeights beckmann_smith_area(BeckmannSmithParams p) { return area_microfacet(p.diffuse, p.specular, p.fresnel, p.f0); }
