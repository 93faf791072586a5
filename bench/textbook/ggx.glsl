/// ggx.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

#include "fresnel.glsl"

float textbook_lambda(vec3 w, vec2 alpha)
{
    vec2 s = alpha * w.xy / w.z;
    return 0.5 * (sqrt(1.0 + dot(s, s)) - 1.0);
}

vec3 textbook_turned(vec3 w, float angle)
{
    float c = cos(angle);
    float s = sin(angle);
    return vec3(c * w.x + s * w.y, c * w.y - s * w.x, w.z);
}

vec3 ggx_f_cos(Dirs d, GgxParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec2 alpha = vec2(p.alpha_x, p.alpha_y);
    vec3 l = textbook_turned(d.wi, p.rotation);
    vec3 v = textbook_turned(d.wo, p.rotation);
    vec3 h = normalize(l + v);
    vec2 s = h.xy / alpha;
    float q = dot(s, s) + h.z * h.z;
    float D = 1.0 / (3.14159265 * alpha.x * alpha.y * q * q);
    float G = 1.0 / (1.0 + textbook_lambda(l, alpha) + textbook_lambda(v, alpha));
    vec3 F = textbook_fresnel(p.fresnel, p.f0, p.eta, p.k, dot(v, h));
    return (p.diffuse / 3.14159265 + p.specular * F * (D * G / (4.0 * d.wi.z * d.wo.z))) * d.wi.z;
}
