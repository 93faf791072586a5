/// forward.frag - a surface with all its light in one go: blended surfaces, and the check on the deferred path.
///
/// Radiance is multiplied by coverage here. What lies behind is multiplied by 1 - alpha, or, with COLORED_TRANSMITTANCE,
/// by the second output; that one takes a program for each target, of which OUT_... names the one. PEELED: only the
/// fragments of one layer.
#ifdef PEELED
#include "pass/peel.glsl"
#endif
#include "pass/surface.glsl"
#ifndef UNLIT
#include "pass/lights.glsl"
#endif
#ifdef FOG
#include "pass/fog.glsl"
#endif
#ifdef AIRLIGHT_NODES
#if defined(AIRLIGHT_POINTS) && !defined(POINT_LIGHTS) && !defined(POINT_CLUSTERS)
uniform samplerBuffer uPointLights;
#endif
#if defined(AIRLIGHT_SPOTS) && !defined(SPOT_LIGHTS) && !defined(SPOT_CLUSTERS)
uniform samplerBuffer uSpotLights;
#endif
#include "pass/airlight.glsl"
#endif

uniform vec3 uForward;
uniform vec3 uRayDirection, uRayDirectionDx, uRayDirectionDy;
#ifdef FOG
uniform vec3 uRayOrigin, uRayOriginDx, uRayOriginDy;
#endif
#ifdef AMBIENT
uniform vec3 uAmbientRadiance;
#endif
#ifdef PEELED
uniform int uPeelRest;  // 1: all that is in front of the last layer, at once
#endif

// In contributions a blended surface's own light is "transparent", and "radiance" has coverage alone.
#ifdef OUT_RADIANCE
layout(location = OUT_RADIANCE) out vec4 oRadiance;
#endif
#ifdef OUT_CONTRIBUTION_TRANSPARENT
layout(location = OUT_CONTRIBUTION_TRANSPARENT) out vec4 oTransparent;
#endif
#ifdef OUT_CONTRIBUTION_FOG
layout(location = OUT_CONTRIBUTION_FOG) out vec4 oFog;
#endif
#ifdef OUT_TRANSMITTANCE
layout(location = OUT_TRANSMITTANCE) out vec4 oTransmittance;
#endif
#ifdef COLORED_TRANSMITTANCE
layout(location = 0, index = 1) out vec4 oThrough;
#endif

void main()
{
    float alpha = 1.0;
#ifdef ALPHA_MASK
    if (surface_alpha() < uAlphaCutoff)
        discard;
#endif
#ifdef ALPHA_BLEND
    alpha = clamp(surface_alpha(), 0.0, 1.0);
#endif
    vec3 radiance = surface_emission();
    float marked = alpha;  // where a ray was cut short: see light_alpha
    vec3 through = vec3(1.0 - alpha);
    float z = dot(vPosition, uForward);
    vec3 ray = uRayDirection + gl_FragCoord.x * uRayDirectionDx + gl_FragCoord.y * uRayDirectionDy;
#ifndef UNLIT
    MODEL_PARAMS params = surface_params();
#ifdef AMBIENT
    radiance += model_ambient(params) * uAmbientRadiance * surface_occlusion();
#endif
#ifdef USES_TANGENT
    Frame frame = frame_from_normal_tangent(surface_normal(), surface_tangent());
#else
    Frame frame = frame_from_normal(surface_normal());
#endif
    LightReceiver receiver = light_receiver(vPosition, ray, z, frame);
#ifdef SHADOWS
    receiver.geometric_normal = surface_geometric_normal();
    receiver.behind = 1.0 - alpha;
#endif
    radiance += all_lights(receiver, params);
    marked = light_alpha(alpha);
#ifdef TRANSMISSION
    through += alpha * model_transmittance(max(receiver.wo.z, 0.0), params);
#endif
#endif
    radiance *= alpha;
    vec3 fog = vec3(0.0);
#ifdef FOG
    float length_per_z = length(ray);
    vec3 origin = uRayOrigin + gl_FragCoord.x * uRayOriginDx + gl_FragCoord.y * uRayOriginDy;
    vec3 depth = fog_depth_along(origin, ray / length_per_z, z * length_per_z);
    radiance *= fog_transmittance(depth);
    fog = uFogRadiance * fog_opacity(depth);
#ifdef AIRLIGHT_NODES
    fog += airlight_of_lamps(origin, ray / length_per_z, z * length_per_z);
#endif
    // What lies behind has the fog of its whole way already, the part in front of the surface included.
    fog *= 1.0 - through;
#endif
#ifdef CONTRIBUTIONS
#ifdef OUT_CONTRIBUTION_TRANSPARENT
    oTransparent = vec4(radiance, alpha);
#endif
#ifdef OUT_CONTRIBUTION_FOG
    oFog = vec4(fog, alpha);
#endif
#ifdef OUT_TRANSMITTANCE
    oTransmittance = vec4(0.0, 0.0, 0.0, alpha);
#endif
#ifdef OUT_RADIANCE
    oRadiance = vec4(0.0, 0.0, 0.0, marked);
#endif
#else
    oRadiance = vec4(radiance + fog, marked);
#endif
#ifdef COLORED_TRANSMITTANCE
    oThrough = vec4(through, 1.0 - alpha);
#endif
#ifdef PEELED
    // Last, as derivatives end where a fragment does; the depth test has kept out almost all others.
    uvec2 key = peel_key();
    uvec2 layer = peel_layer();
    if (!(uPeelRest == 1 ? peel_in_front(key, layer) : key == layer))
        discard;
#endif
}
