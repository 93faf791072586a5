/// fresnel.glsl - Fresnel's equations and Schlick's approximation as they are usually written.
///
/// source Born and Wolf, Principles of Optics; Schlick, Computer Graphics Forum 13(3), 1994; conductors from sums of squares of
///        the complex index, as in PBRT

vec3 textbook_conductor(vec3 eta, vec3 k, float c)
{
    float c2 = c * c;
    float s2 = 1.0 - c2;
    vec3 t0 = eta * eta - k * k - s2;
    vec3 a2_b2 = sqrt(t0 * t0 + 4.0 * eta * eta * k * k);
    vec3 a = sqrt(0.5 * (a2_b2 + t0));
    vec3 t1 = a2_b2 + c2;
    vec3 t2 = 2.0 * c * a;
    vec3 rs = (t1 - t2) / (t1 + t2);
    vec3 t3 = c2 * a2_b2 + s2 * s2;
    vec3 t4 = t2 * s2;
    vec3 rp = rs * (t3 - t4) / (t3 + t4);
    return 0.5 * (rs + rp);
}

vec3 textbook_dielectric(vec3 eta, float c)
{
    vec3 g = sqrt(max(eta * eta - 1.0 + c * c, 0.0));
    vec3 a = (g - c) / (g + c);
    vec3 b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

vec3 textbook_fresnel(int type, vec3 f0, vec3 eta, vec3 k, float c)
{
    if (type == 0)
        return f0 + (1.0 - f0) * pow(1.0 - c, 5.0);
    if (type == 1)
        return textbook_dielectric(eta, c);
    return textbook_conductor(eta, k, c);
}
