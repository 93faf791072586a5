/// environment.glsl - what a surface reflects of the environment.
///
/// ENVIRONMENT_PREFILTERED: from the map blurred by the model's lobe, times what the lobe reflects of a constant one
/// (engine/environment/prefiltered.hpp); Lambert's part by irradiance. ENVIRONMENT_TERMS: of the model's lobe, 0 for
/// Lambert alone. ENVIRONMENT_WIDTHS: its width varies. ENVIRONMENT_SH: order of the harmonics that stand for a map of
/// irradiance. ENVIRONMENT_SAMPLED: by directions, half of them drawn by brightness and the same for all pixels but for
/// the place in the list, half drawn from a GGX lobe and a cosine; weighed by the balance heuristic (Veach and Guibas,
/// SIGGRAPH 1995). ENVIRONMENT_MIRROR: the model mirrors; with MIRRORED_LIGHTS, lights with a body
/// are before the environment. ENVIRONMENT_ALONE: these are not shown here. ENVIRONMENT_SHADOWS: rays find where it is blocked.
#if defined(ENVIRONMENT_SAMPLED) || defined(ENVIRONMENT_MIRROR)
#include "light/environment.glsl"
#endif

#ifdef ENVIRONMENT_SHADOWS
float environment_visible(LightReceiver r, vec3 wi_w)
{
    return light_visibility_by_ray(1.0, r, wi_w, uintBitsToFloat(0x7f800000u));
}
#endif

#ifdef ENVIRONMENT_MIRROR
uniform int uEnvMirrored;  // 1 in one of the draws that add up

vec3 environment_mirrored(LightReceiver r, MODEL_PARAMS params)
{
    float c = r.wo.z;
    if (!(c > 0.0))
        return vec3(0.0);
    vec3 wi_w = normalize(2.0 * c * r.frame.n - r.wo_w);
    vec3 light = environment_radiance(wi_w) * model_mirror(c, dot(r.wo.xy, r.wo.xy), params);
#ifdef MIRRORED_LIGHTS
    if (area_nearest(r, wi_w).type >= 0)
        return vec3(0.0);
#endif
#ifdef ENVIRONMENT_SHADOWS
    light *= environment_visible(r, wi_w);
#endif
    return light;
}
#endif

#ifdef ENVIRONMENT_PREFILTERED
#include "common/octahedral.glsl"
#if defined(OCCLUSION_TEXTURES) || defined(AMBIENT_OCCLUSION)
#define ENVIRONMENT_OCCLUDED
#include "pass/occlusion.glsl"
#endif

const float ENVIRONMENT_ANGLES = 40.0;  // of the table, at equal steps of sqrt(N.V)

uniform sampler2D uEnvLight;
uniform mat3 uEnvFromWorld;
uniform vec3 uEnvLightScale;
uniform vec3 uEnvTable;  // first texel; rows

/// A square with a border, from texel square.xy on.
vec3 environment_square(vec3 square, vec3 d)
{
    vec2 p = octahedral_encode(d) * 0.5 + 0.5;
    return texture(uEnvLight, (square.xy + 1.0 + p * square.z) / vec2(textureSize(uEnvLight, 0))).rgb;
}

vec4 environment_table(float block, vec2 place)
{
    vec2 texel = uEnvTable.xy + vec2(block * ENVIRONMENT_ANGLES, 0.0) + place + 0.5;
    return texture(uEnvLight, texel / vec2(textureSize(uEnvLight, 0)));
}

#ifdef ENVIRONMENT_SH
uniform vec3 uEnvHarmonics[ENVIRONMENT_SH == 2 ? 9 : 18];

/// Irradiance / pi.
vec3 environment_irradiance(vec3 n)
{
    float x = n.x, y = n.y, z = n.z, xx = x * x, yy = y * y, zz = z * z;
    vec3 sum = 0.282094792 * uEnvHarmonics[0];
    sum += 0.488602512 * (y * uEnvHarmonics[1] + z * uEnvHarmonics[2] + x * uEnvHarmonics[3]);
    sum += 1.092548431 * (x * y * uEnvHarmonics[4] + y * z * uEnvHarmonics[5] + x * z * uEnvHarmonics[7]);
    sum += 0.315391565 * (3.0 * zz - 1.0) * uEnvHarmonics[6] + 0.546274215 * (xx - yy) * uEnvHarmonics[8];
#if ENVIRONMENT_SH == 4
    sum += 2.503342942 * x * y * (xx - yy) * uEnvHarmonics[9];
    sum += 1.770130770 * z * (y * (3.0 * xx - yy) * uEnvHarmonics[10] + x * (xx - 3.0 * yy) * uEnvHarmonics[16]);
    sum += (7.0 * zz - 1.0) * (0.946174696 * x * y * uEnvHarmonics[11] + 0.473087348 * (xx - yy) * uEnvHarmonics[15]);
    sum += 0.669046544 * z * (7.0 * zz - 3.0) * (y * uEnvHarmonics[12] + x * uEnvHarmonics[14]);
    sum += 0.105785547 * (zz * (35.0 * zz - 30.0) + 3.0) * uEnvHarmonics[13];
    sum += 0.625835735 * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy)) * uEnvHarmonics[17];
