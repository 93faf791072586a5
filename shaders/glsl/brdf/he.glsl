/// he.glsl - wave optics of a rough surface: specular spike, directional-diffuse and uniform-diffuse part. Registry name: he.
///
/// value  f_r cos(theta_i) in 1/sr without the spike, which shows no light without extent: f_r = a / pi + rho_dd,
///        rho_dd = F / pi (|h|^2 / (N.L + N.V))^2 S D / (N.L N.V), h = L + V,
///        D = pi^2 tau^2 / (4 lambda^2) sum over m of g^m exp(-g) / (m! m) exp(-q / m), q = (pi tau |h.xy| / lambda)^2,
///        g = (2 pi sigma (N.L + N.V) / lambda)^2. he_mirror() is the reflectance of the spike, F exp(-g) S
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params diffuse     0..1       per channel, no unit: a, the uniform-diffuse reflectance
///        sigma       0..1000    m: RMS height; as seen from a direction it shrinks to sigma / sqrt(1 + W0(K^2 / (8 pi)))
///        tau         1e-09..1000  m: autocorrelation length; 2 sigma / tau is Beckmann's slope
///        wavelength  1e-09..1000  m, per channel
///        fresnel     0 schlick, 1 dielectric, 2 conductor
///        f0          0..1       per channel, no unit: reflectance at normal incidence
///        eta         0.01..20   per channel, no unit: index of refraction
///        k           0..20      per channel, no unit: extinction coefficient
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0; values above 1e37 become 1e37
/// source He, Torrance, Sillion and Greenberg, SIGGRAPH 1991; Lambda with the factor exp(-x^2) that the print leaves out
/// stable the paper's polarisation factors cancel to (|h|^2 / (N.L + N.V))^2, which has no 0/0; the series is summed
///        about its largest term, in steps of its width where it is wide (exact to exp(-2 pi^2)), its terms by
///        Loader's saddle-point form of the Poisson probabilities; z0 by Lambert's W
/// error  relative, at most 8 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/he.cpp
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/fresnel.glsl"
#include "common/half.glsl"
#include "common/numeric.glsl"

struct HeParams { vec3 diffuse; float sigma; float tau; vec3 wavelength; int fresnel; vec3 f0; vec3 eta; vec3 k; };

/// Lambert's W0(x) for x >= 0: Halley's iteration.
float he_lambert_w(float x)
{
    float l = numeric_log1p(x);
    float w = l * (1.0 - numeric_log1p(l) / (2.0 + l));
    for (int i = 0; i < 3; ++i) {
        // (w - x exp(-w)) / (w + 1), and Halley's correction of it
        float t = w - x * numeric_exp(-w);
        float w1 = w + 1.0;
        w -= t / (w1 - (w + 2.0) * t / (2.0 * w1));
    }
    return max(w, 0.0);
}

/// ln m! - (m + 1/2) ln m + m - ln(2 pi) / 2: the error of Stirling's formula.
float he_stirling_error(float m)
{
    const float small[8] = float[8](0.0, 0.0810614668, 0.0413406960, 0.0276779257, 0.0207906721, 0.0166446912, 0.0138761288,
                                    0.0118967099);
    float r = 1.0 / m;
    return m < 7.5 ? small[int(m)] : r * (1.0 / 12.0 - r * r * (1.0 / 360.0 - r * r / 1260.0));
}

/// g - m + m ln(m / g), which is 0 at m = g, from `difference` = g - m.
float he_deviance(float m, float g, float difference)
{
    float x = difference / m;
    float s = x / (2.0 + x);
    float s2 = s * s;
    float near = m * (x * s - 2.0 * s * s2 * (1.0 / 3.0 + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0 + s2 / 11.0)))));
    return abs(x) < 0.3 ? near : difference + m * numeric_log(m / max(g, 1e-37));
}

/// The exponent E of the series' term at m, exp(-E) / (m sqrt(2 pi m)).
float he_exponent(float m, float g, float difference, float q)
{
    return he_stirling_error(m) + he_deviance(m, g, difference) + q / m;
}

