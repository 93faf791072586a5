/// light_image.glsl - pictures on rect lights: themselves, their halves, and their mean as a lobe sees them.
///
/// value  factors of the light's radiance, linear, no unit
/// params image: corner and size, in texels, of its place in the atlas: the picture itself, its halves to the right of it
///        (engine/passes/light_atlas.hpp); place: 0..1 from the left and the top, as it is seen from the side that emits
/// domain places beyond the edges are taken at them
/// source light_image_mean(): midpoints in the directions about a line along the rect's height: angle about it, and sine of
///        the angle to the plane across it, in which nothing but the lobe itself varies (Arvo 1995; Urena, Fajardo, King
///        2013), denser where the lobe points; each sees the picture blurred by its cell
/// error  of the mean: docs/area_lights.md
/// twin   engine/scene/light_image.cpp
#include "common/constants.glsl"
#include "common/numeric.glsl"
#include "light/area.glsl"

uniform sampler2D uLightImages;

float light_image_levels(vec4 image) { return floor(log2(max(image.z, image.w) + 0.5)); }

/// Level 0: the picture itself.
vec3 light_image_level(vec4 image, vec2 place, int level)
{
    ivec2 whole = ivec2(image.zw);
    ivec2 corner = level == 0 ? ivec2(0) : ivec2(whole.x, 0) + whole - (whole >> (level - 1));
    vec2 size = vec2(max(whole >> level, ivec2(1)));
    vec2 texel = image.xy + vec2(corner) + clamp(place * size, vec2(0.5), size - 0.5);
    return textureLod(uLightImages, texel / vec2(textureSize(uLightImages, 0)), 0.0).rgb;
}

/// Between levels, too.
vec3 light_image_blurred(vec4 image, vec2 place, float level)
{
    float most = light_image_levels(image);
    float at = clamp(level, 0.0, most);
    float low = min(floor(at), max(most - 1.0, 0.0));
    return mix(light_image_level(image, place, int(low)), light_image_level(image, place, int(min(low + 1.0, most))),
               at - low);
}

/// The picture itself, with weights as exact as floats are.
vec3 light_image_sharp(vec4 image, vec2 place)
{
    vec2 at = clamp(place * image.zw - 0.5, vec2(0.0), image.zw - 1.0);
    vec2 low = floor(at), share = at - low;
    ivec2 a = ivec2(image.xy + low), b = ivec2(image.xy + min(low + 1.0, image.zw - 1.0));
    vec3 top = mix(texelFetch(uLightImages, a, 0).rgb, texelFetch(uLightImages, ivec2(b.x, a.y), 0).rgb, share.x);
    vec3 bottom = mix(texelFetch(uLightImages, ivec2(a.x, b.y), 0).rgb, texelFetch(uLightImages, b, 0).rgb, share.x);
    return mix(top, bottom, share.y);
}

/// Where a point of a rect, `offset` from its centre, is on its picture.
vec2 light_image_place(vec3 offset, vec3 axis, vec3 facing, float half_width, float half_height)
{
    vec2 at = vec2(-dot(offset, axis) / half_width, dot(offset, cross(facing, axis)) / half_height);
    return 0.5 + 0.5 * clamp(at, vec2(-1.0), vec2(1.0));
}

/// Nodes along a coordinate from `low` to `high`, densest at `center`: center + scale q / sqrt(1 - q^2), q even from
/// `first` on over `range`.
struct LightImageSpread { float center, scale, first, range; };

/// `peak`: of a lobe whose standard deviation is `width`; it may be beyond the ends.
LightImageSpread light_image_spread(float peak, float low, float high, float width, float breadth)
{
    LightImageSpread s;
    s.center = clamp(peak, low, high);
    // Beyond the peak a lobe falls off by e over width^2 / distance from it.
    s.scale = breadth * width * width / (width + 0.5 * abs(peak - s.center));
    vec2 d = vec2(low, high) - s.center;
    vec2 q = d * inversesqrt(d * d + s.scale * s.scale);
    s.first = q.x;
    s.range = q.y - q.x;
    return s;
}

/// The coordinate of a node, and the part of it for which it stands.
vec2 light_image_node(LightImageSpread s, float share, float count)
{
    float q = s.first + s.range * share;
    float w = inversesqrt(max(1.0 - q * q, 1e-12));
    return vec2(s.center + s.scale * q * w, s.scale * w * w * w * s.range / count);
}

/// Nodes along each side.
#ifndef LIGHT_IMAGE_NODES
#define LIGHT_IMAGE_NODES 4
#endif

