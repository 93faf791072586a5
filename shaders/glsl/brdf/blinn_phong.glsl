/// blinn_phong.glsl - cosine power about the half vector. Registry name: blinn_phong.
///
/// value  f_r cos(theta_i) in 1/sr. classic: k_d cos(theta_i) + k_s (N.H)^n, without 1/pi and, in the specular term,
///        without cos(theta_i): as written in textbooks, not a BRDF in the strict sense.
///        energy: cos(theta_i) (k_d / pi + k_s C(n) (N.H)^n), C(n) = (n + 2)(n + 4) / (8 pi (2^(-n/2) + n)), whose
///        lobe has albedo 1 at normal incidence for every n
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params ambient        0..1    per channel, no unit: k_a
///        diffuse        0..1    per channel, no unit: k_d
///        specular       0..1    per channel, no unit: k_s
///        shininess      0..1e6  no unit: n; 0 makes the lobe 1
///        normalization  0 classic, 1 energy
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0; L = -V (h = 0) lies in the horizon and gives 0
/// source Blinn, SIGGRAPH 1977
/// stable (N.H)^n = (1 + tan^2)^(-n/2) through log1p, tan = |h.xy| / h.z: near 1, pow(N.H, n) loses n 2^-25
/// error  relative, at most 2 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md).
///        Where both cosines > 0.01 and f > 1e-6: < 5.3e-6 for n < 900, 2.3e-4 for n < 9e4, 2.1e-3
/// twin   engine/shading/brdf/blinn_phong.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/numeric.glsl"

struct BlinnPhongParams { vec3 ambient; vec3 diffuse; vec3 specular; float shininess; int normalization; };

/// (N.H)^n
float blinn_phong_lobe(Dirs d, float n)
{
    vec2 slope = d.h.xy / max(d.h.z, 1e-18);  // its square stays finite
    float power = d.h.z > 0.0 ? numeric_exp(-0.5 * n * numeric_log1p(dot(slope, slope))) : 0.0;
    return n > 0.0 ? power : 1.0;
}

vec3 blinn_phong_f_cos(Dirs d, BlinnPhongParams p)
{
    bool energy = p.normalization == 1;
    float n = p.shininess;
    vec3 diffuse = p.diffuse * (energy ? INV_PI * d.wi.z : d.wi.z);
    float norm = (n + 2.0) * (n + 4.0) / (8.0 * PI * (numeric_exp(-0.346573590 * n) + n));
    vec3 f = diffuse + p.specular * ((energy ? norm * d.wi.z : 1.0) * blinn_phong_lobe(d, n));
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

vec3 blinn_phong_ambient(BlinnPhongParams p) { return p.ambient; }

/// Roughness r of the lobe of like width: r^4 = alpha^2 = 2 / (n + 2).
float blinn_phong_roughness(BlinnPhongParams p) { return sqrt(sqrt(2.0 / (p.shininess + 2.0))); }

/// Lambert's part, and the lobe's weights for lights with a body.
AreaWeights blinn_phong_area(BlinnPhongParams p)
{
    return AreaWeights(p.diffuse * (p.normalization == 1 ? 1.0 : PI), p.specular, vec3(0.0));
}
