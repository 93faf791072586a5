/// ambient_occlusion.frag - what share of a constant environment's irradiance arrives at each pixel's surface past what the
/// depth buffer shows, and the mean direction that it comes from.
///
/// OCCLUSION_SLICES planes through the view ray, turned otherwise in each of 3 x 3 pixels and in each frame, with OCCLUSION_STEPS
/// looks along each side, ever wider apart up to the edge of the picture; who reads it takes the mean of 3 x 3 (Jimenez, Wu, Pesce, Jarabo, "Practical real-time strategies
/// for accurate indirect occlusion", 2016). In a slice the surface sees half a turn, which 32 bits share out; each thing that is
/// looked at covers those between its front and its back (Therrien, Levesque, Gilet, "Screen space indirect lighting with
/// visibility bitmask", 2023). How thick it is no picture says: it is taken as thick as it is far from the surface, which is
/// about how far apart the looks are.
#include "pass/gbuffer_read.glsl"
#include "common/constants.glsl"
#include "pass/occlusion_depth.glsl"

layout(location = 0) out vec4 oOcclusion;  // share, octahedral direction in world axes, occlusion_depth_code()

uniform int uOcclusionFrame;

const float OCCLUSION_THICKNESS = 1.0;  // of the distance

/// Position relative to the eye of what a texel shows, and its distance along the view axis; false for the background.
bool occlusion_seen(ivec2 texel, out vec3 position, out vec3 ray)
{
    float d = texelFetch(uDepth, texel, 0).x;
#ifdef LINEAR_Z
    float z = d;
    bool seen = d < 1e30;
#else
    float z = (uDepthToZ.x + uDepthToZ.y * d) / (uDepthToZ.z + uDepthToZ.w * d);
    bool seen = d > 0.0;
#endif
    vec2 p = vec2(texel) + 0.5;
    ray = uRayDirection + p.x * uRayDirectionDx + p.y * uRayDirectionDy;
    position = uRayOrigin + p.x * uRayOriginDx + p.y * uRayOriginDy + z * ray;
    return seen;
}

/// Cosine and sine of half a sector, of a sector, and of two: pi / 64, pi / 32, pi / 16.
const vec2 OCCLUSION_HALF = vec2(0.99879546, 0.04906767);
const vec2 OCCLUSION_SECTOR = vec2(0.99518473, 0.09801714);
const vec2 OCCLUSION_TWO = vec2(0.98078528, 0.19509032);

vec2 occlusion_turned(vec2 v)
{
    return vec2(v.x * OCCLUSION_TWO.x - v.y * OCCLUSION_TWO.y, v.x * OCCLUSION_TWO.y + v.y * OCCLUSION_TWO.x);
}

/// The integral of cos(s - tilt) |sin s| over s from 0 to t. `twice`: cosine and sine of 2 (t - tilt); those of the tilt.
float occlusion_arc(float t, vec2 twice, float cosine, float sine)
{
    float f = 0.25 * (cosine - (cosine * twice.x - sine * twice.y)) + 0.5 * t * sine;
    return t < 0.0 ? -f : f;
}

/// Bits from `from` to `to`, in sectors.
uint occlusion_bits(float from, float to, float dither)
{
    int first = int(clamp(floor(from + dither), 0.0, 32.0)), last = int(clamp(floor(to + dither), 0.0, 32.0));
    int count = last - first;
    uint ones = count >= 32 ? 0xffffffffu : (1u << uint(max(count, 0))) - 1u;
    return first < 32 ? ones << uint(first) : 0u;
}

