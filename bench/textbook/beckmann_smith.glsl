/// beckmann_smith.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

#include "fresnel.glsl"

/// erfc by Abramowitz and Stegun 7.1.26, absolute error 1.5e-7.
float textbook_erfc(float x)
{
    float t = 1.0 / (1.0 + 0.3275911 * x);
    return t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) * exp(-x * x);
}

float textbook_lambda(vec3 w, float m)
{
    float tangent = sqrt(1.0 - w.z * w.z) / w.z;
    float x = 1.0 / (m * tangent);
    return 0.5 * (exp(-x * x) / (x * 1.77245385) - textbook_erfc(x));
}

vec3 beckmann_smith_f_cos(Dirs d, BeckmannSmithParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(d.wi + d.wo);
    float c2 = h.z * h.z;
    float D = exp(-(1.0 - c2) / (c2 * p.m * p.m)) / (3.14159265 * p.m * p.m * c2 * c2);
    float li = textbook_lambda(d.wi, p.m);
    float lo = textbook_lambda(d.wo, p.m);
    float G = p.masking == 0 ? 1.0 / (1.0 + li + lo) : 1.0 / ((1.0 + li) * (1.0 + lo));
    vec3 F = textbook_fresnel(p.fresnel, p.f0, p.eta, p.k, dot(d.wo, h));
    return (p.diffuse / 3.14159265 + p.specular * F * (D * G / (4.0 * d.wi.z * d.wo.z))) * d.wi.z;
}
