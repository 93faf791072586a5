/// area_sample.glsl - points on lights with a body, as a surface sees them, and where a ray meets a body.
///
/// value  directions towards the light, each with the solid angle that it stands for: the mean of f(direction) solid_angle
///        over u in [0, 1)^2 is the integral of f over the directions in which the light is seen
/// frame  the receiver at the origin, any axes; lengths in any unit
/// params as in light/area.glsl
/// domain as in light/area.glsl; solid angle 0 where nothing of the light is seen. From inside a tube its surface is at
///        distance 0: nothing within it is in the way of its light
/// source rect: Urena, Fajardo, King, "An area-preserving parametrization for spherical rectangles", EGSR 2013; small
///        ones by area. sphere: uniform in solid angle. disk: the elliptical cone that it is seen under, uniform where that
///        is round or narrow. tube: uniform in the angle about its axis, and in solid angle along it
/// stable small solid angles come from sines and sums of products, not from differences of angles
/// error  of the solid angle: relative 2e-4 (rect), 1e-5 (others) (tests/shading/area_sample_test.cpp)
/// twin   engine/reference/body_view.cpp
#include "light/area.glsl"

struct AreaSample {
    vec3 direction;     // unit
    float distance;     // to the light's surface
    float solid_angle;  // sr
};

/// Two directions across the unit vector z.
void area_axes(vec3 z, out vec3 x, out vec3 y)
{
    float s = z.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + z.z);
    float b = z.x * z.y * a;
    x = vec3(1.0 + s * z.x * z.x * a, s * b, -s * z.x);
    y = vec3(b, s + z.y * z.y * a, -z.y);
}

/// A sphere as one place sees it.
struct AreaSphereView {
    vec3 axis;         // unit, to the centre
    float scale;       // all lengths are divided by it
    float distance, radius;
    bool inside;       // then it is seen in all directions
};

AreaSphereView area_sphere_view(vec3 center, float radius)
{
    AreaSphereView v;
    v.scale = max(max(area_largest(center), radius), 1e-30);
    vec3 c = center / v.scale;
    v.radius = radius / v.scale;
    v.distance = length(c);
    v.inside = v.distance <= v.radius;
    v.axis = v.distance > 1e-6 ? c / v.distance : vec3(0.0, 0.0, 1.0);
    return v;
}

AreaSample area_sphere_sample(AreaSphereView v, vec2 u)
{
    float gap = max((v.distance - v.radius) * (v.distance + v.radius), 0.0);
    float sin_a = v.inside ? 1.0 : v.radius / v.distance;
    float cos_a = v.inside ? 0.0 : sqrt(gap) / v.distance;
    float most = v.inside ? 2.0 : sin_a * sin_a / (1.0 + cos_a);  // 1 - cos of the half angle
    float cap = u.x * most;
    float sine2 = max(cap * (2.0 - cap), 0.0);
    vec3 x, y;
    area_axes(v.axis, x, y);
    vec2 turn = numeric_cos_sin(TWO_PI * u.y);
    vec3 direction = (x * turn.x + y * turn.y) * sqrt(sine2) + v.axis * (1.0 - cap);
    float root = sqrt(max(v.radius * v.radius - v.distance * v.distance * sine2, 0.0));
    float along = v.distance * (1.0 - cap);
    // The nearer of two places is their product, over the farther one.
    float distance = v.inside ? max(along + root, 0.0) : gap / (along + root);
    return AreaSample(direction, v.scale * distance, TWO_PI * most);
}

/// A disk as one place sees it.
struct AreaDiskView {
    AreaCone cone;
    vec3 facing;
    float above;  // of the place over the disk's plane, on the side that emits
    float cos_b, ratio;
};

AreaDiskView area_disk_view(vec3 center, vec3 facing, float radius)
{
    AreaDiskView v;
    v.cone = area_disk_cone(center, facing, radius);
    v.facing = facing;
    v.above = -dot(center, facing);
    v.cos_b = v.cone.cos_a * sqrt(1.0 + v.cone.k * v.cone.k);
    v.ratio = v.cone.sin_b / v.cone.sin_a;
    return v;
}

