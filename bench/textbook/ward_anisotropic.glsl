/// ward_anisotropic.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

vec3 ward_anisotropic_f_cos(Dirs d, WardAnisotropicParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(d.wi + d.wo);
    float phi = atan(h.y, h.x) - p.rotation;
    float c = cos(phi) / p.alpha_x;
    float s = sin(phi) / p.alpha_y;
    float exponent;
    if (p.form == 0) {
        float t = tan(acos(h.z));
        exponent = t * t * (c * c + s * s);
    } else {
        exponent = 2.0 * (1.0 - h.z * h.z) * (c * c + s * s) / (1.0 + h.z);
    }
    float lobe = exp(-exponent) / (4.0 * 3.14159265 * p.alpha_x * p.alpha_y);
    vec3 sum = d.wi + d.wo;
    lobe *= p.variant == 0   ? 1.0 / sqrt(d.wi.z * d.wo.z)
            : p.variant == 1 ? 1.0 / (d.wi.z * d.wo.z)
                             : 4.0 * dot(sum, sum) / pow(sum.z, 4.0);
    return (p.diffuse / 3.14159265 + p.specular * lobe) * d.wi.z;
}
