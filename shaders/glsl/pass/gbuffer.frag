/// gbuffer.frag - stores what the lighting passes need of the nearest surface, and its emission and ambient light.
#include "pass/gbuffer_normal.glsl"
#include "pass/surface.glsl"
#include "common/dirs.glsl"

#ifdef OUT_LINEAR_Z
layout(location = OUT_LINEAR_Z) out float oLinearZ;
uniform vec3 uForward;
#endif
#if defined(OUT_NORMAL) && !defined(UNLIT)
layout(location = OUT_NORMAL) out vec2 oNormal;
#endif
#if defined(OUT_GEOMETRIC_NORMAL) && !defined(UNLIT)
layout(location = OUT_GEOMETRIC_NORMAL) out vec2 oGeometricNormal;
#endif
#if defined(OUT_TANGENT) && !defined(UNLIT)
layout(location = OUT_TANGENT) out float oTangent;
#endif
#if defined(OUT_OCCLUSION) && !defined(UNLIT)
layout(location = OUT_OCCLUSION) out float oOcclusion;
#endif
#ifdef OUT_MATERIAL
layout(location = OUT_MATERIAL) out uint oMaterial;
uniform int uMaterial;
#endif
#ifdef OUT_RADIANCE
layout(location = OUT_RADIANCE) out vec4 oRadiance;
#endif
#ifdef OUT_CONTRIBUTION_EMISSION
layout(location = OUT_CONTRIBUTION_EMISSION) out vec4 oEmission;
layout(location = OUT_CONTRIBUTION_AMBIENT) out vec4 oAmbient;
#endif
#ifdef AMBIENT
uniform vec3 uAmbientRadiance;
#endif

void main()
{
#ifdef ALPHA_MASK
    if (surface_alpha() < uAlphaCutoff)
        discard;
#endif
#ifdef OUT_LINEAR_Z
    oLinearZ = dot(vPosition, uForward);
#endif
#ifdef OUT_MATERIAL
    oMaterial = uint(uMaterial + 1);
#endif
    vec3 emission = surface_emission();
    vec3 ambient = vec3(0.0);
#ifndef UNLIT
#ifdef OUT_NORMAL
    oNormal = gbuffer_encode_normal(surface_normal_direction());
#endif
#ifdef OUT_GEOMETRIC_NORMAL
    oGeometricNormal = octahedral_encode_unorm16(surface_geometric_normal());
#endif
#ifdef OUT_TANGENT
#ifdef USES_TANGENT
    vec3 stored = gbuffer_stored_normal(surface_normal());
    oTangent = frame_encode_tangent(frame_from_normal_tangent(stored, surface_tangent()));
#else
    oTangent = 0.0;
#endif
#endif
#ifdef OUT_OCCLUSION
    oOcclusion = surface_occlusion();
#endif
    MODEL_PARAMS params = surface_params();
    gbuffer_write_params(params);
#ifdef AMBIENT
    ambient = model_ambient(params) * uAmbientRadiance * surface_occlusion();
#endif
#endif
#ifdef OUT_RADIANCE
    oRadiance = vec4(emission + ambient, 1.0);
#endif
#ifdef OUT_CONTRIBUTION_EMISSION
    oEmission = vec4(emission, 1.0);
    oAmbient = vec4(ambient, 1.0);
#endif
}