/// Mean of the picture, each direction weighted by cos^k of its angle to z: the rect is `center` + x `u` + y `v`, x and y
/// in -1..1, its left where x = 1 and its top where y = -1. `heights` of these over the surface's horizon: only what is
/// above it counts.
vec3 light_image_mean(vec4 image, vec3 center, vec3 u, vec3 v, float k, vec3 heights)
{
    float most = light_image_levels(image);
    float lv = max(length(v), 1e-30);
    vec3 along = v / lv;
    float slant = dot(u, along);
    vec3 u_across = u - slant * along;
    float lu = max(length(u_across), 1e-30);
    vec3 et = u_across / lu;
    float c_along = dot(center, along);
    vec3 across = center - c_along * along;
    float c_t = dot(across, et);
    vec3 foot = across - c_t * et;
    float h = max(length(foot), 1e-6 * (abs(c_t) + lu));
    vec3 en = length(foot) > 1e-6 * (abs(c_t) + lu) ? foot / h : cross(et, along);

    // The lobe's axis: angle about `along`, and how far from it.
    vec2 axis = vec2(dot(vec3(0.0, 0.0, 1.0), en), et.z);
    float axis_across = length(axis);
    float least = atan(c_t - lu, h), greatest = atan(c_t + lu, h);
    float breadth = k > 1.5 ? 2.0 : 3.0;

    float peak = axis_across > 1e-6 ? atan(axis.y, axis.x) : 0.5 * (least + greatest);
    float nearest = clamp(peak, least, greatest);
    vec2 turn = vec2(cos(nearest), sin(nearest));
    float reach = h / max(turn.x, 1e-6);
    float off = c_along + ((reach * turn.y - c_t) / lu) * slant;
    vec2 ends = vec2(off - lv, off + lv);
    ends *= inversesqrt(reach * reach + ends * ends);
    float sine = clamp(along.z, ends.x, ends.y);
    float width = inversesqrt(k * axis_across * sqrt(max(1.0 - sine * sine, 0.0)) + 1.0);
    LightImageSpread about = light_image_spread(peak, least, greatest, width, breadth);

    vec3 sum = vec3(0.0);
    float weights = 0.0;
    const float COUNT = float(LIGHT_IMAGE_NODES);
    int i = 0;
    do {
        vec2 angle = light_image_node(about, (float(i) + 0.5) / COUNT, COUNT);
        turn = vec2(cos(angle.x), sin(angle.x));
        reach = h / max(turn.x, 1e-6);
        float x = clamp((reach * turn.y - c_t) / lu, -1.0, 1.0);
        float wide = reach * reach / (h * lu) * angle.y;
        off = c_along + x * slant;
        ends = vec2(off - lv, off + lv);
        ends *= inversesqrt(reach * reach + ends * ends);
        float b = axis.x * turn.x + axis.y * turn.y;
        float r = max(sqrt(b * b + along.z * along.z), 1e-6);
        float top = b > 0.0 ? along.z / r : sign(along.z);
        float at = clamp(top, ends.x, ends.y);
        width = max(sqrt(max(1.0 - at * at, 0.0)), 0.05) * inversesqrt(k * r + 1.0);
        LightImageSpread rise = light_image_spread(top, ends.x, ends.y, width, breadth);
        int j = 0;
        do {
            vec2 node = light_image_node(rise, (float(j) + 0.5) / COUNT, COUNT);
            float s = clamp(node.x, -0.9999999, 0.9999999);
            float c = sqrt((1.0 - s) * (1.0 + s));
            float y = clamp((reach * s / c - off) / lv, -1.0, 1.0);
            float high = reach / (c * c * c * lv) * node.y;
            float cosine = b * c + along.z * s;
            float density = k == 1.0 ? max(cosine, 0.0) : cosine > 0.0 ? numeric_exp(k * numeric_log(max(cosine, 1e-30))) : 0.0;
            float weight = heights.x + x * heights.y + y * heights.z > 0.0 ? density * angle.y * node.y : 0.0;
            // A cell's blur; linear filters reach farther than boxes.
            vec2 cell = 0.5 * vec2(wide, high) * image.zw;
            float level = min(log2(max(max(cell.x, cell.y), 1e-3)) - 0.5, most);
            sum += weight * light_image_blurred(image, vec2(0.5 - 0.5 * x, 0.5 + 0.5 * y), level);
            weights += weight;
        } while (++j < LIGHT_IMAGE_NODES);
    } while (++i < LIGHT_IMAGE_NODES);
    vec3 whole = light_image_level(image, vec2(0.5), int(most));
    // Seen under so small an angle that the lobe is the same all over it.
    float extent = lu + abs(slant) + lv;
    bool small = extent * extent * (k + 3.0) < 1e-6 * dot(center, center);
    return weights > 0.0 && !small ? sum / weights : whole;
}
