/// rays.glsl - visibility by rays through a hierarchy of boxes about the scene's triangles, in texture buffers.
///
/// value  transmittance 0..1 of the way from a surface: 0 where opaque surfaces are on it, a factor 1 - alpha for each
///        blended one; masked surfaces have holes. All surfaces block from both sides
/// frame  positions relative to the eye, world axes, m; the hierarchy's own: (position + uRayFrame.xyz) * uRayFrame.w,
///        in which the scene is within -1..1
/// params uRayNodes: two texels a node in depth-first order: lower corner, link; upper corner, count. link >= 0: the
///        node after its subtree; else ~link is the texel where a leaf's `count` pairs begin. Opaque surfaces from
///        node 0 to uRayNodesEnd.x, others from there to uRayNodesEnd.y
///        uRayTriangles: pairs of triangles (A, B, C) and (D, C, B), 3 texels each; 8 where not opaque (ray_coverage)
/// domain a direction of any length but 0, as far as 1e18 m; distances in units of it, infinity allowed; not above 0:
///        nothing is in the way
/// source Smits, "Efficiency issues for ray tracing", JGT 1998 (links instead of a stack); Woop, Benthin, Wald,
///        "Watertight ray/triangle intersection", JCGT 2(1), 2013; Ize, "Robust BVH ray traversal", JCGT 2(2), 2013
/// stable vertices are projected along the ray alike in all triangles, and the sign of an edge function a b - c d of
///        rounded products is right or 0, which counts as inside: a ray through an edge or a vertex meets one of the
///        triangles about it. Boxes are larger by what projection rounds. The way starts off the surface by the error of
///        its position, so no surface shadows itself: what is nearer than that does not block
/// error  exact but for rays that pass an edge closer than 2^-21 of the scene's size, and but for that offset
///        (tests/passes/ray_visibility_test.cpp)
/// twin   brute force over the triangles in double, there

uniform usamplerBuffer uRayNodes;
uniform samplerBuffer uRayTriangles;
uniform ivec2 uRayNodesEnd;
uniform vec4 uRayFrame;  // eye - centre of the scene, m; 1/m
uniform vec2 uRayError;  // error of positions across their surface: m, and per metre from the eye
#ifdef RAY_ALPHA
uniform samplerBuffer uRayTexels;  // alpha of the textures' finest levels
#endif

const int RAY_PAIR_TEXELS = 3;   // vertices of a pair
const int RAY_ALPHA_TEXELS = 5;  // what follows them where the surface is not opaque

/// Set where a driver ended a loop before a ray was: llvmpipe does at 65535 rounds in all. The pass then says so.
bool ray_unfinished = false;

/// A ray as the tests of boxes and triangles need it.
struct Ray {
    vec3 origin, inverse;  // 1 / direction, finite
    vec3 x, y, z;          // rows of the projection along the ray; z counts in lengths of the direction
    float end;
};

Ray ray_make(vec3 origin, vec3 direction, float end)
{
    vec3 a = abs(direction);
    bool along_x = a.x >= a.y && a.x >= a.z;
    bool along_y = !along_x && a.y >= a.z;
    float k = 1.0 / (along_x ? direction.x : along_y ? direction.y : direction.z);
    vec3 s = -direction * k;
    Ray ray;
    ray.origin = origin;
    // A component below 1e-18 of the largest moves less than a box is padded by.
    vec3 least = vec3(1e-18 * max(max(a.x, a.y), a.z));
    ray.inverse = 1.0 / mix(direction, mix(least, -least, lessThan(direction, vec3(0.0))), lessThan(a, least));
    ray.x = along_x ? vec3(s.y, 1.0, 0.0) : along_y ? vec3(1.0, s.x, 0.0) : vec3(1.0, 0.0, s.x);
    ray.y = along_x ? vec3(s.z, 0.0, 1.0) : along_y ? vec3(0.0, s.z, 1.0) : vec3(0.0, 1.0, s.y);
    ray.z = along_x ? vec3(k, 0.0, 0.0) : along_y ? vec3(0.0, k, 0.0) : vec3(0.0, 0.0, k);
    ray.end = end;
    return ray;
}

/// Whether the ray passes the box; (1 + 2 gamma_3) makes up for the rounding of the three operations on each side.
bool ray_meets_box(Ray ray, vec3 lower, vec3 upper)
{
    vec3 a = (lower - ray.origin) * ray.inverse;
    vec3 b = (upper - ray.origin) * ray.inverse;
    vec3 near = min(a, b), far = max(a, b);
    float first = max(max(near.x, near.y), max(near.z, 0.0));
    float last = min(min(far.x, far.y), min(far.z, ray.end));
    return first <= last * 1.0000004;
}

/// The four vertices of a pair as the ray sees them: x, y across it, z along it.
struct RayPair { vec3 a, b, c, d; };

vec3 ray_project(Ray ray, vec3 v)
{
    v -= ray.origin;
    return vec3(dot(ray.x, v), dot(ray.y, v), dot(ray.z, v));
}

