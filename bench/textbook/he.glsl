/// he.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

#include "fresnel.glsl"

/// erfc by Abramowitz and Stegun 7.1.26, absolute error 1.5e-7.
float textbook_erfc(float x)
{
    float t = 1.0 / (1.0 + 0.3275911 * x);
    return t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) * exp(-x * x);
}

float textbook_shadowing(float x)
{
    float e = textbook_erfc(x);
    float lambda = 0.5 * (exp(-x * x) / (1.77245385 * x) - e);
    return (1.0 - 0.5 * e) / (lambda + 1.0);
}

/// The series from its first term until the terms no longer count, each from the one before; for very rough surfaces the
/// paper's closed form.
float textbook_series(float g, float q)
{
    if (g > 60.0)
        return exp(-q / g) / g;
    float power = g * exp(-g);  // g^m exp(-g) / m!
    float sum = 0.0;
    for (int m = 1; m < 200; ++m) {
        float term = power * exp(-q / float(m)) / float(m);
        sum += term;
        if (float(m) > g && term < 1e-7 * sum)
            break;
        power *= g / float(m + 1);
    }
    return sum;
}

vec3 he_f_cos(Dirs d, HeParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    float pi = 3.14159265;
    float tan_i = tan(acos(d.wi.z));
    float tan_r = tan(acos(d.wo.z));
    float xi = p.tau / (2.0 * p.sigma * tan_i);
    float xr = p.tau / (2.0 * p.sigma * tan_r);
    float K = tan_i * textbook_erfc(xi) + tan_r * textbook_erfc(xr);
    float z = 0.0;  // z0 / sigma
    for (int i = 0; i < 8; ++i) {
        float e = 0.19947114 * K * exp(-0.5 * z * z);  // Newton on z = K / sqrt(8 pi) exp(-z^2 / 2)
        z -= (z - e) / (1.0 + z * e);
    }
    float sigma = p.sigma / sqrt(1.0 + z * z);
    vec3 h = d.wi + d.wo;
    float h2 = dot(h, h);
    float cosines = d.wi.z + d.wo.z;
    float geometry = h2 * h2 / (cosines * cosines);
    float S = textbook_shadowing(xi) * textbook_shadowing(xr);
    vec3 F = textbook_fresnel(p.fresnel, p.f0, p.eta, p.k, 0.5 * sqrt(h2));
    vec3 f = p.diffuse / pi;
    for (int c = 0; c < 3; ++c) {
        float lambda = p.wavelength[c];
        float root_g = 2.0 * pi * sigma / lambda * cosines;
        float scale = pi * p.tau / lambda;
        float D = 0.25 * scale * scale * textbook_series(root_g * root_g, scale * scale * dot(h.xy, h.xy));
        f[c] += F[c] / pi * geometry * S * D / (d.wi.z * d.wo.z);
    }
    return f * d.wi.z;
}