#endif
    return max(sum, vec3(0.0));
}
#else
uniform vec3 uEnvIrradiance;

vec3 environment_irradiance(vec3 n) { return environment_square(uEnvIrradiance, n); }
#endif

#if ENVIRONMENT_TERMS > 0
uniform vec3 uEnvLayers[16];
uniform int uEnvLayerCount;
#ifdef ENVIRONMENT_WIDTHS
uniform vec2 uEnvWidths;  // ln of the first row's, rows per unit of ln
#endif

vec3 environment_layers(vec3 d, float layer)
{
    int first = clamp(int(layer), 0, max(uEnvLayerCount - 2, 0));
    vec3 narrow = environment_square(uEnvLayers[first], d);
    if (uEnvLayerCount == 1)
        return narrow;
    return mix(narrow, environment_square(uEnvLayers[first + 1], d), clamp(layer - float(first), 0.0, 1.0));
}
#endif

vec3 environment_prefiltered(LightReceiver r, MODEL_PARAMS params)
{
    if (!(r.wo.z > 0.0))
        return vec3(0.0);
    AreaWeights weights = model_area(params);
    vec2 place = vec2(sqrt(min(r.wo.z, 1.0)) * (ENVIRONMENT_ANGLES - 1.0), 0.0);
#ifdef ENVIRONMENT_WIDTHS
    place.y = clamp((log(max(model_area_width(params), 1e-30)) - uEnvWidths.x) * uEnvWidths.y, 0.0, uEnvTable.z - 1.0);
#endif
    vec4 first = environment_table(0.0, place);
    vec3 n = uEnvFromWorld * r.frame.n;
#ifdef ENVIRONMENT_OCCLUDED
    OpenCone open = occlusion_cone(r.frame.n);
    vec3 sum = weights.lambert * first.a * open.share * environment_irradiance(uEnvFromWorld * normalize(open.axis + r.frame.n));
#else
    vec3 sum = weights.lambert * first.a * environment_irradiance(n);
#endif
#if ENVIRONMENT_TERMS > 0
    vec3 albedo = weights.first * first.rgb;
#if ENVIRONMENT_TERMS > 1
    albedo += weights.second * environment_table(1.0, place).rgb;
#endif
    vec3 middle = environment_table(2.0, place).rgb;
    vec3 across = r.wo.z * r.frame.n - r.wo_w;  // of length sin(theta)
    across *= inversesqrt(max(dot(across, across), 1e-20));
    vec3 d_w = middle.x * across + middle.y * r.frame.n;
    vec3 d = uEnvFromWorld * d_w;
#ifdef ENVIRONMENT_OCCLUDED
    float roughness = model_roughness(params);
    albedo *= occlusion_of_lobe(open, r.frame.n, normalize(d_w), clamp(roughness * roughness, 0.0, 1.0));
#endif
    sum += albedo * environment_layers(d, middle.z);
#endif
    return sum * uEnvLightScale;
}
#endif

#ifdef ENVIRONMENT_SAMPLED
#include "common/pixel_lattice.glsl"

uniform samplerBuffer uEnvDirections;        // two texels each, 2^n in all: unit, world axes, density; radiance
uniform int uEnvPairsFirst, uEnvPairsEnd;    // this draw's
uniform int uEnvPairsAll;
uniform int uEnvFrame;

/// Of directions drawn by environment_lobe(), 1/sr: the first of two by visible normals of GGX, the second by a cosine.
/// alpha: width of the lobe; share: of the first.
float environment_lobe_density(vec3 wi, vec3 wo, float alpha, float share)
{
    vec3 h = wi + wo;
    float a2 = alpha * alpha;
    float x = dot(h.xy, h.xy), y = h.z * h.z;
    float u = alpha * (x + y) / max(x + a2 * y, 1e-37);  // sqrt(pi D)
    float masking = wo.z + sqrt(a2 + (1.0 - alpha) * (1.0 + alpha) * wo.z * wo.z);
    return share * INV_PI * u * u * 0.5 / masking + (1.0 - share) * INV_PI * max(wi.z, 0.0);
}

