/// phong.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

vec3 phong_f_cos(Dirs d, PhongParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 r = reflect(-d.wi, vec3(0.0, 0.0, 1.0));
    float lobe = pow(max(dot(r, d.wo), 0.0), p.shininess);
    if (p.normalization == 0)
        return p.diffuse * d.wi.z + p.specular * lobe;
    return (p.diffuse / 3.14159265 + p.specular * ((p.shininess + 2.0) / 6.2831853 * lobe)) * d.wi.z;
}
