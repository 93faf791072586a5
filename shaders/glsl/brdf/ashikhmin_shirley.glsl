/// ashikhmin_shirley.glsl - anisotropic Phong lobe about the half vector over a diffuse base. Registry name: ashikhmin_shirley.
///
/// value  f_r cos(theta_i) in 1/sr, H = (L + V) / |L + V|,
///        f_r = 28 R_d / (23 pi) (1 - R_s) (1 - (1 - N.L / 2)^5) (1 - (1 - N.V / 2)^5)
///        + sqrt((nu + 1) (nv + 1)) / (8 pi) (N.H)^e F / (V.H max(N.L, N.V)),
///        e = (nu (H.X)^2 + nv (H.Y)^2) / (1 - (H.N)^2), F = R_s + (1 - R_s) (1 - V.H)^5
/// frame  Dirs d: local, z = shading normal, x = tangent (common/dirs.glsl)
/// params diffuse   0..1    per channel, no unit: R_d, reflectance of the base
///        specular  0..1    per channel, no unit: R_s, reflectance of the coat at normal incidence
///        nu        0..1e6  no unit: exponent along the turned tangent
///        nv        0..1e6  no unit: exponent across it
///        rotation  -7..7   rad: turns the tangent about the normal, counter-clockwise
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Ashikhmin and Shirley, JGT 5(2), 2000
/// stable (N.H)^e = exp(-(nu x^2 + nv y^2) / 2 log1p(t) / t), (x, y) the half vector's slope, t its square: no 0/0 at the peak;
///        1 - (1 - c / 2)^5 = c / 2 (1 + u + u^2 + u^3 + u^4), u = 1 - c / 2
/// error  relative, at most 3 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/ashikhmin_shirley.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/fresnel.glsl"
#include "common/half.glsl"
#include "common/numeric.glsl"

struct AshikhminShirleyParams { vec3 diffuse; vec3 specular; float nu; float nv; float rotation; };

/// 1 - (1 - c / 2)^5
float ashikhmin_shirley_through_coat(float c)
{
    float u = 1.0 - 0.5 * c;
    return 0.5 * c * (1.0 + u * (1.0 + u * (1.0 + u * (1.0 + u))));
}

/// The lobe without F, times cos(theta_i).
float ashikhmin_shirley_lobe(Dirs d, Half h, AshikhminShirleyParams p)
{
    vec2 turn = numeric_cos_sin(p.rotation);
    vec2 slope = vec2(turn.x * h.slope.x + turn.y * h.slope.y, turn.x * h.slope.y - turn.y * h.slope.x);
    float power = 0.5 * dot(vec2(p.nu, p.nv) * slope, slope) * numeric_log1p_ratio(h.tan2);
    float scale = sqrt((p.nu + 1.0) * (p.nv + 1.0)) * (0.125 * INV_PI);
    return numeric_exp(-power) * scale / h.vh * (d.wi.z / max(max(d.wi.z, d.wo.z), 1e-37));
}

vec3 ashikhmin_shirley_f_cos(Dirs d, AshikhminShirleyParams p)
{
    Half h = half_make(d);
    vec3 fresnel = fresnel_schlick(p.specular, h.vh, h.s2);
    float base = 28.0 / 23.0 * INV_PI * ashikhmin_shirley_through_coat(d.wi.z) * ashikhmin_shirley_through_coat(d.wo.z);
    vec3 f = p.diffuse * (1.0 - p.specular) * (base * d.wi.z) + fresnel * ashikhmin_shirley_lobe(d, h, p);
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

/// What coat and base reflect at normal incidence.
vec3 ashikhmin_shirley_ambient(AshikhminShirleyParams p) { return p.diffuse * (1.0 - p.specular) + p.specular; }

/// Roughness r of the isotropic lobe of as large a peak: r^4 = 2 / (n + 2), n + 1 = sqrt((nu + 1) (nv + 1)).
float ashikhmin_shirley_roughness(AshikhminShirleyParams p)
{
    return sqrt(sqrt(2.0 / (1.0 + sqrt((p.nu + 1.0) * (p.nv + 1.0)))));
}

/// For lights with a body: the base, and the terms of F = R_s (1 - S) + S.
AreaWeights ashikhmin_shirley_area(AshikhminShirleyParams p)
{
    return AreaWeights(p.diffuse * (1.0 - p.specular), p.specular, vec3(1.0));
}
