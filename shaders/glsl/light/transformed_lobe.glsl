/// transformed_lobe.glsl - what a surface reflects of a whole light with a body, by lobes fitted to its model.
///
/// value  the integral of f_r cos(theta_i) over the light's directions, no unit: times the light's radiance
/// frame  the receiver's: it lies at the origin, z is its normal. Lobes have frames of their own, about the mirrored
///        direction: x in the plane of incidence, y across it
/// params tables of engine/fit/area_table.hpp in the buffer of common/table.glsl, from row `first` on
/// domain any place of the light; 0 for what is below the horizon of the surface
/// source Heitz, Dupuy, Hill and Neubelt, "Real-time polygonal-light shading with linearly transformed cosines", ACM TOG
///        35(4), 2016, with powers of the cosine; the integral over a polygon about its boundary: P(tan^2) dpsi / (2 pi),
///        P what of the lobe is within that angle of its axis
/// stable clipped twice: at the surface's horizon, then at the lobe's equator; P by forms of exp and log that keep small
///        values; small lights by the density at their centre times their solid angle
/// error  of the integral, as a share of the lobe's energy: 8 nodes an edge, 2e-4 rms; cosines (k = 1) in closed form
///        (tests/fit/polygon_test.cpp); of the fits: docs/area_fits.md
/// twin   engine/fit/transformed_lobe.cpp
///
/// LOBE_COUNT: lobes of a table, 0 (Lambert alone), 2 or 4 (two of each term). LOBE_COSINES: k = 1 in all. LOBE_WIDTHS:
/// tables span widths. LOBE_NODES: 4, 8 or 16 an edge.
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/numeric.glsl"
#include "common/table.glsl"
#include "light/area.glsl"

#ifndef LOBE_NODES
#define LOBE_NODES 8
#endif

/// N = (a 0 b; 0 c 0; d 0 1) in the frame of lobes, then cos^k about z.
struct TransformedLobe {
    float a, b, c, d;
    float k;
    vec3 weight;
};

/// 1 - (1 + t2)^(-(k + 1) / 2): what of cos^k is where tan^2 of the angle to its axis is below t2.
float lobe_within(float t2, float k)
{
    float y = 0.5 * (k + 1.0) * numeric_log1p(min(t2, 1e30));
    float small = y * (1.0 - y * (0.5 - y * (1.0 / 6.0 - y / 24.0)));
    return y < 0.05 ? small : 1.0 - numeric_exp(-y);
}

/// Gauss's rule from -1 to 1: nodes of one half, and their weights.
#if LOBE_NODES == 4
const vec2 LOBE_RULE[2] = vec2[2](vec2(0.3399810436, 0.6521451549), vec2(0.8611363116, 0.3478548451));
#elif LOBE_NODES == 8
const vec2 LOBE_RULE[4] = vec2[4](vec2(0.1834346425, 0.3626837834), vec2(0.5255324099, 0.3137066459),
                                  vec2(0.7966664774, 0.2223810345), vec2(0.9602898565, 0.1012285363));
#elif LOBE_NODES == 16
const vec2 LOBE_RULE[8] = vec2[8](vec2(0.0950125098, 0.1894506105), vec2(0.2816035508, 0.1826034150),
                                  vec2(0.4580167777, 0.1691565194), vec2(0.6178762444, 0.1495959888),
                                  vec2(0.7554044084, 0.1246289713), vec2(0.8656312024, 0.0951585117),
                                  vec2(0.9445750231, 0.0622535239), vec2(0.9894009350, 0.0271524594));
#else
#error "LOBE_NODES must be 4, 8 or 16"
#endif

/// Sums over the nodes +-t of a Gauss rule along an edge.
float lobe_pair(float t, float t2_foot, vec2 middle, float half_angle, float k)
{
    vec2 turn = numeric_cos_sin(half_angle * t);
    float p = middle.x * turn.x, q = middle.y * turn.y;
    vec2 cosine = max(abs(vec2(p - q, p + q)), vec2(1e-15));
    return lobe_within(t2_foot / (cosine.x * cosine.x), k) + lobe_within(t2_foot / (cosine.y * cosine.y), k);
}

