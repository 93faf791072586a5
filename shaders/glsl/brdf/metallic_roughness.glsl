/// metallic_roughness.glsl - glTF's own model: diffuse base below a GGX lobe. Registry name: metallic_roughness.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = (1 - F) c_diff / pi + F D V, GGX with height-correlated Smith masking
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params base_color  0..1  per channel, no unit
///        metallic    0..1  no unit
///        roughness   0..1  no unit: alpha = roughness^2
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0. Roughness 0 is a mirror, which no point light can show: alpha is kept
///        above 1e-4 (roughness 0.01), where one rounding of a 32-bit direction already changes the lobe by 0.1 %
/// source Khronos, glTF 2.0 specification, appendix B.3; Walter et al., EGSR 2007; Heitz, JCGT 3(2), 2014
/// stable sin^2 and cos^2 of the half angle from h's components, never 1 - (n.h)^2; 1 - v.h from |wi - wo|;
///        1 - F as a product without cancellation; cos(theta_i) divided out of the visibility term
/// error  relative, at most 5 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md).
///        Where both cosines > 0.01 and f > 1e-6: < 4.2e-6 for alpha > 0.07, 6e-5 > 7e-3, 7e-4 > 7e-4, 3e-2
/// twin   engine/shading/brdf/metallic_roughness.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/dirs.glsl"

struct MetallicRoughnessParams { vec3 base_color; float metallic; float roughness; };

const float METALLIC_ROUGHNESS_MIN_ALPHA = 1e-4;

/// F D V cos(theta_i) without F.
float metallic_roughness_lobe(Dirs d, float alpha)
{
    float a2 = alpha * alpha;
    float x = dot(d.h.xy, d.h.xy);
    float y = d.h.z * d.h.z;
    float u = alpha * (x + y) / max(x + a2 * y, 1e-37);  // sqrt(pi D)
    float k = (1.0 - alpha) * (1.0 + alpha);
    float masking_o = sqrt(a2 + k * d.wo.z * d.wo.z);
    float masking_i = sqrt(a2 + k * d.wi.z * d.wi.z);
    return INV_TWO_PI * u * u / (masking_o + d.wo.z / d.wi.z * masking_i);
}

/// f_r cos(theta_i) of the base and of the lobe above it.
struct MetallicRoughnessParts { vec3 diffuse, specular; };

MetallicRoughnessParts metallic_roughness_parts(Dirs d, MetallicRoughnessParams p)
{
    float alpha = max(p.roughness * p.roughness, METALLIC_ROUGHNESS_MIN_ALPHA);
    // The max keeps compilers from seeing a mix here: as a + m (b - a) it would leave a dark metal 0.04 2^-24 of noise.
    float dielectric = max(1.0 - p.metallic, 0.0);
    vec3 f0 = 0.04 * dielectric + p.base_color * p.metallic;
    vec3 f90_minus_f0 = 0.96 * dielectric + (1.0 - p.base_color) * p.metallic;

    vec3 s = d.wi - d.wo;
    float vh = min(0.5 * sqrt(dot(d.h, d.h)), 1.0);
    float w = min(0.25 * dot(s, s) / (1.0 + vh), 1.0);  // 1 - vh
    float w2 = w * w;
    vec3 fresnel = f0 + f90_minus_f0 * (w2 * w2 * w);
    vec3 transmitted = f90_minus_f0 * (vh * (1.0 + w * (1.0 + w * (1.0 + w * (1.0 + w)))));  // 1 - fresnel

    return MetallicRoughnessParts(transmitted * p.base_color * (dielectric * INV_PI * d.wi.z),
                                  fresnel * metallic_roughness_lobe(d, alpha));
}

vec3 metallic_roughness_f_cos(Dirs d, MetallicRoughnessParams p)
{
    MetallicRoughnessParts parts = metallic_roughness_parts(d, p);
    vec3 f = parts.diffuse + parts.specular;
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

vec3 metallic_roughness_ambient(MetallicRoughnessParams p) { return p.base_color; }
float metallic_roughness_roughness(MetallicRoughnessParams p) { return p.roughness; }

/// For lights with a body: the base, and the terms of F = f0 (1 - S) + S.
AreaWeights metallic_roughness_area(MetallicRoughnessParams p)
{
    float dielectric = max(1.0 - p.metallic, 0.0);
    vec3 f0 = 0.04 * dielectric + p.base_color * p.metallic;
    return AreaWeights((1.0 - f0) * p.base_color * dielectric, f0, vec3(1.0));
}
