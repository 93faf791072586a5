/// minnaert.glsl - Minnaert's law, for the Moon and for velvet.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = rho (k + 1) / (2 pi) (cos(theta_i) cos(theta_o))^(k - 1): reflects rho of what
///        arrives along the normal; k = 1 is Lambert
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params rho  0..1    per channel, no unit, default 0.8, sRGB, takes base colour: reflectance at normal incidence
///        k    0.5..2  no unit, default 0.7: limb darkening; below 1 edges are brighter than Lambert's, above darker
/// sharpness 2
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0
/// source Minnaert, The reciprocity principle in lunar photometry, Astrophysical Journal 93, 1941
/// stable both powers in one exponential; k of at least 0.5 keeps them finite at grazing
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/numeric.glsl"

struct MinnaertParams { vec3 rho; float k; };

vec3 minnaert_f_cos(Dirs d, MinnaertParams p)
{
    bool above = d.wi.z > 0.0 && d.wo.z > 0.0;
    float li = numeric_log(above ? d.wi.z : 1.0);
    float lo = numeric_log(above ? d.wo.z : 1.0);
    float lobe = (p.k + 1.0) * INV_TWO_PI * numeric_exp(p.k * li + (p.k - 1.0) * lo);
    return above ? p.rho * lobe : vec3(0.0);
}
