/// area.glsl - irradiance from lights with a body, of uniform radiance, over the horizon of the surface that they light.
///
/// value  factors 0..1: irradiance / (pi radiance), which is also the share of the cosine-weighted hemisphere covered
/// frame  the receiver's: it lies at the origin, z is its normal; lengths in any unit
/// params facing: unit, the side of a rect or disk that emits; half_u, half_v, half_axis: from the centre to the edges of
///        a rect, to the centre of one of a tube's hemispherical ends
/// domain any place: behind a rect or disk 0; inside a sphere or tube 1, as its light comes from everywhere
/// source rect: Lambert's polygon (Baum, Rushmeier, Winget, SIGGRAPH 1989). disk, sphere: the boundary integral of an
///        elliptical cone in closed form, clipped by the horizon; whole, it is sin(a) sin(b) cos of the half angles a, b
///        (Heitz and Hill, SIGGRAPH course, 2017). tube: exact along it, by Gauss-Legendre quadrature across it
/// stable sizes are divided out first. Sums about the boundary cancel for small lights: there, integrals of the height
///        over the light's own plane take their place, which neglect the square of its angular size
/// error  of the factor, as a share of the light's factor if it were face on: rect, disk and sphere 2e-4; tube 1e-4 from
///        3 radii of its axis on, 1e-2 near 2 radii, 3e-2 where it touches (tests/shading/area_test.cpp)
/// twin   engine/shading/area.cpp
#include "common/constants.glsl"
#include "common/numeric.glsl"

/// The angle of (x, y) for y >= 0, in 0..pi.
float area_angle(float x, float y)
{
    float a = numeric_angle(abs(x), y);
    return x < 0.0 ? PI - a : a;
}

