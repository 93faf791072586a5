/// thin_transmission.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

/// As in KHR_materials_transmission and the glTF specification 2.0, appendix B.
vec3 thin_transmission_f_cos(Dirs d, ThinTransmissionParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 h = normalize(d.wi + d.wo);
    float nl = d.wi.z;
    float nv = d.wo.z;
    float vh = dot(d.wo, h);
    float a = max(p.roughness * p.roughness, 1e-4);
    float a2 = a * a;
    float f = h.z * h.z * (a2 - 1.0) + 1.0;
    float D = a2 / (3.14159265 * f * f);
    float V = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    vec3 f0 = mix(vec3(0.04), p.base_color, p.metallic);
    vec3 F = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
    vec3 diffuse = (1.0 - F) * (1.0 - p.transmission) * mix(p.base_color, vec3(0.0), p.metallic) / 3.14159265;
    return (diffuse + F * (V * D)) * nl;
}
