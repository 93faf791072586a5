/// gbuffer_read.glsl - the surface behind a pixel, from the G-buffer.
#include "pass/gbuffer_normal.glsl"
#define GBUFFER_READ

uniform sampler2D uDepth;     // distance along the view axis where LINEAR_Z, else the reversed depth buffer
uniform vec4 uDepthToZ;       // z = (x + y d) / (z + w d)
uniform vec3 uRayOrigin, uRayOriginDx, uRayOriginDy;
uniform vec3 uRayDirection, uRayDirectionDx, uRayDirectionDy;
#ifdef HAS_NORMAL
uniform sampler2D uNormal;
#endif
#ifdef SHADOWS
uniform sampler2D uGeometricNormal;
#endif
#ifdef USES_TANGENT
uniform sampler2D uTangent;
#endif
#ifdef HAS_MATERIAL
uniform usampler2D uMaterialId;
uniform samplerBuffer uMaterials;
#endif
#ifdef HAS_PARAMETERS0
uniform sampler2D uParameters0;
#endif
#ifdef HAS_PARAMETERS1
uniform sampler2D uParameters1;
#endif
#ifdef HAS_PARAMETERS2
uniform sampler2D uParameters2;
#endif
#ifdef HAS_PARAMETERS3
uniform sampler2D uParameters3;
#endif

ivec2 gbuffer_pixel() { return ivec2(gl_FragCoord.xy); }

/// Distance along the view axis, m.
float gbuffer_z()
{
    float d = texelFetch(uDepth, gbuffer_pixel(), 0).x;
#ifdef LINEAR_Z
    return d;
#else
    return (uDepthToZ.x + uDepthToZ.y * d) / (uDepthToZ.z + uDepthToZ.w * d);
#endif
}

/// The direction of the pixel's ray, of length 1 along the view axis.
vec3 gbuffer_ray() { return uRayDirection + gl_FragCoord.x * uRayDirectionDx + gl_FragCoord.y * uRayDirectionDy; }

/// Position relative to the eye, in world axes, m.
vec3 gbuffer_position(float z, vec3 ray)
{
    return uRayOrigin + gl_FragCoord.x * uRayOriginDx + gl_FragCoord.y * uRayOriginDy + z * ray;
}

#ifdef HAS_NORMAL
vec3 gbuffer_normal() { return gbuffer_decode_normal(texelFetch(uNormal, gbuffer_pixel(), 0).xy); }
#endif
#ifdef SHADOWS
vec3 gbuffer_geometric_normal()
{
    return octahedral_decode_unorm16(texelFetch(uGeometricNormal, gbuffer_pixel(), 0).xy);
}
#endif
