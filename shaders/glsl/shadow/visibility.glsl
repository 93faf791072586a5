/// visibility.glsl - how much of a light reaches a point, by the method that the defines name for its type.
///
/// value  0..1
/// params slot      of the light's shadow, from its buffer; below 0: it casts none
///        wi_w      to the light, unit, world axes
///        distance  to the light, m
#if defined(DIRECTIONAL_SHADOW_MAPS) || defined(POINT_SHADOW_MAPS) || defined(SPOT_SHADOW_MAPS)
#include "shadow/maps.glsl"
#endif

#ifdef DIRECTIONAL_SHADOW_MAPS
float light_visibility_directional(float slot, LightReceiver r, vec3 wi_w)
{
    return shadow_maps_directional(slot, r, wi_w);
}
#endif

#ifdef POINT_SHADOW_MAPS
float light_visibility_point(float slot, LightReceiver r, vec3 wi_w, float distance)
{
    return shadow_maps_point(slot, r, wi_w);
}
#endif

#ifdef SPOT_SHADOW_MAPS
float light_visibility_spot(float slot, LightReceiver r, vec3 wi_w, float distance)
{
    return shadow_maps_spot(slot, r, wi_w);
}
#endif
