/// area_reflected.glsl - what a surface reflects towards the eye of a whole light with a body, unshadowed and per unit of
/// radiance: the plan sets AREA_ANALYTIC for models that have it in closed form.
///
/// AREA_LAMBERT: ideally diffuse, k_d times the light's factor.

/// A light with a body as one fragment sees it.
struct AreaLight {
    vec3 center;    // from the fragment, world axes, m
    vec3 axis;      // unit: along a rect's width, along a tube
    vec3 facing;    // unit: the side of a rect or disk that emits
    float a, b;     // rect: half width, half height; disk, sphere: radius; tube: half length, radius; m
    vec3 radiance;  // with the window of its range
    float slot;     // of its shadow; -1: casts none
};

#ifdef AREA_LAMBERT
vec3 area_lambert(LightReceiver r, MODEL_PARAMS p, float factor)
{
    return r.wo.z > 0.0 ? model_ambient(p) * factor : vec3(0.0);
}

vec3 area_local(LightReceiver r, vec3 v) { return frame_to_local(r.frame, v); }

#ifdef RECT_LIGHTS
vec3 area_reflected_rect(AreaLight light, LightReceiver r, MODEL_PARAMS p)
{
    return area_lambert(r, p, area_rect_factor(area_local(r, light.center), area_local(r, light.axis) * light.a,
                                               area_local(r, cross(light.facing, light.axis)) * light.b,
                                               area_local(r, light.facing)));
}
#endif
#ifdef DISK_LIGHTS
vec3 area_reflected_disk(AreaLight light, LightReceiver r, MODEL_PARAMS p)
{
    return area_lambert(r, p, area_disk_factor(area_local(r, light.center), area_local(r, light.facing), light.a));
}
#endif
#ifdef SPHERE_LIGHTS
vec3 area_reflected_sphere(AreaLight light, LightReceiver r, MODEL_PARAMS p)
{
    return area_lambert(r, p, area_sphere_factor(area_local(r, light.center), light.a));
}
#endif
#ifdef TUBE_LIGHTS
vec3 area_reflected_tube(AreaLight light, LightReceiver r, MODEL_PARAMS p)
{
    return area_lambert(r, p, area_tube_factor(area_local(r, light.center), area_local(r, light.axis) * light.a, light.b));
}
#endif
#endif
