/// lambert.glsl - ideal diffuse reflection. Registry name: lambert.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = diffuse / pi
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params diffuse  0..1  per channel, no unit: reflectance k_d
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Lambert, Photometria, 1760
/// stable one product
/// error  relative, at most 1 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md): < 2.4e-7
/// twin   engine/shading/brdf/lambert.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/dirs.glsl"

struct LambertParams { vec3 diffuse; };

vec3 lambert_f_cos(Dirs d, LambertParams p)
{
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? p.diffuse * (INV_PI * d.wi.z) : vec3(0.0);
}

vec3 lambert_ambient(LambertParams p) { return p.diffuse; }
float lambert_roughness(LambertParams p) { return 1.0; }

/// For lights with a body.
AreaWeights lambert_area(LambertParams p) { return AreaWeights(p.diffuse, vec3(0.0), vec3(0.0)); }
