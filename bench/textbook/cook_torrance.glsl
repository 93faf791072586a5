/// cook_torrance.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

#include "fresnel.glsl"

vec3 cook_torrance_f_cos(Dirs d, CookTorranceParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(d.wi + d.wo);
    float nl = d.wi.z;
    float nv = d.wo.z;
    float nh = h.z;
    float vh = dot(d.wo, h);
    float c2 = nh * nh;
    float D = exp(-(1.0 - c2) / (c2 * p.m * p.m)) / (3.14159265 * p.m * p.m * c2 * c2);
    float G = min(1.0, min(2.0 * nh * nv / vh, 2.0 * nh * nl / vh));
    vec3 F = textbook_fresnel(p.fresnel, p.f0, p.eta, p.k, vh);
    return (p.diffuse / 3.14159265 + p.specular * F * (D * G / (4.0 * nl * nv))) * nl;
}
