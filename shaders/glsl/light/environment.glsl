/// environment.glsl - radiance from infinity, by direction.
///
/// value  W/(m^2 sr); bilinear between texels, around the seam and over the poles
/// frame  unit directions of the world; uEnvMapFromWorld turns them into the map's: +Y up, the picture's centre column
///        along +Z, its left quarter column along +X
/// params uEnvMap: rows of the picture from the top, one more at each end that continues it over the pole; alpha holds
///        the density with which directions are drawn from a texel, 1/sr
/// error  of the place in the map, 1e-6 of its width
/// twin   lobe::EnvironmentMap (engine/environment/environment_map.hpp)
#include "common/constants.glsl"

uniform sampler2D uEnvMap;
uniform mat3 uEnvMapFromWorld;
uniform vec3 uEnvScale;

/// In texels from the left edge and from the top of the picture.
vec2 environment_place(vec3 d_w, ivec2 size)
{
    vec3 d = uEnvMapFromWorld * d_w;
    float across = length(d.xz);
    float polar = atan(across, d.y);
    float azimuth = across > 0.0 ? atan(d.x, -d.z) * (0.5 * INV_PI) : 0.0;
    return vec2(azimuth - floor(azimuth), polar * INV_PI) * vec2(size);
}

ivec2 environment_size() { return textureSize(uEnvMap, 0) - ivec2(0, 2); }

vec3 environment_radiance(vec3 d_w)
{
    ivec2 size = environment_size();
    vec2 place = environment_place(d_w, size) - 0.5;
    vec2 first = floor(place);
    vec2 t = place - first;
    int x0 = int(first.x) < 0 ? size.x - 1 : min(int(first.x), size.x - 1);
    int x1 = x0 + 1 < size.x ? x0 + 1 : 0;
    int y = clamp(int(first.y) + 1, 0, size.y);
    vec3 top = mix(texelFetch(uEnvMap, ivec2(x0, y), 0).rgb, texelFetch(uEnvMap, ivec2(x1, y), 0).rgb, t.x);
    vec3 bottom = mix(texelFetch(uEnvMap, ivec2(x0, y + 1), 0).rgb, texelFetch(uEnvMap, ivec2(x1, y + 1), 0).rgb, t.x);
    return mix(top, bottom, t.y) * uEnvScale;
}

/// With which directions are drawn by brightness, 1/sr.
float environment_density(vec3 d_w)
{
    ivec2 size = environment_size();
    ivec2 at = clamp(ivec2(floor(environment_place(d_w, size))), ivec2(0), size - 1);
    return texelFetch(uEnvMap, at + ivec2(0, 1), 0).a;
}
