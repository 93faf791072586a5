/// surface.glsl - what a fragment's surface is: parameters, shading normal, emission, coverage.
///
/// The generated file holds the material's uniforms and texture fetches, and aliases the model in use:
/// MODEL_PARAMS, model_f_cos, model_ambient, model_roughness, surface_params().
#include "generated/material.glsl"

in vec3 vPosition;
in vec3 vNormal;
#ifdef TANGENTS
in vec4 vTangent;
#endif

/// v / |v|, or `fallback` where v is too short to have a direction. The largest component is divided out first, as
/// squares of lengths below 1e-16 flush to zero.
vec3 surface_normalize(vec3 v, vec3 fallback)
{
    float m = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return m > 0.0 ? normalize(v / m) : fallback;
}

/// The unit shading normal in world axes, on the side that is seen.
vec3 surface_normal()
{
    vec3 n = surface_normalize(vNormal, vec3(0.0, 0.0, 1.0));
#ifdef NORMAL_MAP
    // MikkTSpace: tangent and bitangent are used as interpolated, only the normal's length is divided out.
    vec3 texel = surface_normal_texel();
    vec3 bitangent = vTangent.w * cross(n, vTangent.xyz);
    n = surface_normalize(vTangent.xyz * texel.x + bitangent * texel.y + n * texel.z, n);
#endif
    return gl_FrontFacing ? n : -n;
}

#ifdef USES_TANGENT
vec4 surface_tangent() { return vTangent; }
#endif
