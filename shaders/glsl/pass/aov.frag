/// aov.frag - quantities of the surface other than radiance, for one model's pixels.
#include "pass/gbuffer_read.glsl"
#include "generated/material.glsl"

#ifdef OUT_DEPTH
layout(location = OUT_DEPTH) out float oDepth;
#endif
#ifdef OUT_POSITION
layout(location = OUT_POSITION) out vec4 oPosition;
#endif
#ifdef OUT_NORMAL
layout(location = OUT_NORMAL) out vec4 oNormal;
#endif
#ifdef OUT_ALBEDO
layout(location = OUT_ALBEDO) out vec4 oAlbedo;
#endif
#ifdef OUT_MATERIAL_ID
layout(location = OUT_MATERIAL_ID) out float oMaterialId;
#endif
#ifdef OUT_ROUGHNESS
layout(location = OUT_ROUGHNESS) out float oRoughness;
#endif

void main()
{
#ifdef OUT_DEPTH
    oDepth = gbuffer_z();
#endif
#ifdef OUT_POSITION
    // Relative to the eye: the eye is added in double outside, as float has 6 cm steps a thousand kilometres away.
    oPosition = vec4(gbuffer_position(gbuffer_z(), gbuffer_ray()), 1.0);
#endif
#ifdef OUT_MATERIAL_ID
    oMaterialId = float(texelFetch(uMaterialId, gbuffer_pixel(), 0).x);
#endif
#ifdef UNLIT
#ifdef OUT_NORMAL
    oNormal = vec4(0.0);
#endif
#ifdef OUT_ALBEDO
    oAlbedo = vec4(0.0);
#endif
#ifdef OUT_ROUGHNESS
    oRoughness = 1.0;
#endif
#else
#ifdef OUT_NORMAL
    oNormal = vec4(gbuffer_normal(), 1.0);
#endif
#ifdef OUT_ALBEDO
    oAlbedo = vec4(model_ambient(gbuffer_read_params()), 1.0);
#endif
#ifdef OUT_ROUGHNESS
    oRoughness = model_roughness(gbuffer_read_params());
#endif
#endif
}