RayPair ray_pair(Ray ray, int texel)
{
    vec4 t0 = texelFetch(uRayTriangles, texel);
    vec4 t1 = texelFetch(uRayTriangles, texel + 1);
    vec4 t2 = texelFetch(uRayTriangles, texel + 2);
    return RayPair(ray_project(ray, t0.xyz), ray_project(ray, vec3(t0.w, t1.xy)), ray_project(ray, vec3(t1.zw, t2.x)),
                   ray_project(ray, t2.yzw));
}

float ray_cross(vec3 p, vec3 q) { return p.x * q.y - p.y * q.x; }

/// Twice the edge function. Of q, p it is the same but for the sign, and of p, p it is 0, in every bit, also where a compiler
/// fuses one of the two products with the difference: neighbours must agree about the edge that they share.
float ray_edge(vec3 p, vec3 q) { return ray_cross(p, q) - ray_cross(q, p); }

/// Weights of the vertices of a pair's triangles where the ray passes their planes, not divided by their sums.
void ray_weights(RayPair p, out vec3 abc, out vec3 dcb)
{
    float bc = ray_edge(p.b, p.c);
    abc = vec3(bc, ray_edge(p.c, p.a), ray_edge(p.a, p.b));
    dcb = vec3(-bc, ray_edge(p.b, p.d), ray_edge(p.d, p.c));
}

/// Whether the ray meets a triangle whose vertices have these weights, not divided by their sum, and depths. A triangle
/// seen from its edge has the sum 0, and is not met.
bool ray_meets_triangle(Ray ray, vec3 weights, vec3 depths)
{
    float sum = weights.x + weights.y + weights.z;
    float t = dot(weights, depths) / sum;
    bool inside = min(min(weights.x, weights.y), weights.z) >= 0.0 || max(max(weights.x, weights.y), weights.z) <= 0.0;
    return inside && sum != 0.0 && t > 0.0 && t < ray.end;
}

/// The next leaf that the ray meets, from `node` on: texel and number of its pairs, (0, 0) if there is none. `node`
/// becomes the node after it.
ivec2 ray_next_leaf(Ray ray, inout int node, int end)
{
    ivec2 pairs = ivec2(0);
    do {
        uvec4 lower = texelFetch(uRayNodes, 2 * node);
        uvec4 upper = texelFetch(uRayNodes, 2 * node + 1);
        int link = int(lower.w);
        bool meets = ray_meets_box(ray, uintBitsToFloat(lower.xyz), uintBitsToFloat(upper.xyz));
        pairs = meets && link < 0 ? ivec2(~link, int(upper.w)) : ivec2(0);
        node = meets || link < 0 ? node + 1 : link;
    } while (pairs.y == 0 && node < end);
    return pairs;
}

/// Whether an opaque surface is on the ray.
bool ray_is_blocked(Ray ray, bool wanted)
{
    int end = uRayNodesEnd.x;
    int node = wanted ? 0 : end;
    bool blocked = false;
    if (node < end) {
        do {
            ivec2 pairs = ray_next_leaf(ray, node, end);
            if (pairs.y > 0) {
                do {
                    RayPair p = ray_pair(ray, pairs.x);
                    vec3 abc, dcb;
                    ray_weights(p, abc, dcb);
                    blocked = ray_meets_triangle(ray, abc, vec3(p.a.z, p.b.z, p.c.z)) ||
                              ray_meets_triangle(ray, dcb, vec3(p.d.z, p.c.z, p.b.z));
                    pairs += ivec2(RAY_PAIR_TEXELS, -1);
                } while (!blocked && pairs.y > 0);
                ray_unfinished = ray_unfinished || (!blocked && pairs.y > 0);
            }
        } while (!blocked && node < end);
        ray_unfinished = ray_unfinished || (!blocked && node < end);
    }
    return blocked;
}

#ifdef RAY_ALPHA
/// The texel at a whole number `i` in a row of `n`, which may lie outside. wrap 0: repeat, 1: mirrored, 2: clamped.
float ray_wrapped(float i, float n, float wrap)
{
    float repeated = i - n * floor(i / n);
    float mirrored = i - 2.0 * n * floor(i / (2.0 * n));
    mirrored = mirrored < n ? mirrored : 2.0 * n - 1.0 - mirrored;
    return wrap == 0.0 ? repeated : wrap == 1.0 ? mirrored : clamp(i, 0.0, n - 1.0);
}

/// The same place near 0, so that few digits are lost when it is multiplied by the size.
float ray_near_zero(float s, float wrap)
{
    return wrap == 0.0 ? s - floor(s) : wrap == 1.0 ? s - 2.0 * floor(0.5 * s) : clamp(s, -1.0, 2.0);
}

