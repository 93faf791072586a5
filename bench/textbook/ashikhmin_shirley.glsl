/// ashikhmin_shirley.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

vec3 ashikhmin_shirley_f_cos(Dirs d, AshikhminShirleyParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(d.wi + d.wo);
    float c = cos(p.rotation);
    float s = sin(p.rotation);
    float hu = c * h.x + s * h.y;
    float hv = c * h.y - s * h.x;
    float kh = dot(d.wi, h);
    float exponent = (p.nu * hu * hu + p.nv * hv * hv) / (1.0 - h.z * h.z);
    float lobe = sqrt((p.nu + 1.0) * (p.nv + 1.0)) / (8.0 * 3.14159265) * pow(h.z, exponent) / (kh * max(d.wi.z, d.wo.z));
    vec3 F = p.specular + (1.0 - p.specular) * pow(1.0 - kh, 5.0);
    vec3 base = 28.0 * p.diffuse / (23.0 * 3.14159265) * (1.0 - p.specular) * (1.0 - pow(1.0 - 0.5 * d.wi.z, 5.0)) *
                (1.0 - pow(1.0 - 0.5 * d.wo.z, 5.0));
    return (base + F * lobe) * d.wi.z;
}
