/// punctual.glsl - irradiance from lights without extent (glTF KHR_lights_punctual).
///
/// value  attenuation in 1/m^2: times radiant intensity (W/sr) it is the irradiance on a surface that faces the light
/// params inv_range2  1 / range^2 in 1/m^2, finite; 0: no range
/// domain distances 1e-15..1e18 m; d^2 is kept above 1e-12 m^2 (1 um), so nearer lights do not get brighter; a light
///        at the very point has no direction (wi = 0) and lights nothing
/// source Khronos, KHR_lights_punctual, "Range Property" and "Inner and Outer Cone Angles"
/// stable the largest component is divided out before squaring; 1 - t^2 as (1 - t)(1 + t);
///        the cone as a difference of 1 - cos, which |axis + wi|^2 / 2 gives without cancellation
/// error  attenuation: relative < 6e-7 + 6e-7 / window; cone: see spot_attenuation (tests/shading/punctual_test.cpp)
/// twin   engine/shading/punctual.cpp

const float PUNCTUAL_MIN_DISTANCE2 = 1e-12;

struct PunctualGeometry {
    vec3 wi;            // to the light, unit
    float attenuation;  // 1/m^2
};

/// max(1 - (d / range)^4, 0)
float punctual_window(float d2, float inv_range2)
{
    float t = d2 * inv_range2;
    return max((1.0 - t) * (1.0 + t), 0.0);
}

PunctualGeometry punctual_geometry(vec3 to_light, float inv_range2)
{
    float m = max(max(abs(to_light.x), abs(to_light.y)), abs(to_light.z));
    if (!(m > 0.0))
        return PunctualGeometry(vec3(0.0), 0.0);
    vec3 u = to_light / m;
    float q = dot(u, u);
    // Beyond 1e19 m the square is infinite, which times a zero inv_range2 would be no number.
    float d2 = min(m * m * q, 3e38);
    float attenuation = punctual_window(d2, inv_range2) / max(d2, PUNCTUAL_MIN_DISTANCE2);
    return PunctualGeometry(u * inversesqrt(q), attenuation);
}

/// Cone of a spot: clamp((cos theta - cos outer) / max(0.001, cos inner - cos outer), 0, 1)^2, theta between the axis
/// (unit, the way the light shines) and -wi. scale and offset are lobe::spotScaleOffset's, so that the inner term is
/// offset - scale (1 - cos theta): cos theta itself would lose a narrow cone (8 % at 0.1 degrees). Its error is below
/// 3 x 2^-24 (offset + scale (1 - cos theta)).
float spot_attenuation(vec3 axis, vec3 wi, float scale, float offset)
{
    vec3 s = axis + wi;
    float t = clamp(offset - scale * (0.5 * dot(s, s)), 0.0, 1.0);
    return t * t;
}
