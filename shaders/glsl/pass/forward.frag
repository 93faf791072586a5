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
layout(location = 0) out vec4 oEmission;
layout(location = 1) out vec4 oAmbient;
layout(location = 2) out vec4 oDirectional;
layout(location = 3) out vec4 oPoint;
layout(location = 4) out vec4 oSpot;
layout(location = 5) out vec4 oTransparent;
layout(location = 6) out vec4 oCoverage;
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
    oEmission = dim;
    oAmbient = dim;
    oDirectional = dim;
    oPoint = dim;
    oSpot = dim;
    oTransparent = vec4(radiance * alpha, marked);
    oCoverage = dim;
#else
    oRadiance = vec4(radiance * alpha, marked);
#endif
}
