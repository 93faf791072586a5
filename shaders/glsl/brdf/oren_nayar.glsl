/// oren_nayar.glsl - rough diffuse surface of Lambertian facets. Registry name: oren_nayar.
///
/// value  f_r cos(theta_i) in 1/sr, a = the larger and b = the smaller of both polar angles, s2 = sigma^2. qualitative:
///        rho / pi (1 - s2 / (2 (s2 + 0.33)) + 0.45 s2 / (s2 + 0.09) max(0, cos(phi)) sin(a) tan(b)). full:
///        rho / pi (C1 + cos(phi) C2 tan(b) + (1 - |cos(phi)|) C3 tan((a + b) / 2))
///        + 0.17 rho^2 / pi s2 / (s2 + 0.13) (1 - cos(phi) (2 b / pi)^2), C1 as above,
///        C2 = 0.45 s2 / (s2 + 0.09) (sin(a) - (cos(phi) < 0 ? (2 b / pi)^3 : 0)),
///        C3 = 0.125 s2 / (s2 + 0.09) (4 a b / pi^2)^2; 0 where that is negative
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params diffuse  0..1      per channel, no unit: rho, reflectance of the facets
///        sigma    0..1.5708  rad: RMS slope angle of the facets
///        form     0 full, 1 qualitative
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Oren and Nayar, SIGGRAPH 1994
/// stable cos(phi) sin(a) tan(b) = dot(wi.xy, wo.xy) / max(wi.z, wo.z); tan((a + b) / 2) = (sin a + sin b) / (cos a + cos b);
///        1 - |cos(phi)| = sin^2(phi) / (1 + |cos(phi)|); angles from sine and cosine, never acos
/// error  relative, at most 2 x 2^-24 (4 t + c), t the ratio of the terms' sizes to their sum, c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/oren_nayar.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/numeric.glsl"

struct OrenNayarParams { vec3 diffuse; float sigma; int form; };

/// sin(a) - (2 b / pi)^3, from sines, cosines and b. Below 45 degrees as it stands, above as a difference from 1.
float oren_nayar_cut(float sin_a, float cos_a, float sin_b, float cos_b, float b)
{
    float x = 2.0 * INV_PI * b;
    float y = 2.0 * INV_PI * numeric_angle(sin_b, cos_b);  // 1 - x
    float high = y * (3.0 - y * (3.0 - y)) - cos_a * cos_a / (1.0 + sin_a);
    return sin_b < cos_b ? sin_a - x * x * x : high;
}

vec3 oren_nayar_f_cos(Dirs d, OrenNayarParams p)
{
    float sin_i = length(d.wi.xy);
    float sin_o = length(d.wo.xy);
    bool light_is_lower = d.wi.z < d.wo.z;
    float cos_a = max(min(d.wi.z, d.wo.z), 0.0);
    float cos_b = max(max(d.wi.z, d.wo.z), 1e-37);
    float sin_a = light_is_lower ? sin_i : sin_o;
    float sin_b = light_is_lower ? sin_o : sin_i;
    float products = dot(d.wi.xy, d.wo.xy);  // cos(phi) sin(a) sin(b)

    float s2 = p.sigma * p.sigma;
    float c1 = (0.5 * s2 + 0.33) / (s2 + 0.33);
    float k2 = s2 / (s2 + 0.09);
    float towards = d.wi.z / cos_b;  // 1 / cos(b) of tan(b), times cos(theta_i)

    // Only the full form needs the angles.
    float a = numeric_angle(cos_a, sin_a);
    float b = numeric_angle(cos_b, sin_b);
    float sines = max(sin_i * sin_o, 1e-37);
    float cos_phi = clamp(products / sines, -1.0, 1.0);
    float sin_phi = (d.wi.x * d.wo.y - d.wi.y * d.wo.x) / sines;
    float cut = products < 0.0 ? oren_nayar_cut(sin_a, cos_a, sin_b, cos_b, b) / max(sin_a, 1e-37) : 1.0;
    float ab = 4.0 * INV_PI * INV_PI * a * b;
    float across = min(sin_phi * sin_phi, 1.0) / (1.0 + abs(cos_phi)) * (0.125 * k2 * ab * ab);
    float tan_mean = (sin_a + sin_b) / (cos_a + cos_b);
    float xb = 2.0 * INV_PI * b;
    float between = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * xb * xb) * d.wi.z;

    float full = c1 * d.wi.z + 0.45 * k2 * products * towards * cut + across * (tan_mean * d.wi.z);
    float qualitative = c1 * d.wi.z + 0.45 * k2 * max(products, 0.0) * towards;
    vec3 f = p.form == 0 ? full + p.diffuse * between : vec3(qualitative);
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? INV_PI * p.diffuse * max(f, vec3(0.0)) : vec3(0.0);
}

vec3 oren_nayar_ambient(OrenNayarParams p) { return p.diffuse; }
float oren_nayar_roughness(OrenNayarParams p) { return 1.0; }

/// For lights with a body: what is reflected once, and between facets.
AreaWeights oren_nayar_area(OrenNayarParams p) { return AreaWeights(vec3(0.0), p.diffuse, p.diffuse * p.diffuse); }
