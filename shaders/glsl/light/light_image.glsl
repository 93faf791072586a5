/// light_image.glsl - pictures on rect lights: themselves, their means over parts, and their mean as a lobe sees them.
///
/// value  factors of the light's radiance, linear, no unit
/// params place: 0..1 from the left and the top, as it is seen from the side that emits; levels: 0 is the mean of all, each has
///        twice as many parts along each side as the one before, but along a long rect's shorter side only from some level
///        on; the last is the picture itself
/// domain places beyond the edges are taken at them
/// source light_image_mean(): midpoints in the directions about a line along the rect's height: angle about it, and sine of
///        the angle to the plane across it, in which nothing but the lobe itself varies (Arvo 1995; Urena, Fajardo, King
///        2013), denser where the lobe points; each sees the picture blurred by its cell
/// error  of the mean: docs/area_lights.md
/// twin   engine/scene/light_image.cpp; of the places in the atlas engine/passes/light_atlas.cpp
#include "common/constants.glsl"
#include "common/numeric.glsl"
#include "light/area.glsl"

uniform sampler2D uLightImages;

/// Where a picture is in the atlas, in texels.
struct LightImage {
    vec2 corner;
    ivec2 size;
    int turn;      // log4 of how many times wider than high the rect is, rounded, -2..2
    ivec2 behind;  // levels that have one part along this side
    ivec2 full;    // levels from there on until there are as many parts as texels
    int last;      // the picture itself
};

/// A picture as lights name it: corner, with the turn in eighths and the levels until full in 256ths, and size; no size:
/// none.
LightImage light_image_of(vec4 named)
{
    LightImage image;
    image.corner = floor(named.xy);
    image.size = ivec2(named.zw);
    image.turn = int(fract(named.x) * 8.0 + 0.5) - 2;
    image.behind = max(ivec2(-2, 2) * image.turn, ivec2(0));
    int full = int(fract(named.y) * 256.0 + 0.5);
    image.full = ivec2(full / 16, full % 16);
    image.last = max(image.full.x + image.behind.x, image.full.y + image.behind.y);
    return image;
}

vec3 light_image_level(LightImage image, vec2 place, int level)
{
    bool whole = level >= image.last;
    ivec2 from = level - image.behind;
    vec2 size = vec2(min(image.size, ivec2(1) << clamp(from, ivec2(0), image.full)));
    // Levels are beside the picture, one below the other.
    int above = min(level, image.behind.y) + (1 << clamp(from.y, 0, image.full.y)) - 1 + max(from.y - image.full.y, 0) * image.size.y;
    vec2 corner = image.corner + (whole ? vec2(0.0) : vec2(image.size.x, above));
    vec2 texel = corner + clamp(place * size, vec2(0.5), size - 0.5);
    return textureLod(uLightImages, texel / vec2(textureSize(uLightImages, 0)), 0.0).rgb;
}

/// Between levels, too.
vec3 light_image_blurred(LightImage image, vec2 place, float level)
{
    float at = clamp(level, 0.0, float(image.last));
    int low = min(int(at), max(image.last - 1, 0));
    return mix(light_image_level(image, place, low), light_image_level(image, place, min(low + 1, image.last)),
               at - float(low));
}

/// The picture itself, with weights as exact as floats are.
vec3 light_image_sharp(LightImage image, vec2 place)
{
    vec2 most = vec2(image.size) - 1.0;
    vec2 at = clamp(place * vec2(image.size) - 0.5, vec2(0.0), most);
    vec2 low = floor(at), share = at - low;
    ivec2 a = ivec2(image.corner + low), b = ivec2(image.corner + min(low + 1.0, most));
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

/// Mean of the picture, each direction weighted by cos^k of its angle to z: the rect is `center` + x `u` + y `v`, x and y
/// in -1..1, its left where x = 1 and its top where y = -1. `heights` of these over the surface's horizon: only what is
/// above it counts.
vec3 light_image_mean(LightImage image, vec3 center, vec3 u, vec3 v, float k, vec3 heights)
{
    // 16 in all, more along the longer side, and the same for all who see the rect.
    ivec2 nodes = ivec2(1 << (2 + image.turn), 1 << (2 - image.turn));
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
    bool broad = k < 1.5;
    float breadth = broad ? 3.0 : 2.4;
    // Linear filters reach farther than the cells' boxes: what is best differs with how fast a lobe falls off.
    float sharper = broad ? 0.0 : 0.5;
    vec2 count = vec2(nodes);

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
    int i = 0;
    do {
        vec2 angle = light_image_node(about, (float(i) + 0.5) / count.x, count.x);
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
            vec2 node = light_image_node(rise, (float(j) + 0.5) / count.y, count.y);
            float s = clamp(node.x, -0.9999999, 0.9999999);
            float c = sqrt((1.0 - s) * (1.0 + s));
            float y = clamp((reach * s / c - off) / lv, -1.0, 1.0);
            float high = reach / (c * c * c * lv) * node.y;
            float cosine = b * c + along.z * s;
            float density = k == 1.0 ? max(cosine, 0.0) : cosine > 0.0 ? numeric_exp(k * numeric_log(max(cosine, 1e-30))) : 0.0;
            float weight = heights.x + x * heights.y + y * heights.z > 0.0 ? density * angle.y * node.y : 0.0;
            // A cell's blur.
            vec2 levels = vec2(image.behind) - log2(max(0.5 * vec2(wide, high), vec2(1e-9)));
            float level = sharper + min(levels.x, levels.y);
            sum += weight * light_image_blurred(image, vec2(0.5 - 0.5 * x, 0.5 + 0.5 * y), level);
            weights += weight;
        } while (++j < nodes.y);
    } while (++i < nodes.x);
    vec3 whole = light_image_level(image, vec2(0.5), 0);
    // Seen under so small an angle that the lobe is the same all over it.
    float extent = lu + abs(slant) + lv;
    bool small = extent * extent * (k + 3.0) < 1e-6 * dot(center, center);
    return weights > 0.0 && !small ? sum / weights : whole;
}