/// Alpha of a texture's finest level. image: width, height, first texel / 65536, its remainder; how: wrap across and
/// down, 1 for linear filter.
float ray_texture(vec2 uv, vec4 image, vec3 how)
{
    vec2 n = max(image.xy, 1.0);
    vec2 place = vec2(ray_near_zero(uv.x, how.x), ray_near_zero(uv.y, how.y)) * n - 0.5 * how.z;
    vec2 corner = floor(place);
    vec2 w = (place - corner) * how.z;
    ivec2 x = ivec2(ray_wrapped(corner.x, n.x, how.x), ray_wrapped(corner.x + 1.0, n.x, how.x));
    ivec2 y = ivec2(ray_wrapped(corner.y, n.y, how.y), ray_wrapped(corner.y + 1.0, n.y, how.y)) * int(n.x);
    int first = int(image.z) * 65536 + int(image.w);
    vec2 upper = vec2(texelFetch(uRayTexels, first + y.x + x.x).x, texelFetch(uRayTexels, first + y.x + x.y).x);
    vec2 lower = vec2(texelFetch(uRayTexels, first + y.y + x.x).x, texelFetch(uRayTexels, first + y.y + x.y).x);
    vec2 both = mix(upper, lower, w.y);
    return image.x > 0.0 ? mix(both.x, both.y, w.x) : 1.0;
}

/// How much of the light the surface keeps back where the vertices of a pair have these weights. `texel`: the five that
/// follow the vertices: UVs of A, B; of C, D; alpha at each; image; wraps, filter, cutoff (-1: blended).
float ray_coverage(int texel, vec4 weights)
{
    vec4 uv_ab = texelFetch(uRayTriangles, texel), uv_cd = texelFetch(uRayTriangles, texel + 1);
    vec4 how = texelFetch(uRayTriangles, texel + 4);
    vec2 uv = weights.x * uv_ab.xy + weights.y * uv_ab.zw + weights.z * uv_cd.xy + weights.w * uv_cd.zw;
    float alpha = dot(weights, texelFetch(uRayTriangles, texel + 2)) *
                  ray_texture(uv, texelFetch(uRayTriangles, texel + 3), how.xyz);
    return how.w < 0.0 ? clamp(alpha, 0.0, 1.0) : alpha < how.w ? 0.0 : 1.0;
}

/// What passes the surfaces that are not opaque.
float ray_transmittance(Ray ray, bool wanted)
{
    int end = uRayNodesEnd.y;
    int node = wanted ? uRayNodesEnd.x : end;
    float passes = 1.0;
    if (node < end) {
        do {
            ivec2 pairs = ray_next_leaf(ray, node, end);
            if (pairs.y > 0) {
                do {
                    RayPair p = ray_pair(ray, pairs.x);
                    vec3 abc, dcb;
                    ray_weights(p, abc, dcb);
                    int surface = pairs.x + RAY_PAIR_TEXELS;
                    // A weight of no number belongs to a triangle that is not met.
                    if (ray_meets_triangle(ray, abc, vec3(p.a.z, p.b.z, p.c.z)))
                        passes *= 1.0 - ray_coverage(surface, vec4(abc / (abc.x + abc.y + abc.z), 0.0));
                    if (ray_meets_triangle(ray, dcb, vec3(p.d.z, p.c.z, p.b.z)))
                        passes *= 1.0 - ray_coverage(surface, vec4(0.0, dcb.zyx / (dcb.x + dcb.y + dcb.z)));
                    pairs += ivec2(RAY_PAIR_TEXELS + RAY_ALPHA_TEXELS, -1);
                } while (passes > 0.0 && pairs.y > 0);
                ray_unfinished = ray_unfinished || (passes > 0.0 && pairs.y > 0);
            }
        } while (passes > 0.0 && node < end);
        ray_unfinished = ray_unfinished || (passes > 0.0 && node < end);
    }
    return passes;
}
#endif

/// As ray_visibility, from a surface that lets `behind` of the light through from its other side.
float ray_visibility_through(vec3 position, vec3 geometric_normal, vec3 direction, float distance, float behind)
{
    bool front = dot(geometric_normal, direction) >= 0.0;
    float visible = front ? 1.0 : behind;
    // Drivers that run neighbouring pixels together run those without a surface too, from infinity, where every box would be
    // met.
    bool there = all(lessThanEqual(abs(position), vec3(3e38)));
    bool wanted = visible > 0.0 && distance > 0.0 && direction != vec3(0.0) && there;
    float away = uRayError.x + uRayError.y * length(position);
    vec3 origin = (position + uRayFrame.xyz) + (front ? away : -away) * geometric_normal;
    Ray ray = ray_make(origin * uRayFrame.w, direction, distance * uRayFrame.w);
    if (ray_is_blocked(ray, wanted))
        visible = 0.0;
#ifdef RAY_ALPHA
    visible *= ray_transmittance(ray, wanted && visible > 0.0);
#endif
    return visible;
}

/// What arrives at a surface of the light that comes along `direction` from `distance` (in lengths of the direction):
/// 1 all, 0 nothing. position: relative to the eye, m; geometric_normal: unit, on the side that is seen: light from the
/// other does not arrive.
float ray_visibility(vec3 position, vec3 geometric_normal, vec3 direction, float distance)
{
    return ray_visibility_through(position, geometric_normal, direction, distance, 0.0);
}
