/// blinn_phong.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

vec3 blinn_phong_f_cos(Dirs d, BlinnPhongParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(d.wi + d.wo);
    float n = p.shininess;
    float lobe = pow(max(h.z, 0.0), n);
    if (p.normalization == 0)
        return p.diffuse * d.wi.z + p.specular * lobe;
    float norm = (n + 2.0) * (n + 4.0) / (8.0 * 3.14159265 * (pow(2.0, -0.5 * n) + n));
    return (p.diffuse / 3.14159265 + p.specular * (norm * lobe)) * d.wi.z;
}