/// `factor` t^2 times the sum over m >= 1 of g^m exp(-g) / (m! m) exp(-q / m), g = root_g^2. The factors are given along because the
/// sum may be too small for a float where the product is not.
float he_series(float factor, float t, float root_g, float q)
{
    float g = min(root_g * root_g, 1e30);
    if (g < 1e-30) {  // one term, whose g alone a float may not hold
        float root = t * numeric_exp(-0.5 * q) * root_g;
        return root * (root * factor);
    }
    if (g > 1e7) {  // many terms: exp(-q / m) / m about m = g, with the second moment of the distribution
        float u = q / g;
        float root = t / root_g * numeric_exp(-0.5 * u);
        return root > 0.0 ? root * (root * (factor * (1.0 + (0.5 * u * u - 2.0 * u + 1.0) / g))) : 0.0;
    }
    // The largest term: ln(g / m) + q / m^2 = 0, nearly.
    float g2 = max(g * g, 1e-37);
    float peak = g * numeric_exp(0.5 * min(he_lambert_w(min(2.0 * q / g2, 1e37)), 80.0)) - 1.0;
    float centre = max(floor(min(peak, 1.6e7) + 0.5), 1.0);
    float width = sqrt(1.0 / (1.0 / centre + 2.0 * q / (centre * centre * centre)));
    float step_ = centre > 25.0 ? max(floor(width), 1.0) : 1.0;
    float reach = 9.0 * width + 8.0;
    float first = centre - step_ * floor(min(reach, centre - 1.0) / step_);
    float largest = he_exponent(centre, g, g - centre, q);
    float sum = 0.0;
    for (int i = 0; i < 80; ++i) {
        float m = first + step_ * float(i);
        if (m > centre + reach)
            break;
        float difference = (g - centre) - (m - centre);
        sum += numeric_exp(largest - he_exponent(m, g, difference, q)) / (m * sqrt(m));
    }
    // exp(-largest), where it is the first term without the logarithm of a small g; 1.58 is (2 pi)^(1/4)
    float root = centre < 1.5 ? 1.58323349 * t * root_g * numeric_exp(-0.5 * (g + q)) : t * numeric_exp(-0.5 * largest);
    return root > 0.0 ? root * (root * (factor * (sum * step_ * 0.398942280))) : 0.0;  // 1 / sqrt(2 pi)
}

/// What depends on one direction w above the surface, for slope m = 2 sigma / tau.
struct HeDirection {
    float k;         // tan(theta) erfc(cot(theta) / m)
    float s_by_cos;  // S1(theta) / cos(theta)
};

HeDirection he_direction(vec3 w, float m)
{
    float sine = length(w.xy);
    float spread = max(m * sine, 1e-30);
    float x = min(w.z / spread, 10.0);
    float e = numeric_erfc(x);
    float cos_lambda = 0.5 * max(0.564189584 * m * sine * numeric_exp(-x * x) - w.z * e, 0.0);
    return HeDirection(min(sine / max(w.z, 1e-18), 1e18) * e, (1.0 - 0.5 * e) / (w.z + cos_lambda));
}

vec3 he_f_cos(Dirs d, HeParams p)
{
    float slope = 2.0 * p.sigma / p.tau;
    HeDirection i = he_direction(d.wi, slope);
    HeDirection o = he_direction(d.wo, slope);
    float k = i.k + o.k;
    float sigma = p.sigma / sqrt(1.0 + he_lambert_w(k * k * (0.25 * INV_TWO_PI)));
    float cosines = d.wi.z + d.wo.z;
    Half h = half_make(d);
    vec3 fresnel = fresnel_reflectance(p.fresnel, p.f0, p.eta, p.k, h.vh, h.s2);

    // (|h|^2 / (N.L + N.V))^2 S / (N.L N.V) cos(theta_i), factor by factor: none is large where another is small
    float scale = (h.h2 / cosines * d.wi.z * i.s_by_cos) * (h.h2 / cosines * o.s_by_cos);
    vec3 f = p.diffuse * (INV_PI * d.wi.z);
    for (int c = 0; c < 3; ++c) {
        float t = p.tau / p.wavelength[c];
        float root_g = TWO_PI * sigma / p.wavelength[c] * cosines;
        float root_q = PI * t * length(d.h.xy);
        float factor = 0.25 * PI * scale * fresnel[c];
        f[c] += factor > 0.0 ? min(he_series(factor, t, root_g, min(root_q * root_q, 1e30)), 1e37) : 0.0;
    }
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

/// The spike's reflectance for cos(theta) = c, sin^2(theta) = s2.
vec3 he_mirror(float c, float s2, HeParams p)
{
    float slope = 2.0 * p.sigma / p.tau;
    HeDirection w = he_direction(vec3(sqrt(s2), 0.0, c), slope);
    float k = 2.0 * w.k;
    float sigma = p.sigma / sqrt(1.0 + he_lambert_w(k * k * (0.25 * INV_TWO_PI)));
    float shadowing = c * w.s_by_cos;
    vec3 fresnel = fresnel_reflectance(p.fresnel, p.f0, p.eta, p.k, c, s2);
    for (int i = 0; i < 3; ++i) {
        float root_g = 2.0 * TWO_PI * sigma / p.wavelength[i] * c;
        fresnel[i] *= numeric_exp(-min(root_g * root_g, 1e30)) * shadowing * shadowing;
    }
    return fresnel;
}

/// a, and what a smooth surface reflects at normal incidence.
vec3 he_ambient(HeParams p) { return p.diffuse + fresnel_normal_reflectance(p.fresnel, p.f0, p.eta, p.k); }

/// Roughness r of the lobe of like width: r^2 = 2 sigma / tau.
float he_roughness(HeParams p) { return sqrt(min(2.0 * p.sigma / p.tau, 1.0)); }