/// The part of the boundary's integral along the edge a -> b, both mapped by N and with z >= 0: at most the edge's azimuth
/// over 2 pi, positive counter-clockwise.
float lobe_power_edge(vec3 a, vec3 b, float k)
{
    float c = a.x * b.y - a.y * b.x;
    float angle = area_angle(a.x * b.x + a.y * b.y, abs(c));
    // The plane through the origin and the edge meets the plane z = 1 in a line; its foot is nearest to the axis.
    vec2 e = vec2(b.x * a.z - a.x * b.z, b.y * a.z - a.y * b.z);
    float e2 = max(dot(e, e), 1e-36);
    float t2_foot = c * c / e2;
    vec2 foot = vec2(e.y, -e.x) * (inversesqrt(e2) * (c >= 0.0 ? 1.0 : -1.0));
    vec2 from = a.xy * inversesqrt(max(dot(a.xy, a.xy), 1e-36));
    vec2 to = b.xy * inversesqrt(max(dot(b.xy, b.xy), 1e-36));
    // Cosine and sine of the angle from the foot to the middle of the edge; of two opposite ends the foot is the middle.
    vec2 sum = from + to;
    float length2 = dot(sum, sum);
    vec2 m = length2 > 1e-6 ? sum * inversesqrt(length2) : foot;
    vec2 middle = vec2(dot(m, foot), foot.x * m.y - foot.y * m.x);
    float h = (c >= 0.0 ? 0.5 : -0.5) * angle;
    float total = 0.0;
    int i = 0;
    do
        total += LOBE_RULE[i].y * lobe_pair(LOBE_RULE[i].x, t2_foot, middle, h, k);
    while (++i < LOBE_NODES / 2);
    return INV_TWO_PI * h * total;
}

float lobe_edge(vec3 a, vec3 b, float k)
{
#ifdef LOBE_COSINES
    return area_edge(a, b);
#else
    return lobe_power_edge(a, b, k);
#endif
}

/// What has been added up of a convex polygon within one lobe: its share, and where it passes the lobe's equator.
struct LobePolygon {
    float share;
    vec2 enter, leave;
};

vec3 lobe_map(TransformedLobe l, vec3 w) { return vec3(l.a * w.x + l.b * w.z, l.c * w.y, l.d * w.x + w.z); }

void lobe_add_side(inout LobePolygon p, TransformedLobe l, vec3 a, vec3 b)
{
    bool up_a = a.z >= 0.0, up_b = b.z >= 0.0;
    float down = a.z - b.z;
    vec3 crossing = up_a == up_b ? a : mix(a, b, clamp(a.z / down, 0.0, 1.0));
    crossing.z = up_a == up_b ? crossing.z : 0.0;
    p.leave = up_a && !up_b ? crossing.xy : p.leave;
    p.enter = !up_a && up_b ? crossing.xy : p.enter;
    float side = lobe_edge(up_a ? a : crossing, up_b ? b : crossing, l.k);
    p.share += up_a || up_b ? side : 0.0;
}

/// Along the equator, where the whole lobe is within.
float lobe_closing(LobePolygon p)
{
    float c = p.leave.x * p.enter.y - p.leave.y * p.enter.x;
    float angle = area_angle(dot(p.leave, p.enter), abs(c));
    return INV_TWO_PI * (c >= 0.0 ? angle : -angle);
}

/// The density of a lobe where the origin sees `v`, mapped by N; 1/sr of mapped directions.
float lobe_mapped_density(vec3 v, float k)
{
    float z2 = v.z * v.z;
    float t2 = dot(v.xy, v.xy) / max(z2, 1e-36);
    float y = 0.5 * k * numeric_log1p(min(t2, 1e30));
    return v.z > 0.0 ? INV_TWO_PI * (k + 1.0) * numeric_exp(-y) : 0.0;
}

#if LOBE_COUNT > 0
/// Lobes of one fragment.
struct LobeFit {
    float base;
    vec3 x, y, z;  // axes of the lobes' frame in the receiver's
    TransformedLobe lobes[LOBE_COUNT];
};

/// The numbers of texel `t` of a node at fractions between rows.
vec4 lobe_row(ivec4 rows, vec2 share, int t)
{
    vec4 low = mix(table_row(rows.x + t), table_row(rows.y + t), share.x);
#ifdef LOBE_WIDTHS
    vec4 high = mix(table_row(rows.z + t), table_row(rows.w + t), share.x);
    return mix(low, high, share.y);
#else
    return low;
#endif
}

