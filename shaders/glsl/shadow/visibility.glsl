/// visibility.glsl - how much of a light reaches a point, by the method that the defines name for its type.
///
/// value  0..1
/// params slot      of the light's shadow, from its buffer; below 0: it casts none
///        wi_w      to the light, unit, world axes
///        distance  to the light, m; 0 where its light does not reach
#if defined(DIRECTIONAL_SHADOW_RAYS) || defined(POINT_SHADOW_RAYS) || defined(SPOT_SHADOW_RAYS)
#define SHADOW_RAYS
#elif defined(AREA_SHADOWS) || defined(AREA_HARD_SHADOWS) || defined(ENVIRONMENT_SHADOWS)
#define SHADOW_RAYS
#endif

#ifdef SHADOW_RAYS
#include "shadow/rays.glsl"

/// Light from below the horizon of the shading normal is not reflected: no ray is cast for it.
float light_visibility_by_ray(float slot, LightReceiver r, vec3 wi_w, float distance)
{
    bool wanted = slot >= 0.0 && dot(r.frame.n, wi_w) > 0.0;
    return wanted ? ray_visibility_through(r.position, r.geometric_normal, wi_w, distance, r.behind) : 1.0;
}
#endif
#if defined(DIRECTIONAL_SHADOW_MAPS) || defined(POINT_SHADOW_MAPS) || defined(SPOT_SHADOW_MAPS) || defined(AREA_MAP_SHADOWS)
#include "shadow/maps.glsl"
#endif
#ifdef AREA_MAP_SHADOWS
#include "shadow/soft_maps.glsl"
#endif

#if defined(DIRECTIONAL_SHADOW_RAYS)
float light_visibility_directional(float slot, LightReceiver r, vec3 wi_w)
{
    return light_visibility_by_ray(slot, r, wi_w, uintBitsToFloat(0x7f800000u));
}
#elif defined(DIRECTIONAL_SHADOW_MAPS)
float light_visibility_directional(float slot, LightReceiver r, vec3 wi_w)
{
    return shadow_maps_directional(slot, r, wi_w);
}
#endif

#if defined(POINT_SHADOW_RAYS)
float light_visibility_point(float slot, LightReceiver r, vec3 wi_w, float distance)
{
    return light_visibility_by_ray(slot, r, wi_w, distance);
}
#elif defined(POINT_SHADOW_MAPS)
float light_visibility_point(float slot, LightReceiver r, vec3 wi_w, float distance)
{
    return shadow_maps_point(slot, r, wi_w);
}
#endif

#if defined(SPOT_SHADOW_RAYS)
float light_visibility_spot(float slot, LightReceiver r, vec3 wi_w, float distance)
{
    return light_visibility_by_ray(slot, r, wi_w, distance);
}
#elif defined(SPOT_SHADOW_MAPS)
float light_visibility_spot(float slot, LightReceiver r, vec3 wi_w, float distance)
{
    return shadow_maps_spot(slot, r, wi_w);
}
#endif
