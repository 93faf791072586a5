/// maps.glsl - visibility of directional, point and spot lights by shadow maps.
///
/// value  0..1: the share of SHADOW_SIDE x SHADOW_SIDE bilinear comparisons that is lit
/// frame  world axes, relative to the eye, m
/// params records of lobe::ShadowMaps. A map is 5 texels: origin, 1 / depth (parallel) or where it begins
///        (perspective); a texel's vector across, 1 / its square; the same up; z, 1 where the spot has a cube; the
///        tile's middle and layer, texels from the middle that are inside. A cube is 2: origin, where it begins; size of
///        a texel at 1 m, its inverse, first tile, tile's side
/// domain any finite point; outside a map, behind a spot and at the light everything is lit
/// source bias: docs/shadows.md; filter: Reeves, Salesin, Cook, SIGGRAPH 1987
/// stable a plane shadows itself nowhere: the receiver is moved along its normal, never along the light
/// twin   lobe::normalOffset, lobe::shadowCoordinates (engine/passes/shadow_fit.cpp)

uniform sampler2DArrayShadow uShadowMaps;
uniform samplerBuffer uShadowRecords;
uniform float uShadowTexel;  // 1 / texels a side of a layer

// ShadowFilter::radius()
const float SHADOW_RADIUS = 0.5 * float(SHADOW_SIDE - 1) + 1.0 + 1.0 / 128.0;
// The stored normal's error, with that of the differences it comes from, rad.
const float SHADOW_NORMAL_ERROR = 5e-4;
// A position is off by at most so much of its distance from the eye and from the map's origin.
const float SHADOW_POSITION_ERROR = 1.0 / 524288.0;

