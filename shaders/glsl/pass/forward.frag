/// forward.frag - a surface with all its light in one go: blended surfaces, and the check on the deferred path.
///
/// Radiance is multiplied by coverage here; the blend function is (1, 1 - alpha).
#include "pass/surface.glsl"
#ifndef UNLIT
#include "pass/lights.glsl"
#endif

uniform vec3 uForward;
uniform vec3 uRayDirection, uRayDirectionDx, uRayDirectionDy;
#ifdef AMBIENT
uniform vec3 uAmbientRadiance;
#endif

#ifdef CONTRIBUTIONS
// What lies behind is dimmed in each contribution; a blended surface's own light is "transparent".
#ifdef OUT_CONTRIBUTION_EMISSION
layout(location = OUT_CONTRIBUTION_EMISSION) out vec4 oEmission;
#endif
#ifdef OUT_CONTRIBUTION_AMBIENT
layout(location = OUT_CONTRIBUTION_AMBIENT) out vec4 oAmbient;
#endif
#ifdef OUT_CONTRIBUTION_DIRECTIONAL
layout(location = OUT_CONTRIBUTION_DIRECTIONAL) out vec4 oDirectional;
#endif
#ifdef OUT_CONTRIBUTION_POINT
layout(location = OUT_CONTRIBUTION_POINT) out vec4 oPoint;
#endif
#ifdef OUT_CONTRIBUTION_SPOT
layout(location = OUT_CONTRIBUTION_SPOT) out vec4 oSpot;
#endif
#ifdef OUT_CONTRIBUTION_RECT
layout(location = OUT_CONTRIBUTION_RECT) out vec4 oRect;
#endif
#ifdef OUT_CONTRIBUTION_DISK
layout(location = OUT_CONTRIBUTION_DISK) out vec4 oDisk;
#endif
#ifdef OUT_CONTRIBUTION_SPHERE
layout(location = OUT_CONTRIBUTION_SPHERE) out vec4 oSphere;
#endif
#ifdef OUT_CONTRIBUTION_TUBE
layout(location = OUT_CONTRIBUTION_TUBE) out vec4 oTube;
#endif
layout(location = OUT_CONTRIBUTION_TRANSPARENT) out vec4 oTransparent;
layout(location = CONTRIBUTIONS) out vec4 oCoverage;
#else
layout(location = 0) out vec4 oRadiance;
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
#ifndef UNLIT
    MODEL_PARAMS params = surface_params();
#ifdef AMBIENT
    radiance += model_ambient(params) * uAmbientRadiance * surface_occlusion();
#endif
    vec3 ray = uRayDirection + gl_FragCoord.x * uRayDirectionDx + gl_FragCoord.y * uRayDirectionDy;
#ifdef USES_TANGENT
    Frame frame = frame_from_normal_tangent(surface_normal(), surface_tangent());
#else
    Frame frame = frame_from_normal(surface_normal());
#endif
    LightReceiver receiver = light_receiver(vPosition, ray, dot(vPosition, uForward), frame);
#ifdef SHADOWS
    receiver.geometric_normal = surface_geometric_normal();
    receiver.behind = 1.0 - alpha;
#endif
    radiance += all_lights(receiver, params);
    float marked = light_alpha(alpha);
#else
    float marked = alpha;
#endif
#ifdef CONTRIBUTIONS
    vec4 dim = vec4(0.0, 0.0, 0.0, alpha);
#ifdef OUT_CONTRIBUTION_EMISSION
    oEmission = dim;
#endif
#ifdef OUT_CONTRIBUTION_AMBIENT
    oAmbient = dim;
#endif
#ifdef OUT_CONTRIBUTION_DIRECTIONAL
    oDirectional = dim;
#endif
#ifdef OUT_CONTRIBUTION_POINT
    oPoint = dim;
#endif
#ifdef OUT_CONTRIBUTION_SPOT
    oSpot = dim;
#endif
#ifdef OUT_CONTRIBUTION_RECT
    oRect = dim;
#endif
#ifdef OUT_CONTRIBUTION_DISK
    oDisk = dim;
#endif
#ifdef OUT_CONTRIBUTION_SPHERE
    oSphere = dim;
#endif
#ifdef OUT_CONTRIBUTION_TUBE
    oTube = dim;
#endif
    oTransparent = vec4(radiance * alpha, marked);
    oCoverage = dim;
#else
    oRadiance = vec4(radiance * alpha, marked);
#endif
}
