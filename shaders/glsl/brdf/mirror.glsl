/// mirror.glsl - ideal specular reflection. Registry name: mirror.
///
/// value  0: f_r = F delta(wo mirrored - wi) / cos(theta_i) shows no light without extent. mirror_mirror() is the
///        reflectance F of the mirrored direction
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params fresnel  0 schlick, 1 dielectric, 2 conductor
///        f0       0..1      per channel, no unit: reflectance at normal incidence
///        eta      0.01..20  per channel, no unit: index of refraction
///        k        0..20     per channel, no unit: extinction coefficient
/// domain cos(theta) in 0..1
/// source Born and Wolf, Principles of Optics; Schlick, Computer Graphics Forum 13(3), 1994
/// stable common/fresnel.glsl
/// error  none in the value; the reflectance as common/fresnel.glsl says
/// twin   engine/shading/brdf/mirror.cpp
#include "common/dirs.glsl"
#include "common/fresnel.glsl"

struct MirrorParams { int fresnel; vec3 f0; vec3 eta; vec3 k; };

vec3 mirror_f_cos(Dirs d, MirrorParams p) { return vec3(0.0); }

/// Reflectance into the mirrored direction for cos(theta) = c, sin^2(theta) = s2.
vec3 mirror_mirror(float c, float s2, MirrorParams p) { return fresnel_reflectance(p.fresnel, p.f0, p.eta, p.k, c, s2); }

vec3 mirror_ambient(MirrorParams p) { return fresnel_normal_reflectance(p.fresnel, p.f0, p.eta, p.k); }
float mirror_roughness(MirrorParams p) { return 0.0; }