/// The lobes for the eye at `wo` (receiver's frame, above the horizon), with the colours' weights of both terms.
LobeFit lobe_fetch(int first, float width, vec3 wo, vec3 first_weight, vec3 second_weight)
{
    const int NODE_TEXELS = 1 + 2 * LOBE_COUNT;
    vec4 header = table_row(first);
    float sin2 = dot(wo.xy, wo.xy);
    float cosine = clamp(wo.z, 0.0, 1.0);
    // The angle whose squared cosine is N.V, from 0 to what N.V = 1e-4 gives.
    float place = numeric_angle(sqrt(cosine), sqrt(sin2 / (1.0 + cosine))) / 1.56079616;
    float x = clamp(place, 0.0, 1.0) * (header.x - 1.0);
    float column = min(floor(x), header.x - 2.0);
    vec2 share = vec2(x - column, 0.0);
    int low = first + 1 + int(column) * NODE_TEXELS;
    ivec4 rows = ivec4(low, low + NODE_TEXELS, low, low);
#ifdef LOBE_WIDTHS
    float y = clamp((numeric_log(max(width, 1e-30)) - header.z) * header.w, 0.0, header.y - 1.0);
    float row = min(floor(y), header.y - 2.0);
    share.y = y - row;
    int stride = int(header.x) * NODE_TEXELS;
    rows += int(row) * stride;
    rows.zw = rows.xy + stride;
#endif
    LobeFit fit;
    fit.base = lobe_row(rows, share, 0).x;
    float across = sqrt(sin2);
    vec2 plane = across > 1e-10 ? wo.xy / across : vec2(1.0, 0.0);
    fit.x = vec3(cosine * plane, across);
    fit.y = vec3(-plane.y, plane.x, 0.0);
    fit.z = vec3(-across * plane, cosine);
    for (int i = 0; i < LOBE_COUNT; ++i) {
        vec4 shape = lobe_row(rows, share, 1 + 2 * i);
        vec4 weight = lobe_row(rows, share, 2 + 2 * i);
#ifdef LOBE_COSINES
        float k = 1.0;
#else
        float k = numeric_exp(weight.w);
#endif
        float scale = inversesqrt(k + 3.0);
        fit.lobes[i].k = k;
        fit.lobes[i].a = numeric_exp(shape.x) * scale;
        fit.lobes[i].b = shape.y;
        fit.lobes[i].c = numeric_exp(shape.z) * scale;
        fit.lobes[i].d = shape.w * fit.lobes[i].a;
        fit.lobes[i].weight = weight.xyz * (i < 2 ? first_weight : second_weight);
    }
    return fit;
}

/// Sums over the lobes of a fit, edge by edge of a convex polygon above the horizon.
struct LobeSum {
    LobePolygon polygons[LOBE_COUNT];
    vec3 area;          // vector area about the first vertex, receiver's frame
    vec3 enter, leave;  // where the horizon is passed
};

LobeSum lobe_sum()
{
    LobeSum s;
    for (int i = 0; i < LOBE_COUNT; ++i)
        s.polygons[i] = LobePolygon(0.0, vec2(0.0), vec2(0.0));
    s.area = s.enter = s.leave = vec3(0.0);
    return s;
}

vec3 lobe_to_frame(LobeFit fit, vec3 w) { return vec3(dot(fit.x, w), dot(fit.y, w), dot(fit.z, w)); }

/// From `center` + a to `center` + b, both at or above the horizon.
void lobe_add_visible(inout LobeSum s, LobeFit fit, vec3 center, vec3 a, vec3 b)
{
    vec3 va = lobe_to_frame(fit, center + a), vb = lobe_to_frame(fit, center + b);
    s.area += cross(a, b);
    for (int i = 0; i < LOBE_COUNT; ++i)
        lobe_add_side(s.polygons[i], fit.lobes[i], lobe_map(fit.lobes[i], va), lobe_map(fit.lobes[i], vb));
}

/// Adds the edge from `center` + a to `center` + b, or, after all of them, the one along the horizon (`closing`). All edges
/// of a polygon run one way about it. Called from one place in a loop: compilers take seconds for copies of it.
void lobe_add_edge(inout LobeSum s, LobeFit fit, vec3 center, vec3 a, vec3 b, bool closing)
{
    float za = center.z + a.z, zb = center.z + b.z;
    bool up_a = za >= 0.0, up_b = zb >= 0.0;
    vec3 crossing = up_a == up_b ? a : mix(a, b, clamp(za / (za - zb), 0.0, 1.0));
    bool any = up_a || up_b;
    // Nothing of an edge below: from a point to itself.
    vec3 from = !any ? vec3(0.0) : up_a ? a : crossing, to = !any ? vec3(0.0) : up_b ? b : crossing;
    if (closing) {
        from = s.leave;
        to = s.enter;
    } else {
        s.leave = up_a && !up_b ? crossing : s.leave;
        s.enter = !up_a && up_b ? crossing : s.enter;
    }
    lobe_add_visible(s, fit, center, from, to);
}

