/// fresnel.glsl - reflectance of a smooth interface for unpolarised light.
///
/// value  0..1 per channel
/// frame  the angle of incidence as c = cos(theta) > 0 and s2 = sin^2(theta), both known without cancellation: for half
///        vectors c = |wi + wo| / 2 and s2 = |wi - wo|^2 / 4
/// source Born and Wolf, Principles of Optics; Schlick, Computer Graphics Forum 13(3), 1994
/// stable sums of squares, whose terms all add; of the two roots of the refracted wave vector the larger by addition, the
///        smaller by division; a - c through (eta - 1)(eta + 1), which keeps indices near 1
/// error  relative, 8 x 2^-24 (1 + c) with c the condition number with respect to index and angle; condition of eta
///        near 1: 4 eta / (eta^2 - 1)
/// bands  where FRESNEL_BANDS is defined, type 3 is exact in bands of wavelength whose rows start at k.x of the table
/// twin   engine/shading/fresnel.cpp
#include "common/table.glsl"

const int FRESNEL_SCHLICK = 0;
const int FRESNEL_DIELECTRIC = 1;
const int FRESNEL_CONDUCTOR = 2;

/// (1 - cos(theta))^5
float fresnel_schlick_weight(float c, float s2)
{
    float w = min(s2 / (1.0 + c), 1.0);
    float w2 = w * w;
    return w2 * w2 * w;
}

vec3 fresnel_schlick(vec3 f0, float c, float s2) { return f0 + (1.0 - f0) * fresnel_schlick_weight(c, s2); }

/// Exact, for index eta + i k over that of the medium outside; eta < 1 without k reflects totally beyond its angle.
vec3 fresnel_exact(vec3 eta, vec3 k, float c, float s2)
{
    vec3 em = (eta - 1.0) * (eta + 1.0);
    vec3 k2 = k * k;
    // eta^2 - s2 - k^2, with the pair that cancels least put together first.
    vec3 t0 = mix(eta * eta - s2, em + c * c, lessThan(abs(em), vec3(0.5))) - k2;
    vec3 ek = eta * k;
    vec3 ab = sqrt(t0 * t0 + 4.0 * ek * ek);  // a^2 + b^2
    vec3 big = sqrt(0.5 * (ab + abs(t0)));
    vec3 small = ek / max(big, 1e-18);
    bvec3 forward = greaterThanEqual(t0, vec3(0.0));
    vec3 a = mix(small, big, forward);
    vec3 b = mix(big, small, forward);
    vec3 b2 = b * b;

    vec3 a_plus_c = a + c;
    // Beyond the angle of total reflection b^2 cancels em, but then it is b that counts.
    vec3 near_c = vec3(forward) * vec3(lessThan(k2, vec3(0.01)));
    vec3 a_minus_c = mix(a - c, (em - k2 + b2) / a_plus_c, greaterThan(near_c, vec3(0.5)));
    vec3 rs = (a_minus_c * a_minus_c + b2) / (a_plus_c * a_plus_c + b2);
    vec3 ac = a * c;
    vec3 b2c2 = b2 * (c * c);
    vec3 rp = (ac - s2) * (ac - s2) + b2c2;
    rp /= (ac + s2) * (ac + s2) + b2c2;
    return 0.5 * rs * (1.0 + rp);
}

#ifdef FRESNEL_BANDS
const int FRESNEL_BANDED = 3;

/// Linear sRGB from three bands at a time: the number of groups in x of the first row; then, a group, a row of eta, a row
/// of k and each band's weight. Weights add up to 1, so what is lost is subtracted from 1: a perfect reflector is exactly
/// white. Colours beyond sRGB's gamut could be negative and are 0 there.
vec3 fresnel_bands(int row, float c, float s2)
{
    int groups = int(table_row(row).x);
    vec3 lost = vec3(0.0);
    for (int i = 0; i < groups; ++i) {
        int first = row + 1 + 5 * i;
        vec3 part = 1.0 - fresnel_exact(table_row(first).xyz, table_row(first + 1).xyz, c, s2);
        lost += part.x * table_row(first + 2).xyz + part.y * table_row(first + 3).xyz + part.z * table_row(first + 4).xyz;
    }
    return max(1.0 - lost, 0.0);
}
#endif

vec3 fresnel_reflectance(int type, vec3 f0, vec3 eta, vec3 k, float c, float s2)
{
    if (type == FRESNEL_SCHLICK)
        return fresnel_schlick(f0, c, s2);
#ifdef FRESNEL_BANDS
    if (type == FRESNEL_BANDED)
        return fresnel_bands(int(k.x), c, s2);
#endif
    return fresnel_exact(eta, type == FRESNEL_CONDUCTOR ? k : vec3(0.0), c, s2);
}

/// At normal incidence.
vec3 fresnel_normal_reflectance(int type, vec3 f0, vec3 eta, vec3 k)
{
    return fresnel_reflectance(type, f0, eta, k, 1.0, 0.0);
}