AreaSample area_disk_sample(AreaDiskView v, vec2 u)
{
    // The azimuth phi about the cone's axis is stretched by the ratio of both widths, so that equal parts of u are equal
    // parts of a narrow ellipse.
    vec2 turn = numeric_cos_sin(TWO_PI * u.y);
    vec2 stretched = vec2(turn.x, v.ratio * turn.y);
    float length2 = max(dot(stretched, stretched), 1e-37);
    vec2 phi = stretched * inversesqrt(length2);
    // The boundary's angle theta from the axis: 1 / tan^2 theta = cos^2 phi / tan^2 a + sin^2 phi / tan^2 b
    vec2 q = phi * vec2(v.cone.cos_a * v.ratio, v.cos_b);
    float sine2 = v.cone.sin_b * v.cone.sin_b;
    float norm = sine2 + dot(q, q);
    sine2 /= norm;
    float most = sine2 / (1.0 + sqrt(dot(q, q) / norm));  // 1 - cos theta
    float cap = u.x * most;
    vec3 direction = (v.cone.x * phi.x + v.cone.y * phi.y) * sqrt(cap * (2.0 - cap)) + v.cone.z * (1.0 - cap);
    float solid_angle = TWO_PI * most * v.ratio / length2;
    float distance = v.above / max(-dot(direction, v.facing), 1e-7);
    return AreaSample(direction, distance, v.above > 0.0 ? solid_angle : 0.0);
}

/// A tube as one place sees it.
struct AreaTubeView {
    AreaTube tube;
    AreaSphereView end;  // all that is seen from off its end, within its cylinder, and from inside
    float scale;
    float reach;         // half the angle under which the cylinder is seen
    bool beside, inside;
};

AreaTubeView area_tube_view(vec3 center, vec3 half_axis, float radius)
{
    AreaTubeView v;
    v.scale = max(max(area_largest(center), area_largest(half_axis)), max(radius, 1e-30));
    vec3 c = center / v.scale;
    float r = radius / v.scale;
    v.tube = area_tube(c, half_axis / v.scale, r);
    float d = v.tube.distance;
    v.beside = d > r;
    v.reach = numeric_angle(sqrt(max((d - r) * (d + r), 0.0)), r);
    vec3 nearest = v.tube.across * d + v.tube.along * clamp(0.0, v.tube.z1, v.tube.z2);
    v.end = area_sphere_view(nearest, r);
    v.inside = length(nearest) <= r;
    return v;
}

AreaSample area_tube_sample(AreaTubeView v, vec2 u)
{
    AreaSample end = area_sphere_sample(v.end, u);
    end.distance *= v.inside ? 0.0 : v.scale;
    float r = v.tube.radius;
    float g = v.reach * (2.0 * u.y - 1.0);
    float y = clamp(numeric_cos_sin(g).y * v.tube.distance / r, -1.0, 1.0);
    float left = sqrt((1.0 - y) * (1.0 + y));
    AreaSlice slice = area_tube_slice(v.tube, y, left);
    // Difference of the sines of both ends: tan of half the angle between, times the sum of the cosines.
    float rise = max(slice.sin_between, 0.0) / max(1.0 + slice.cos_between, 1e-7) * (slice.lower.x + slice.upper.x);
    float sine = clamp(slice.lower.y + u.x * rise, -1.0, 1.0);
    float cosine = sqrt((1.0 - sine) * (1.0 + sine));
    vec3 direction = (v.tube.across * slice.cos_g + v.tube.side * slice.sin_g) * cosine + v.tube.along * sine;
    // The slice is a strip with round ends.
    float x = v.tube.distance * slice.cos_g, rho = r * left;
    float straight = (x - rho) / max(cosine, 1e-7);
    float z = straight * sine;
    float z_end = clamp(z, v.tube.z1, v.tube.z2);
    float off = x * sine - z_end * cosine;
    float round = x * cosine + z_end * sine - sqrt(max(rho * rho - off * off, 0.0));
    float distance = v.scale * max(z == z_end ? straight : round, 0.0);
    AreaSample beside = AreaSample(direction, distance, 2.0 * v.reach * rise);
    return AreaSample(v.beside ? beside.direction : end.direction, v.beside ? beside.distance : end.distance,
                      v.beside ? beside.solid_angle : end.solid_angle);
}