/// What part of a lobe is within the polygon once all its edges and the closing one are added. `vc`: the centre of all edges in the
/// lobes' frame, `size` the largest distance of a vertex from it, in its unit.
float lobe_share(LobeSum s, LobeFit fit, int i, vec3 vc, float size)
{
    TransformedLobe l = fit.lobes[i];
    LobePolygon p = s.polygons[i];
    float share = abs(p.share + lobe_closing(p));
    // Of a small light: volume of the pyramid over the distance cubed is a third of its solid angle.
    vec3 area = 0.5 * lobe_to_frame(fit, s.area);
    vec3 v = lobe_map(l, vc);
    float v2 = max(dot(v, v), 1e-36);
    float det = (l.a - l.b * l.d) * l.c;
    float solid = abs(dot(area, vc)) * det / (v2 * sqrt(v2));
    float extent = max(l.a + abs(l.b), max(l.c, abs(l.d) + 1.0)) * size;
    bool small = extent * extent * (l.k + 3.0) < 1e-4 * v2;
    return clamp(small ? solid * lobe_mapped_density(v, l.k) : share, 0.0, 1.0);
}

/// What all lobes reflect of the polygon.
vec3 lobe_total(LobeSum s, LobeFit fit, vec3 center, float size)
{
    vec3 vc = lobe_to_frame(fit, center);
    vec3 total = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        total += fit.lobes[i].weight * lobe_share(s, fit, i, vc, size);
    return total;
}

/// Sums over a rect as `c`, and half its sides.
LobeSum lobe_rect_sum(LobeFit fit, vec3 c, vec3 u, vec3 v)
{
    LobeSum s = lobe_sum();
    vec3 a = u + v, b = v - u;
    int i = 0;
    do {
        lobe_add_edge(s, fit, c, a, b, i == 4);
        vec3 next = -a;
        a = b;
        b = next;
    } while (++i < 5);
    return s;
}

/// By which lengths of a rect are multiplied first.
float lobe_rect_scale(vec3 center, vec3 half_u, vec3 half_v)
{
    return 1.0 / max(max(area_largest(center), area_largest(half_u)), max(area_largest(half_v), 1e-30));
}

/// A rect as `center`, and half its sides; both of its faces emit.
vec3 lobe_rect(LobeFit fit, vec3 center, vec3 half_u, vec3 half_v)
{
    float scale = lobe_rect_scale(center, half_u, half_v);
    vec3 c = center * scale, u = half_u * scale, v = half_v * scale;
    return lobe_total(lobe_rect_sum(fit, c, u, v), fit, c, length(u) + length(v));
}

/// An elliptical cone by a polygon of as large an area: half angles across x and y whose sines and cosines are given,
/// as area_disk_cone() has them.
vec3 lobe_cone(LobeFit fit, vec3 x, vec3 y, vec3 z, float sin_a, float cos_a, float sin_b, float cos_b)
{
    const int EDGES = 16;
    // Area of the circle over that of the polygon within it, as a factor of its radius.
    const float AREA = 1.01297;
    vec3 center = z * (cos_a * cos_b);
    vec3 u = x * (AREA * sin_a * cos_b), v = y * (AREA * cos_a * sin_b);
    LobeSum s = lobe_sum();
    vec2 at = vec2(1.0, 0.0);
    vec3 from = u;
    int i = 0;
    do {
        at = vec2(0.923879533 * at.x - 0.382683432 * at.y, 0.923879533 * at.y + 0.382683432 * at.x);
        vec3 to = i == EDGES - 1 ? u : u * at.x + v * at.y;
        lobe_add_edge(s, fit, center, from, to, i == EDGES);
        from = to;
    } while (++i <= EDGES);
    return lobe_total(s, fit, center, max(length(u), length(v)));
}

vec3 lobe_disk(LobeFit fit, vec3 center, vec3 facing, float radius)
{
    AreaCone cone = area_disk_cone(center, facing, radius);
    float cos_b = cone.cos_a * sqrt(1.0 + cone.k * cone.k);
    vec3 total = lobe_cone(fit, cone.x, cone.y, cone.z, cone.sin_a, cone.cos_a, cone.sin_b, cos_b);
    return dot(center, facing) < 0.0 ? total : vec3(0.0);
}

