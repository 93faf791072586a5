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

/// The shading normal's direction in world axes, on the side that is seen; not unit, and zero where vertex normals
/// cancel out.
vec3 surface_normal_direction()
{
    vec3 n = vNormal;
#ifdef NORMAL_MAP
    // MikkTSpace: normal, tangent and bitangent are used as interpolated, not made unit again.
    vec3 texel = surface_normal_texel();
    n = vTangent.xyz * texel.x + (vTangent.w * cross(vNormal, vTangent.xyz)) * texel.y + vNormal * texel.z;
#endif
    return gl_FrontFacing ? n : -n;
}

vec3 surface_normal()
{
    vec3 n = surface_normal_direction();
    float length2 = dot(n, n);
    return length2 > 1e-12 ? n * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
}

/// The triangle's own normal, unit, on the side that is seen: the change of position across and up the picture turns
/// towards the eye. Differences are of the size of a pixel on the surface, with the rounding of the position.
vec3 surface_geometric_normal()
{
    vec3 dx = dFdx(vPosition), dy = dFdy(vPosition);
    float size = max(max(max(abs(dx.x), abs(dx.y)), abs(dx.z)), max(max(abs(dy.x), abs(dy.y)), abs(dy.z)));
    vec3 n = cross(dx / max(size, 1e-30), dy / max(size, 1e-30));
    float length2 = dot(n, n);
    return length2 > 1e-24 ? n * inversesqrt(length2) : surface_normal();
}

#ifdef USES_TANGENT
vec4 surface_tangent() { return vTangent; }
#endif
