/// thin_transmission.glsl - glTF's model for a thin surface that lets light through. Registry name: thin_transmission.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = (1 - F) (1 - transmission) c_diff / pi + F D V: metallic_roughness.glsl with a
///        diffuse base that gives way to what lies behind
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params base_color    0..1  per channel, no unit
///        metallic      0..1  no unit
///        roughness     0..1  no unit: alpha = roughness^2
///        transmission  0..1  no unit: of the dielectric's base
/// domain as metallic_roughness.glsl
/// source Khronos, KHR_materials_transmission; and as metallic_roughness.glsl
/// stable as metallic_roughness.glsl
/// error  relative, at most 5 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/thin_transmission.cpp
#include "brdf/metallic_roughness.glsl"

struct ThinTransmissionParams { vec3 base_color; float metallic; float roughness; float transmission; };

MetallicRoughnessParams thin_transmission_surface(ThinTransmissionParams p)
{
    return MetallicRoughnessParams(p.base_color, p.metallic, p.roughness);
}

vec3 thin_transmission_f_cos(Dirs d, ThinTransmissionParams p)
{
    MetallicRoughnessParts parts = metallic_roughness_parts(d, thin_transmission_surface(p));
    vec3 f = parts.diffuse * max(1.0 - p.transmission, 0.0) + parts.specular;
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f : vec3(0.0);
}

vec3 thin_transmission_ambient(ThinTransmissionParams p)
{
    return p.base_color * max(1.0 - p.transmission * max(1.0 - p.metallic, 0.0), 0.0);
}

float thin_transmission_roughness(ThinTransmissionParams p) { return p.roughness; }

/// What comes straight through, per channel; cosine = n.v: what the dielectric does not reflect, in the base's colour.
vec3 thin_transmission_transmittance(float cosine, ThinTransmissionParams p)
{
    float v = clamp(cosine, 0.0, 1.0);
    float w = 1.0 - v;
    float refracted = 0.96 * v * (1.0 + w * (1.0 + w * (1.0 + w * (1.0 + w))));  // 1 - F
    return p.base_color * (max(1.0 - p.metallic, 0.0) * p.transmission * refracted);
}

AreaWeights thin_transmission_area(ThinTransmissionParams p)
{
    AreaWeights weights = metallic_roughness_area(thin_transmission_surface(p));
    weights.lambert *= max(1.0 - p.transmission, 0.0);
    return weights;
}