void main()
{
    ivec2 here = gbuffer_pixel();
    vec3 position, ray;
    occlusion_seen(here, position, ray);
    vec3 n = gbuffer_normal();
    vec3 view = -normalize(ray);
    float z = dot(position - uRayOrigin, ray) / dot(ray, ray);
    // What a step of one pixel moves the position by, across the ray.
    vec3 dx = uRayOriginDx + z * uRayDirectionDx, dy = uRayOriginDy + z * uRayDirectionDy;
    dx -= view * dot(dx, view);
    dy -= view * dot(dy, view);
    float xx = dot(dx, dx), xy = dot(dx, dy), yy = dot(dy, dy);
    float det = max(xx * yy - xy * xy, 1e-37);
    vec3 across = dx * inversesqrt(max(xx, 1e-37)), up = cross(view, across);
    vec2 size = vec2(textureSize(uDepth, 0));

    // Ninths, in an order that spreads neighbours; other frames lie between.
    int tile = (here.x % 3) * 4 + (here.y % 3) * 7;
    vec2 part = fract((vec2(tile % 9, (tile * 5 + 3) % 9) + 0.5) / 9.0 + float(uOcclusionFrame) * vec2(0.6180340, 0.7548777));
    float arrives = 0.0, all = 0.0;
    vec3 mean = vec3(0.0), mean_of_all = vec3(0.0);
    for (int slice = 0; slice < OCCLUSION_SLICES; ++slice) {
        float turn = PI * (float(slice) + part.x) / float(OCCLUSION_SLICES);
        float dither = fract(part.y + float(slice) / float(OCCLUSION_SLICES));
        vec3 side = cos(turn) * across + sin(turn) * up;
        float sx = dot(side, dx), sy = dot(side, dy);
        vec2 along = vec2(yy * sx - xy * sy, xx * sy - xy * sx) / det;  // pixels for a metre to the side
        along *= inversesqrt(max(dot(along, along), 1e-37));
        vec3 axis = cross(view, side);
        vec3 in_slice = n - axis * dot(n, axis);
        float share = length(in_slice);
        // Texels lie beside the slice: they are moved onto it in parallel to the surface, which so never covers itself.
        vec3 onto = (axis - n * dot(n, axis)) / max(share * share, 1e-4);
        float tilt = atan(dot(in_slice, side), dot(in_slice, view));
        vec3 upright = cos(tilt) * view + sin(tilt) * side, beside = cos(tilt) * side - sin(tilt) * view;
        float scale = 32.0 / PI;
        uint covered = 0u;
        for (int way = 0; way < 2; ++way) {
            vec2 step = way == 0 ? along : -along;
            vec2 room = max((mix(vec2(0.0), size, greaterThan(step, vec2(0.0))) - gl_FragCoord.xy) / step, vec2(0.0));
            room = mix(room, vec2(1e6), lessThan(abs(step), vec2(1e-6)));
            float reach = log2(max(min(room.x, room.y), 1.0));
            for (int i = 0; i < OCCLUSION_STEPS; ++i) {
                float away = exp2(reach * (float(i) + dither) / float(OCCLUSION_STEPS));
                ivec2 texel = ivec2(floor(gl_FragCoord.xy + step * away));
                vec3 there, there_ray;
                if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(size))) || texel == here ||
                    !occlusion_seen(texel, there, there_ray))
                    continue;
                vec3 front = there - position;
                vec3 back = front + normalize(there_ray) * (OCCLUSION_THICKNESS * length(front));
                front -= onto * dot(front, axis);
                back -= onto * dot(back, axis);
                // Angles from the normal; the way from front to back is less than half a turn.
                float from = atan(dot(front, beside), dot(front, upright)), to = atan(dot(back, beside), dot(back, upright));
                to -= 2.0 * PI * floor((to - from) * (0.5 * INV_PI) + 0.5);
                float low = min(from, to) * scale + 16.0, high = max(from, to) * scale + 16.0;
                covered |= occlusion_bits(low, high, dither);
            }
        }
        // Angles from the normal to the ends and middles of sectors, twice and once, by turning on and on.
        float cosine = cos(tilt), sine = sin(tilt), t = tilt - 0.5 * PI;
        vec2 twice = vec2(-1.0, 0.0), middle = vec2(OCCLUSION_HALF.y, -OCCLUSION_HALF.x);
        float before = occlusion_arc(t, twice, cosine, sine);
        for (int i = 0; i < 32; ++i) {
            t += PI / 32.0;
            twice = occlusion_turned(twice);
            float upto = occlusion_arc(t, twice, cosine, sine);
            float weight = share * max(upto - before, 0.0);
            before = upto;
            vec3 weighted = weight * (middle.x * upright + middle.y * beside);
            middle = vec2(middle.x * OCCLUSION_SECTOR.x - middle.y * OCCLUSION_SECTOR.y,
                          middle.x * OCCLUSION_SECTOR.y + middle.y * OCCLUSION_SECTOR.x);
            all += weight;
            mean_of_all += weighted;
            if (((covered >> uint(i)) & 1u) == 0u) {
                arrives += weight;
                mean += weighted;
            }
        }
    }
    float visible = all > 0.0 ? clamp(arrives / all, 0.0, 1.0) : 1.0;
    // Few slices have a mean of their own, also where nothing is in the way: only what they differ by from it counts. The mean
    // of a whole hemisphere is 2/3 n.
    vec3 bent = n;
    if (arrives > 1e-6)
        bent = 2.0 / 3.0 * n + mean / arrives - mean_of_all / max(all, 1e-6);
    bent = dot(bent, bent) > 1e-6 ? normalize(bent) : n;
    oOcclusion = vec4(visible, octahedral_encode(bent) * 0.5 + 0.5, occlusion_depth_code(z));
}