/// A rect as one place sees it; in its own axes: along its width, along its height, and the side that emits.
struct AreaRectView {
    vec3 x, y, z;
    float scale;
    vec3 low, high;  // corners; z of both is minus the height of the place over the plane
    vec2 size;       // not their difference, which cancels
    float solid_angle;
    float b0, b1, k, turn;  // of the spherical rectangle; the angle from k on that it takes
    bool spherical;
};

/// Solid angle of a triangle seen from the origin (van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983).
float area_triangle(vec3 a, vec3 b, vec3 c)
{
    float la = length(a), lb = length(b), lc = length(c);
    return 2.0 * area_angle(la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la, abs(dot(a, cross(b - a, c - a))));
}

/// Angle between two unit vectors.
float area_between(vec3 a, vec3 b) { return area_angle(dot(a, b), length(cross(a, b))); }

AreaRectView area_rect_view(vec3 center, vec3 facing, vec3 axis, float half_width, float half_height)
{
    AreaRectView v;
    v.x = axis;
    v.y = cross(facing, axis);
    v.z = facing;
    v.scale = max(max(area_largest(center), max(half_width, half_height)), 1e-30);
    vec3 c = vec3(dot(center, v.x), dot(center, v.y), dot(center, v.z)) / v.scale;
    vec2 size = vec2(half_width, half_height) / v.scale;
    bool behind = !(c.z < 0.0);
    c.z = min(c.z, -1e-7);
    v.size = 2.0 * size;
    v.low = vec3(c.xy - size, c.z);
    v.high = vec3(c.xy + size, c.z);
    vec3 a = v.low, b = vec3(v.high.x, v.low.yz), d = vec3(v.low.x, v.high.yz);
    v.solid_angle = area_triangle(a, b, v.high) + area_triangle(a, v.high, d);
    vec3 n0 = normalize(cross(a, b)), n1 = normalize(cross(b, v.high)), n2 = normalize(cross(v.high, d)), n3 = normalize(cross(d, a));
    v.b0 = n0.z;
    v.b1 = n2.z;
    v.k = TWO_PI - area_between(-n2, n3) - area_between(-n3, n0);
    v.turn = area_between(-n0, n1) + area_between(-n1, n2) - v.k;
    v.spherical = v.solid_angle > 0.01;
    if (behind)
        v.solid_angle = 0.0;
    return v;
}

AreaSample area_rect_sample(AreaRectView v, vec2 u)
{
    float z = v.low.z;
    vec2 turn = numeric_cos_sin(u.x * v.turn + v.k);
    float fu = (turn.x * v.b0 - v.b1) / (abs(turn.y) > 1e-7 ? turn.y : 1e-7);
    float cu = clamp((fu < 0.0 ? -1.0 : 1.0) * inversesqrt(max(fu * fu + v.b0 * v.b0, 1e-30)), -1.0, 1.0);
    float x = clamp(-cu * z * inversesqrt(max((1.0 - cu) * (1.0 + cu), 1e-12)), v.low.x, v.high.x);
    float d2 = x * x + z * z;
    float h0 = v.low.y * inversesqrt(d2 + v.low.y * v.low.y), h1 = v.high.y * inversesqrt(d2 + v.high.y * v.high.y);
    float h = mix(h0, h1, u.y);
    float y = clamp(h * sqrt(d2 / max((1.0 - h) * (1.0 + h), 1e-12)), v.low.y, v.high.y);
    vec3 flat_point = mix(v.low, v.high, vec3(u, 0.0));
    vec3 p = v.spherical ? vec3(x, y, z) : flat_point;
    float distance2 = dot(p, p);
    float distance = sqrt(distance2);
    float by_area = v.size.x * v.size.y * -z / (distance2 * distance);
    p /= distance;
    float solid_angle = v.spherical ? v.solid_angle : v.solid_angle > 0.0 ? by_area : 0.0;
    return AreaSample(v.x * p.x + v.y * p.y + v.z * p.z, v.scale * distance, solid_angle);
}