vec3 lobe_sphere(LobeFit fit, vec3 center, float radius)
{
    float scale = 1.0 / max(area_largest(center), radius);
    vec3 c = center * scale;
    float r = radius * scale;
    float d = max(length(c), 1e-30);
    float sine = min(r / d, 1.0);
    float cosine = sqrt(max((d - r) * (d + r), 0.0)) / d;
    Frame frame = frame_from_normal(c / d);
    vec3 outside = lobe_cone(fit, frame.t, frame.b, frame.n, sine, cosine, sine, cosine);
    vec3 inside = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        inside += fit.lobes[i].weight;
    return d > r ? outside : inside;
}

/// One end of a tube as the origin sees it: the circle along which its ball is touched, and the part of it, from -beta to
/// beta about `outward`, that is the outline of the tube.
struct LobeTubeEnd {
    vec3 center, outward;
    float radius, beta;
};

/// `ball` is the end's centre, `outward` points along the axis, away from the other end; `touched` is where the tangent
/// plane on the side of `side` touches the ball.
LobeTubeEnd lobe_tube_end(vec3 ball, vec3 outward, vec3 side, vec3 touched, float radius)
{
    float d2 = max(dot(ball, ball), 1e-36);
    float gap = max(d2 - radius * radius, 0.0) / d2;
    LobeTubeEnd end;
    end.center = ball * gap;
    end.radius = radius * sqrt(gap);
    vec3 across = outward - ball * (dot(outward, ball) / d2);
    float length2 = dot(across, across);
    end.outward = across * inversesqrt(max(length2, 1e-30));
    vec3 from = touched - end.center;
    end.beta = area_angle(dot(from, end.outward), abs(dot(from, side)));
    return end;
}

/// A tube: what is within `radius` of the line from `center` - `half_axis` to `center` + `half_axis`.
vec3 lobe_tube(LobeFit fit, vec3 center, vec3 half_axis, float radius)
{
    float scale = 1.0 / max(max(area_largest(center), area_largest(half_axis)), max(radius, 1e-30));
    vec3 c = center * scale, h = half_axis * scale;
    float r = radius * scale;
    float half_length = length(h);
    vec3 along = h / max(half_length, 1e-30);
    vec3 perpendicular = c - along * dot(along, c);
    float distance = max(length(perpendicular), 1e-12);
    vec3 e = perpendicular / distance;
    vec3 side = cross(along, e);
    float ratio = min(r / distance, 1.0);
    // Normal of the tangent plane, both of which contain the axis' direction.
    vec3 normal = ratio * e - sqrt((1.0 - ratio) * (1.0 + ratio)) * side;
    LobeTubeEnd first = lobe_tube_end(c + h, along, side, c + h - r * normal, r);
    LobeTubeEnd second = lobe_tube_end(c - h, -along, side, c - h - r * normal, r);
    const int STEPS = 8;
    LobeSum s = lobe_sum();
    vec3 start = vec3(0.0), from = vec3(0.0);
    const int VERTICES = 2 * STEPS + 2;
    int i = 0;
    do {
        bool at_first = i <= STEPS;
        LobeTubeEnd end = second;
        if (at_first)
            end = first;
        float step_angle = end.beta * (2.0 / float(STEPS));
        vec2 turn = numeric_cos_sin(step_angle * float(at_first ? i : 2 * STEPS + 1 - i) - end.beta);
        // The polygon has the area of the circle.
        float wide = end.radius * (1.0 + step_angle * step_angle / 12.0);
        vec3 to = end.center + wide * (turn.x * end.outward + turn.y * side) - c;
        if (i == 0)
            start = from = to;
        if (i == VERTICES)
            to = start;
        // The first is from a point to itself.
        lobe_add_edge(s, fit, c, from, to, i > VERTICES);
        from = to;
    } while (++i <= VERTICES + 1);
    vec3 outline = lobe_total(s, fit, c, half_length + r);
    // Behind an end, within the cylinder, that end's ball is all that is seen.
    float along_c = dot(along, c);
    vec3 nearest = c + along * clamp(-along_c, -half_length, half_length);
    vec3 ball = lobe_sphere(fit, along_c > 0.0 ? c - h : c + h, r);
    vec3 inside = vec3(0.0);
    for (int j = 0; j < LOBE_COUNT; ++j)
        inside += fit.lobes[j].weight;
    vec3 outside = ratio < 1.0 ? outline : ball;
    return dot(nearest, nearest) > r * r ? outside : inside;
}
#endif
