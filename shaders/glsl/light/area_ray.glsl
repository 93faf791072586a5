/// area_ray.glsl - where a ray from a surface meets a light with a body.
///
/// value  distance in lengths of `direction` (unit), or AREA_MISSED
/// frame  the ray's origin at 0, any axes; lengths in any unit
/// params as in light/area.glsl
/// domain any place; from inside a sphere or tube the way out. A rect or disk is not met from behind
/// stable what a sphere's centre is off the ray comes from the difference of both, not from their squares' difference
/// error  2e-6 of the centre's distance and the light's size (tests/reference/area_sample_test.cpp)
/// twin   engine/reference/body_view.cpp

const float AREA_MISSED = 1e38;

float area_plane_ray(vec3 center, vec3 facing, vec3 direction)
{
    float toward = -dot(direction, facing);
    float above = -dot(center, facing);
    return toward > 0.0 && above > 0.0 ? above / max(toward, 1e-30) : AREA_MISSED;
}

float area_rect_ray(vec3 center, vec3 facing, vec3 axis, float half_width, float half_height, vec3 direction)
{
    float t = area_plane_ray(center, facing, direction);
    vec3 off = min(t, 1e30) * direction - center;
    bool on = abs(dot(off, axis)) <= half_width && abs(dot(off, cross(facing, axis))) <= half_height;
    return on ? t : AREA_MISSED;
}

float area_disk_ray(vec3 center, vec3 facing, float radius, vec3 direction)
{
    float t = area_plane_ray(center, facing, direction);
    return length(min(t, 1e30) * direction - center) <= radius ? t : AREA_MISSED;
}

/// Both places where the ray's line meets a sphere, the nearer first; (1, 0) where there are none.
vec2 area_sphere_span(vec3 center, float radius, vec3 direction)
{
    float along = dot(center, direction);
    float off = length(center - along * direction);
    float root = sqrt(max((radius - off) * (radius + off), 0.0));
    return off <= radius ? vec2(along - root, along + root) : vec2(1.0, 0.0);
}

float area_sphere_ray(vec3 center, float radius, vec3 direction)
{
    vec2 span = area_sphere_span(center, radius, direction);
    bool inside = length(center) <= radius;
    float t = inside ? max(span.y, 0.0) : span.x;
    return inside || (span.x <= span.y && span.x >= 0.0) ? t : AREA_MISSED;
}

float area_tube_ray(vec3 center, vec3 half_axis, float radius, vec3 direction)
{
    float half_length = length(half_axis);
    vec3 along = half_length > 1e-18 ? half_axis / half_length : vec3(1.0, 0.0, 0.0);
    // The cylinder, seen along its axis.
    vec3 across = direction - dot(direction, along) * along;
    vec3 to_axis = center - dot(center, along) * along;
    float a = length(across);
    vec2 barrel = area_sphere_span(to_axis, radius, across / max(a, 1e-18)) / max(a, 1e-18);
    // Places on the cylinder count between its ends, those on the ends' spheres always: the first is the tube's.
    vec2 z = abs(barrel * dot(direction, along) - dot(center, along));
    vec2 end1 = area_sphere_span(center - half_axis, radius, direction);
    vec2 end2 = area_sphere_span(center + half_axis, radius, direction);
    bool on_barrel = a > 1e-18 && barrel.x <= barrel.y;
    float first = on_barrel && z.x <= half_length ? barrel.x : AREA_MISSED;
    float last = on_barrel && z.y <= half_length ? barrel.y : -AREA_MISSED;
    if (end1.x <= end1.y) {
        first = min(first, end1.x);
        last = max(last, end1.y);
    }
    if (end2.x <= end2.y) {
        first = min(first, end2.x);
        last = max(last, end2.y);
    }
    float nearest = clamp(dot(center, along), -half_length, half_length);
    bool inside = length(center - nearest * along) <= radius;
    return inside ? max(last, 0.0) : first >= 0.0 ? first : AREA_MISSED;
}