vec3 environment_lobe(vec2 u, vec3 wo, float alpha, bool cosine)
{
    float phi = 2.0 * PI * u.y;
    if (cosine) {
        float s = sqrt(u.x);
        return vec3(s * cos(phi), s * sin(phi), sqrt(max(1.0 - u.x, 0.0)));
    }
    vec3 v = normalize(vec3(alpha * wo.xy, wo.z));
    float across2 = dot(v.xy, v.xy);
    vec3 t1 = across2 > 0.0 ? vec3(-v.y, v.x, 0.0) * inversesqrt(across2) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(v, t1);
    float radius = sqrt(u.x);
    float a = radius * cos(phi), b = radius * sin(phi);
    float s = 0.5 * (1.0 + v.z);
    b = (1.0 - s) * sqrt(max(1.0 - a * a, 0.0)) + s * b;
    vec3 h = a * t1 + b * t2 + sqrt(max(1.0 - a * a - b * b, 0.0)) * v;
    h = normalize(vec3(alpha * h.xy, max(h.z, 0.0)));
    return normalize(2.0 * dot(wo, h) * h - wo);
}

vec3 environment_from(LightReceiver r, MODEL_PARAMS params, vec3 wi_w, vec3 radiance, float density)
{
    vec3 light = light_reflected(r, params, wi_w) * radiance;
    light = density > 0.0 ? light / density : vec3(0.0);
#ifdef ENVIRONMENT_SHADOWS
    if (light != vec3(0.0))
        light *= environment_visible(r, wi_w);
#endif
    return light;
}

vec3 environment_sampled(LightReceiver r, MODEL_PARAMS params)
{
    if (!(r.wo.z > 0.0))
        return vec3(0.0);
    float roughness = model_roughness(params);
    float alpha = clamp(roughness * roughness, 1e-4, 1.0);
    float share = float((uEnvPairsAll + 1) / 2) / float(uEnvPairsAll);  // even pairs draw by normals
    uvec2 shift = lattice_hash(uvec3(uvec2(gl_FragCoord.xy), 0x456e7675u));
    // Runs of the list are as well spread as the whole of it.
    int start = (int(shift.x >> 8u) / uEnvPairsAll + uEnvFrame) * uEnvPairsAll;
    vec3 sum = vec3(0.0);
    int last = textureSize(uEnvDirections) / 2 - 1;
    int i = uEnvPairsFirst;
    do {
        int row = 2 * ((start + i) & last);
        vec4 drawn = texelFetch(uEnvDirections, row);
        vec3 wi = frame_to_local(r.frame, drawn.xyz);
        if (wi.z > 0.0)
            sum += environment_from(r, params, drawn.xyz, texelFetch(uEnvDirections, row + 1).rgb,
                                    drawn.w + environment_lobe_density(wi, r.wo, alpha, share));
        bool cosine = (i & 1) != 0;
        vec2 u = lattice_point(cosine ? shift.yx : shift, uEnvFrame * ((uEnvPairsAll + 1) / 2) + (i >> 1));
        wi = environment_lobe(u, r.wo, alpha, cosine);
        vec3 wi_w = wi.x * r.frame.t + wi.y * r.frame.b + wi.z * r.frame.n;
        if (wi.z > 0.0)
            sum += environment_from(r, params, wi_w, environment_radiance(wi_w),
                                    environment_density(wi_w) + environment_lobe_density(wi, r.wo, alpha, share));
    } while (++i < uEnvPairsEnd);
    light_loop_ended(i >= uEnvPairsEnd);
    return sum / float(uEnvPairsAll);
}
#endif

vec3 environment_light(LightReceiver r, MODEL_PARAMS params)
{
    vec3 sum = vec3(0.0);
#ifdef ENVIRONMENT_PREFILTERED
    sum += environment_prefiltered(r, params);
#endif
#ifdef ENVIRONMENT_SAMPLED
    sum += environment_sampled(r, params);
#endif
#ifdef ENVIRONMENT_MIRROR
    if (uEnvMirrored == 1)
        sum += environment_mirrored(r, params);
#endif
    return sum;
}