float area_largest(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

/// Share of the cosine-weighted hemisphere between an edge and the origin: z of the edge's normal times its angle.
float area_edge(vec3 a, vec3 b)
{
    vec3 c = cross(a, b);
    float l = length(c);
    return INV_TWO_PI * c.z / max(l, 1e-30) * area_angle(dot(a, b), l);
}

/// What has been added up of a convex polygon: the edges' share of the hemisphere, the integral of the height over the
/// polygon itself, and where the horizon is passed. Places are relative to the polygon's `center`.
struct AreaPolygon {
    vec3 center, normal;  // of the side that is seen, unit
    float share;
    float moment;
    vec3 enter, leave;
};

void area_add_side(inout AreaPolygon p, vec3 a, vec3 b)
{
    p.share += area_edge(p.center + a, p.center + b);
    p.moment -= dot(p.normal, cross(a, b)) * (3.0 * p.center.z + a.z + b.z);
}

/// Adds the part of the edge a -> b that is above the horizon, or, after all of them, the edge along the horizon (`closing`).
/// Edges run clockwise about the normal. Called from one place in a loop: compilers take long for copies of it.
void area_add_edge(inout AreaPolygon p, vec3 a, vec3 b, bool closing)
{
    float za = p.center.z + a.z, zb = p.center.z + b.z;
    bool up_a = za >= 0.0, up_b = zb >= 0.0;
    float down = za - zb;
    vec3 crossing = up_a == up_b ? a : mix(a, b, za / down);
    vec3 from = up_a ? a : crossing, to = up_b ? b : crossing;
    if (closing) {
        from = p.leave;
        to = p.enter;
    } else {
        p.leave = up_a && !up_b ? crossing : p.leave;
        p.enter = !up_a && up_b ? crossing : p.enter;
    }
    if (up_a || up_b || closing)
        area_add_side(p, from, to);
}

float area_rect_factor(vec3 center, vec3 half_u, vec3 half_v, vec3 facing)
{
    float scale = 1.0 / max(max(area_largest(center), area_largest(half_u)), max(area_largest(half_v), 1e-30));
    AreaPolygon p;
    p.center = center * scale;
    p.normal = facing;
    p.share = p.moment = 0.0;
    p.enter = p.leave = vec3(0.0);
    vec3 u = half_u * scale, v = half_v * scale;
    // Clockwise about u x v; `facing` may be either side.
    if (dot(cross(u, v), facing) < 0.0)
        u = -u;
    vec3 a = u + v, b = u - v;
    int i = 0;
    do {
        area_add_edge(p, a, b, i == 4);
        vec3 next = -a;
        a = b;
        b = next;
    } while (++i < 5);
    float above = -dot(p.center, facing);
    float d2 = dot(p.center, p.center);
    bool small = dot(u, u) + dot(v, v) < 5e-5 * d2;
    float factor = small ? INV_PI / 6.0 * p.moment * above / (d2 * d2) : p.share;
    return above > 0.0 ? clamp(factor, 0.0, 1.0) : 0.0;
}

/// The part above the horizon of an elliptical cone.
/// n: the horizon's normal in the cone's frame (x across the wider half angle a, y across the narrower b, z its axis);
/// k = sqrt(sin^2 a - sin^2 b) / cos a, 0 for a round one.
float area_cone_factor(vec3 n, float sin_a, float cos_a, float sin_b, float k)
{
    float root = sqrt(1.0 + k * k);
    float cos_b = cos_a * root;
    // The height of the boundary at azimuth psi (stretched so that the boundary is a circle): x cos psi + y sin psi + z.
    vec3 h = vec3(sin_a * cos_b * n.x, cos_a * sin_b * n.y, cos_a * cos_b * n.z);
    float r = length(h.xy);
    float t = clamp(h.z / max(r, 1e-30), -1.0, 1.0);
    float s = sqrt((1.0 - t) * (1.0 + t));
    float delta = area_angle(-t, s);  // above where |psi - psi0| < delta
    vec2 middle = h.xy / max(r, 1e-30);
    vec2 first = vec2(-t * middle.x + s * middle.y, -t * middle.y - s * middle.x);  // cos, sin
    vec2 last = vec2(-t * middle.x - s * middle.y, -t * middle.y + s * middle.x);

    // Integral of r x dr / |r|^2 along the boundary.
    float k1 = k / root;
    vec2 y1 = abs(vec2(first.y, last.y)) * k1;
    vec2 atanh1 = vec2(numeric_log1p_ratio(2.0 * y1.x / max(1.0 - y1.x, 1e-7)) / max(1.0 - y1.x, 1e-7),
                       numeric_log1p_ratio(2.0 * y1.y / max(1.0 - y1.y, 1e-7)) / max(1.0 - y1.y, 1e-7));
    vec2 x2 = max(abs(vec2(first.x, last.x)) * k, vec2(1e-20));
    vec2 atan2 = vec2(numeric_angle(1.0, x2.x), numeric_angle(1.0, x2.y)) / x2;
    float about_x = -sin_b * cos_a / root * (last.y * atanh1.y - first.y * atanh1.x);
    float about_y = sin_a * cos_b * root * (last.x * atan2.y - first.x * atan2.x);
    float turn = area_angle(cos_b * cos_b * first.x * last.x + cos_a * cos_a * first.y * last.y,
                            cos_a * cos_b * abs(2.0 * s * t));
    float about_z = sin_a * sin_b * (t > 0.0 ? TWO_PI - turn : turn);
    vec3 d1 = vec3(sin_a * cos_b * first.x, cos_a * sin_b * first.y, cos_a * cos_b);
    vec3 d2 = vec3(sin_a * cos_b * last.x, cos_a * sin_b * last.y, cos_a * cos_b);
    float closing = area_angle(dot(d1, d2), length(cross(d1, d2)));
    float clipped = INV_TWO_PI * (dot(n, vec3(about_x, about_y, about_z)) + closing);

    // Height over the ellipse in the plane across the axis.
    float flat_height = INV_PI * r * (t * (delta + t * s) + 2.0 / 3.0 * s * s * s);
    float whole = n.z;
    float partial = sin_a < 0.02 ? sin_a * sin_b * flat_height : clipped;
    float factor = t >= 1.0 ? sin_a * sin_b * whole : t <= -1.0 ? 0.0 : partial;
    return clamp(factor, 0.0, 1.0);
}

/// Half angles and frame of the cone under which a disk is seen.
struct AreaCone {
    vec3 x, y, z;  // unit: across the wider half angle, across the narrower, axis
    float sin_a, cos_a, sin_b, k;
};

/// `above` must be positive: the distance of the origin from the disk's plane, on the side that emits.
AreaCone area_disk_cone(vec3 center, vec3 facing, float radius)
{
    float scale = 1.0 / max(area_largest(center), radius);
    vec3 c = center * scale;
    float r = radius * scale;
    float above = max(-dot(c, facing), 1e-6);
    vec3 offset = c - dot(c, facing) * facing;  // from the foot of the perpendicular to the centre
    float o = length(offset);
    // Any direction in the plane will do where the foot is the centre; near it, rounding has turned it out of the plane.
    vec3 side = abs(facing.z) < 0.7 ? vec3(-facing.y, facing.x, 0.0) : vec3(0.0, -facing.z, facing.y);
    vec3 along = o > 1e-6 ? offset / o : side;
    along = normalize(along - dot(along, facing) * facing);
    vec3 near_point = (o - r) * along - above * facing, far_point = (o + r) * along - above * facing;
    float near = length(near_point), far = length(far_point);
    float product = near * far;
    // (near + far)^2 - 4 r^2 = 2 (q + product), product^2 = q^2 + 4 above^2 r^2
    float q = above * above + (o - r) * (o + r);
    float gap = q >= 0.0 ? q + product : 4.0 * above * above * r * r / (product - q);
    float sum = near + far;
    AreaCone cone;
    cone.sin_a = min(2.0 * r / sum, 1.0);
    cone.cos_a = sqrt(2.0 * gap) / sum;
    cone.k = 2.0 * r * o / (sum * sqrt(product));
    float cos_b = cone.cos_a * sqrt(1.0 + cone.k * cone.k);
    cone.sin_b = min(r * above / (product * cos_b), cone.sin_a);
    // The axis halves the angle between both ends: by their sum, or, where they nearly oppose each other, their difference.
    cone.x = cross(facing, along);
    bool wide = dot(near_point, far_point) < 0.0;
    vec3 halving = normalize(wide ? far_point / far - near_point / near : far_point / far + near_point / near);
    cone.y = wide ? halving : cross(halving, cone.x);
    cone.z = wide ? cross(cone.x, halving) : halving;
    return cone;
}

float area_disk_factor(vec3 center, vec3 facing, float radius)
{
    AreaCone cone = area_disk_cone(center, facing, radius);
    float factor = area_cone_factor(vec3(cone.x.z, cone.y.z, cone.z.z), cone.sin_a, cone.cos_a, cone.sin_b, cone.k);
    return dot(center, facing) < 0.0 ? factor : 0.0;
}

float area_sphere_factor(vec3 center, float radius)
{
    float scale = 1.0 / max(area_largest(center), radius);
    vec3 c = center * scale;
    float r = radius * scale;
    float d = length(c);
    float sine = min(r / d, 1.0);
    float cosine = sqrt(max((d - r) * (d + r), 0.0)) / d;
    float factor = area_cone_factor(vec3(length(c.xy), 0.0, c.z) / d, sine, cosine, sine, 0.0);
    return d > r ? factor : 1.0;
}

/// A tube from outside its cylinder, with what its slices by planes through the origin along its axis share.
struct AreaTube {
    vec3 across, side, along;  // unit: from the origin to the axis, across both, axis
    float distance;            // to the axis
    float z1, z2;              // of the ends' centres along the axis
    float span;                // z2 - z1, which would cancel
    float w1, w2;              // sqrt(z^2 + distance^2 - radius^2)
    float radius;
};

/// A slice at an angle about the axis: the directions to its lower and upper end, and the angle between them.
struct AreaSlice {
    float sin_g, cos_g;  // of the angle about the axis, from `across` to `side`
    vec2 lower, upper;   // unit, in the slice: away from the axis, along it
    float sin_between, cos_between;
};

AreaTube area_tube(vec3 center, vec3 half_axis, float radius)
{
    AreaTube tube;
    float half_length = length(half_axis);
    tube.along = half_length > 1e-18 ? half_axis / half_length : vec3(1.0, 0.0, 0.0);
    float z = dot(center, tube.along);
    vec3 p = center - z * tube.along;
    tube.distance = length(p);
    vec3 other = abs(tube.along.z) < 0.7 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    tube.across = tube.distance > 1e-18 ? p / tube.distance : normalize(cross(tube.along, other));
    tube.side = cross(tube.along, tube.across);
    tube.z1 = z - half_length;
    tube.z2 = z + half_length;
    tube.span = 2.0 * half_length;
    float gap = max((tube.distance - radius) * (tube.distance + radius), 0.0);
    tube.w1 = sqrt(tube.z1 * tube.z1 + gap);
    tube.w2 = sqrt(tube.z2 * tube.z2 + gap);
    tube.radius = radius;
    return tube;
}

/// `y`: sin_g as a share of its largest, -1..1; `left` = sqrt(1 - y^2).
AreaSlice area_tube_slice(AreaTube tube, float y, float left)
{
    AreaSlice slice;
    slice.sin_g = min(tube.radius / tube.distance, 1.0) * y;
    slice.cos_g = sqrt(max((1.0 - slice.sin_g) * (1.0 + slice.sin_g), 1e-14));
    float x = tube.distance * slice.cos_g;
    float rho = tube.radius * left;
    float d1 = 1.0 / (tube.z1 * tube.z1 + x * x), d2 = 1.0 / (tube.z2 * tube.z2 + x * x);
    slice.lower = vec2(x * tube.w1 + tube.z1 * rho, tube.z1 * tube.w1 - x * rho) * d1;
    slice.upper = vec2(x * tube.w2 - tube.z2 * rho, tube.z2 * tube.w2 + x * rho) * d2;
    // The cross product of both, whose terms do not cancel.
    slice.sin_between = (tube.span * x * (tube.w1 * tube.w2 - rho * rho)
                         + rho * (tube.w1 + tube.w2) * (x * x + tube.z1 * tube.z2)) * (d1 * d2);
    slice.cos_between = dot(slice.lower, slice.upper);
    return slice;
}

/// Integral of the height over a slice, above the horizon.
float area_tube_node(AreaTube tube, float y, float left)
{
    AreaSlice slice = area_tube_slice(tube, y, left);
    vec2 up = vec2(slice.cos_g * tube.across.z + slice.sin_g * tube.side.z, tube.along.z);
    vec2 level = vec2(up.y, -up.x) / max(length(up), 1e-30);
    bool cut_lower = dot(up, slice.lower) < 0.0, cut_upper = dot(up, slice.upper) < 0.0;
    vec2 a = cut_lower ? level : slice.lower;
    vec2 b = cut_upper ? -level : slice.upper;
    float s = cut_lower || cut_upper ? a.x * b.y - a.y * b.x : slice.sin_between;
    s = max(s, 0.0);
    float angle = area_angle(dot(a, b), s);
    vec2 twice = vec2(a.x * b.x - a.y * b.y, a.y * b.x + a.x * b.y);  // cos, sin of the sum of both angles
    float height = 0.5 * (up.x * (angle + s * twice.x) + up.y * s * twice.y);
    return cut_lower && cut_upper ? 0.0 : max(height, 0.0) / slice.cos_g;
}

float area_tube_factor(vec3 center, vec3 half_axis, float radius)
{
    float scale = 1.0 / max(max(area_largest(center), area_largest(half_axis)), radius);
    vec3 c = center * scale;
    vec3 half_a = half_axis * scale;
    float r = radius * scale;
    AreaTube tube = area_tube(c, half_a, r);
    float nearest = clamp(0.0, tube.z1, tube.z2);
    bool inside = tube.distance * tube.distance + nearest * nearest <= r * r;
    // Off its end and within the cylinder, the nearer end hides the rest.
    float end = area_sphere_factor(tube.across * tube.distance + tube.along * nearest, r);
    // Gauss-Legendre in tau, y = sin tau, six nodes; weights with cos tau.
    float sum = 0.00906973166 * (area_tube_node(tube, 0.994379147, 0.105877817) + area_tube_node(tube, -0.994379147, 0.105877817));
    sum += 0.0915261755 * (area_tube_node(tube, 0.861707499, 0.507405347) + area_tube_node(tube, -0.861707499, 0.507405347));
    sum += 0.217713979 * (area_tube_node(tube, 0.366107024, 0.930572752) + area_tube_node(tube, -0.366107024, 0.930572752));
    float factor = min(sum * r / max(tube.distance, r), 1.0);
    return inside ? 1.0 : tube.distance <= r ? end : factor;
}
