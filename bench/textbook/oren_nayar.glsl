/// oren_nayar.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

vec3 oren_nayar_f_cos(Dirs d, OrenNayarParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    float pi = 3.14159265;
    float theta_i = acos(d.wi.z);
    float theta_r = acos(d.wo.z);
    float alpha = max(theta_i, theta_r);
    float beta = min(theta_i, theta_r);
    float cos_phi = cos(atan(d.wo.y, d.wo.x) - atan(d.wi.y, d.wi.x));
    float s2 = p.sigma * p.sigma;
    if (p.form == 1) {
        float A = 1.0 - 0.5 * s2 / (s2 + 0.33);
        float B = 0.45 * s2 / (s2 + 0.09);
        return p.diffuse / pi * d.wi.z * (A + B * max(0.0, cos_phi) * sin(alpha) * tan(beta));
    }
    float c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
    float c2 = 0.45 * s2 / (s2 + 0.09) * (cos_phi >= 0.0 ? sin(alpha) : sin(alpha) - pow(2.0 * beta / pi, 3.0));
    float c3 = 0.125 * s2 / (s2 + 0.09) * pow(4.0 * alpha * beta / (pi * pi), 2.0);
    float direct = c1 + cos_phi * c2 * tan(beta) + (1.0 - abs(cos_phi)) * c3 * tan(0.5 * (alpha + beta));
    float between = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * pow(2.0 * beta / pi, 2.0));
    return p.diffuse / pi * d.wi.z * max(direct + p.diffuse * between, 0.0);
}
