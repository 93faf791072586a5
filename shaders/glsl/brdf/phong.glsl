/// phong.glsl - cosine power about the mirrored direction. Registry name: phong.
///
/// value  f_r cos(theta_i) in 1/sr. classic: k_d cos(theta_i) + k_s (R.V)^n, without 1/pi and, in the specular term,
///        without cos(theta_i): as written in textbooks, not a BRDF in the strict sense.
///        energy: cos(theta_i) (k_d / pi + k_s (n + 2) / (2 pi) (R.V)^n)
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params ambient        0..1    per channel, no unit: k_a
///        diffuse        0..1    per channel, no unit: k_d
///        specular       0..1    per channel, no unit: k_s
///        shininess      0..1e6  no unit: n; 0 makes the lobe 1 everywhere, also where R.V < 0
///        normalization  0 classic, 1 energy
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Phong, CACM 18(6), 1975; energy: Lafortune and Willems, report CW 197, 1994
/// stable 1 - R.V = |R - V|^2 / 2 from components that do not cancel, then log1p: near 1, pow(R.V, n) loses
///        n 2^-25. Beyond R.V < 0.7 the dot product itself is the accurate one
/// error  relative, at most 2 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md).
///        Where both cosines > 0.01 and f > 1e-6: < 7.1e-6
/// twin   engine/shading/brdf/phong.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/numeric.glsl"

struct PhongParams { vec3 ambient; vec3 diffuse; vec3 specular; float shininess; int normalization; };

/// max(R.V, 0)^n
float phong_lobe(Dirs d, float n)
{
    float r_dot_v = d.wi.z * d.wo.z - dot(d.wi.xy, d.wo.xy);
    float dz = d.wi.z - d.wo.z;
    float deficit = 0.5 * (dot(d.h.xy, d.h.xy) + dz * dz);
    float near = numeric_two_atanh(-deficit / (2.0 - deficit));  // log1p(-deficit)
    float log_base = deficit < 0.3 ? near : numeric_log(max(r_dot_v, 1e-37));
    float power = r_dot_v > 0.0 ? numeric_exp(n * log_base) : 0.0;
    return n > 0.0 ? power : 1.0;
}

vec3 phong_f_cos(Dirs d, PhongParams p)
{
    bool energy = p.normalization == 1;
    vec3 diffuse = p.diffuse * (energy ? INV_PI * d.wi.z : d.wi.z);
    float scale = energy ? (p.shininess + 2.0) * INV_TWO_PI * d.wi.z : 1.0;
    vec3 f = diffuse + p.specular * (scale * phong_lobe(d, p.shininess));
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

vec3 phong_ambient(PhongParams p) { return p.ambient; }

/// Roughness r of the lobe of like width: r^4 = alpha^2 = 2 / (4 n + 2).
float phong_roughness(PhongParams p) { return sqrt(sqrt(1.0 / (2.0 * p.shininess + 1.0))); }

/// Lambert's part, and the lobe's weights for lights with a body.
AreaWeights phong_area(PhongParams p)
{
    return AreaWeights(p.diffuse * (p.normalization == 1 ? 1.0 : PI), p.specular, vec3(0.0));
}