float shadow_largest(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

/// Shift along the normal by which no plane shadows itself, in parallel light. `across`, `up`: a texel's vectors; `q`:
/// from the map's origin; `p`: from the eye.
float shadow_offset_parallel(vec3 n, vec3 across, vec3 up)
{
    float unsure = SHADOW_NORMAL_ERROR * (shadow_largest(across) + shadow_largest(up));
    return SHADOW_RADIUS * (abs(dot(n, across)) + abs(dot(n, up)) + unsure);
}

/// The same `z` before the light, with the texels' vectors at 1 m.
float shadow_offset_perspective(vec3 n, vec3 across, vec3 up, float z)
{
    float slope = shadow_offset_parallel(n, across, up);
    return max(z, 0.0) * slope / max(1.0 - slope, 0.5);
}

/// By what rounding may have moved a point; `q`: from the map's origin; `p`: from the eye.
float shadow_rounding(vec3 q, vec3 p) { return SHADOW_POSITION_ERROR * (shadow_largest(q) + shadow_largest(p)); }

/// `at`: in texels of the layer.
float shadow_filtered(vec2 at, float layer, float depth)
{
    vec2 first = (at - 0.5 * float(SHADOW_SIDE - 1)) * uShadowTexel;
    float lit = 0.0;
    int j = 0;
    do {
        int i = 0;
        do
            lit += texture(uShadowMaps, vec4(first + vec2(i, j) * uShadowTexel, layer, depth));
        while (++i < SHADOW_SIDE);
    } while (++j < SHADOW_SIDE);
    return lit / float(SHADOW_SIDE * SHADOW_SIDE);
}

/// Where a map is read, in texels of its layer, and what with; `inside` false where everything is lit.
struct ShadowLookup {
    vec2 at;
    float layer;
    float depth;
    bool inside;
};

ShadowLookup shadow_lookup_parallel(int record, vec3 p, vec3 n)
{
    vec4 origin = texelFetch(uShadowRecords, record);
    vec4 across = texelFetch(uShadowRecords, record + 1);
    vec4 up = texelFetch(uShadowRecords, record + 2);
    vec3 z = texelFetch(uShadowRecords, record + 3).xyz;
    vec4 tile = texelFetch(uShadowRecords, record + 4);
    vec3 q = p - origin.xyz;
    q += n * (shadow_offset_parallel(n, across.xyz, up.xyz) + shadow_rounding(q, p));
    vec2 t = vec2(dot(across.xyz, q) * across.w, dot(up.xyz, q) * up.w);
    return ShadowLookup(tile.xy + t, tile.z, max(1.0 - dot(z, q) * origin.w, 0.0), max(abs(t.x), abs(t.y)) < tile.w);
}

ShadowLookup shadow_lookup_perspective(int record, vec3 p, vec3 n)
{
    vec4 origin = texelFetch(uShadowRecords, record);
    vec4 across = texelFetch(uShadowRecords, record + 1);
    vec4 up = texelFetch(uShadowRecords, record + 2);
    vec3 axis = texelFetch(uShadowRecords, record + 3).xyz;
    vec4 tile = texelFetch(uShadowRecords, record + 4);
    vec3 q = p - origin.xyz;
    q += n * (shadow_offset_perspective(n, across.xyz, up.xyz, dot(axis, q)) + shadow_rounding(q, p));
    float z = dot(axis, q);
    float inverse = 1.0 / max(z, origin.w);
    vec2 t = vec2(dot(across.xyz, q) * across.w, dot(up.xyz, q) * up.w) * inverse;
    return ShadowLookup(tile.xy + t, tile.z, origin.w * inverse,
                        z > origin.w && max(abs(t.x), abs(t.y)) < tile.w);
}

/// Faces +X -X +Y -Y +Z -Z, a quarter of a layer each; across and up are the axes that follow in cyclic order.
ShadowLookup shadow_lookup_cube(int record, vec3 p, vec3 n)
{
    vec4 origin = texelFetch(uShadowRecords, record);
    vec4 cube = texelFetch(uShadowRecords, record + 1);
    vec3 q = p - origin.xyz;
    vec3 a = abs(q);
    float axis = a.x >= a.y && a.x >= a.z ? 0.0 : a.y >= a.z ? 1.0 : 2.0;
    vec3 turned = axis == 0.0 ? q.yzx : axis == 1.0 ? q.zxy : q;
    vec3 normal = axis == 0.0 ? n.yzx : axis == 1.0 ? n.zxy : n;
    float sign = turned.z < 0.0 ? -1.0 : 1.0;
    turned += normal * (shadow_offset_perspective(normal, vec3(cube.x, 0.0, 0.0), vec3(0.0, cube.x, 0.0),
                                                  abs(turned.z)) +
                        shadow_rounding(q, p));
    float z = sign * turned.z;
    float inverse = 1.0 / max(z, origin.w);
    float tile = cube.z + 2.0 * axis + (sign < 0.0 ? 1.0 : 0.0);
    float layer = floor(0.25 * tile);
    float quarter = tile - 4.0 * layer;
    vec2 middle = cube.w * (vec2(mod(quarter, 2.0), floor(0.5 * quarter)) + 0.5);
    // Only rounding of positions far from the eye leads out of the face.
    float most = 0.5 * cube.w - 0.5 * float(SHADOW_SIDE + 1);
    vec2 t = clamp(turned.xy * (cube.y * inverse), -most, most);
    return ShadowLookup(middle + t, layer, origin.w * inverse, z > origin.w);
}

/// Light from behind the receiver's triangle has to pass it.
float shadow_visibility(float slot, ShadowLookup look, LightReceiver r, vec3 wi_w)
{
    bool facing = dot(r.geometric_normal, wi_w) > 0.0;
    float lit = slot < 0.0 || facing ? 1.0 : r.behind;
    if (slot >= 0.0 && facing && look.inside)
        lit = shadow_filtered(look.at, look.layer, look.depth);
    return lit;
}

#ifdef DIRECTIONAL_SHADOW_MAPS
uniform int uShadowDirectional;

/// Four maps at most, by distance along the view axis.
float shadow_maps_directional(float slot, LightReceiver r, vec3 wi_w)
{
    int record = uShadowDirectional + 21 * int(max(slot, 0.0));
    vec3 ends = texelFetch(uShadowRecords, record).xyz;
    int cascade = int(dot(step(ends, vec3(r.z)), vec3(1.0)));
    return shadow_visibility(slot, shadow_lookup_parallel(record + 1 + 5 * cascade, r.position, r.geometric_normal),
                             r, wi_w);
}
#endif

#ifdef POINT_SHADOW_MAPS
uniform int uShadowPoint;

float shadow_maps_point(float slot, LightReceiver r, vec3 wi_w)
{
    return shadow_visibility(slot, shadow_lookup_cube(uShadowPoint + 2 * int(max(slot, 0.0)), r.position, r.geometric_normal),
                             r, wi_w);
}
#endif

#ifdef SPOT_SHADOW_MAPS
uniform int uShadowSpot;

float shadow_maps_spot(float slot, LightReceiver r, vec3 wi_w)
{
    int record = uShadowSpot + 5 * int(max(slot, 0.0));
    ShadowLookup look = shadow_lookup_perspective(record, r.position, r.geometric_normal);
#ifdef WIDE_SPOT_SHADOWS
    if (texelFetch(uShadowRecords, record + 3).w > 0.0)
        look = shadow_lookup_cube(record, r.position, r.geometric_normal);
#endif
    return shadow_visibility(slot, look, r, wi_w);
}
#endif
