/// soft_maps.glsl - visibility of lights with a body by shadow maps: percentage-closer soft shadows.
///
/// value  0..1: of a sphere about the centre of a cube of maps
/// frame  world axes, relative to the eye, m
/// params record  of the cube, 5 texels: two as in maps.glsl, then for x, y, z the inverse of the least depth of what casts
///        towards + and -, 1/m, 0 where nothing is
///        radius  of the sphere, m
/// domain any finite point and radius; where nothing is between, and at the centre itself, 1
/// source Fernando, "Percentage-closer soft shadows", SIGGRAPH sketches 2005; disc: Vogel 1979
/// stable comparisons with the receiver's plane at each tap, which is linear in inverse depths: no plane shadows itself
///        however large the filter, and nothing is moved. In inverse depths s a blocker moves by radius (s - s_receiver)
/// error  exact for one plane blocker and many taps; blockers at several depths are averaged (docs/shadows.md)
#include "shadow/maps.glsl"

uniform sampler2DArray uShadowDepths;  // uShadowMaps, read without comparison
uniform float uShadowTurn;             // of the taps, from frame to frame, 0..1

const int SHADOW_BLOCKER_TAPS = (SHADOW_TAPS + 1) / 2;

/// A cube's record.
struct ShadowCube { vec4 origin, layout_; };

/// Axis of the face that a direction meets: 0 x, 1 y, 2 z.
float shadow_axis(vec3 d)
{
    vec3 a = abs(d);
    return a.x >= a.y && a.x >= a.z ? 0.0 : a.y >= a.z ? 1.0 : 2.0;
}

/// What a tap sees in the direction `d`: inverse distances to the nearest surface, and to the plane dot(plane, d) where
/// the tap's texel has it nearest, in units of d's own.
struct ShadowTap { float nearest, plane; };

ShadowTap shadow_tap(ShadowCube cube, vec3 d, vec3 plane)
{
    float axis = shadow_axis(d);
    vec3 turned = axis == 0.0 ? d.yzx : axis == 1.0 ? d.zxy : d;
    vec3 slope = axis == 0.0 ? plane.yzx : axis == 1.0 ? plane.zxy : plane;
    float m = abs(turned.z);
    float tile = cube.layout_.z + 2.0 * axis + (turned.z < 0.0 ? 1.0 : 0.0);
    float layer = floor(0.25 * tile);
    float quarter = tile - 4.0 * layer;
    float most = 0.5 * cube.layout_.w - 0.5;
    vec2 t = clamp(turned.xy * (cube.layout_.y / m), -most, most);
    vec2 at = cube.layout_.w * (vec2(mod(quarter, 2.0), floor(0.5 * quarter)) + 0.5) + t;
    float stored = textureLod(uShadowDepths, vec3(at * uShadowTexel, layer), 0.0).x;
    // The texel's middle is half a texel away at most, and what rasterisers round.
    float off = (0.5 + 1.0 / 128.0) * cube.layout_.x * m * (abs(slope.x) + abs(slope.y));
    return ShadowTap(stored / cube.origin.w * m, dot(plane, d) + off);
}

/// 0..1, different from pixel to pixel (Jimenez, "Next generation post processing in Call of Duty", SIGGRAPH 2014).
float shadow_noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

float shadow_soft(int record, vec3 p, vec3 n, float radius)
{
    ShadowCube cube = ShadowCube(texelFetch(uShadowRecords, record), texelFetch(uShadowRecords, record + 1));
    vec3 q = p - cube.origin.xyz;
    float axis = shadow_axis(q);
    vec3 turned = axis == 0.0 ? q.yzx : axis == 1.0 ? q.zxy : q;
    vec3 across = axis == 0.0 ? vec3(0.0, 1.0, 0.0) : axis == 1.0 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    vec3 up = axis == 0.0 ? vec3(0.0, 0.0, 1.0) : axis == 1.0 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec2 faces = texelFetch(uShadowRecords, record + 2 + int(axis)).xy;
    float first = turned.z < 0.0 ? faces.y : faces.x;
    float z = max(abs(turned.z), cube.origin.w);
    float inverse = 1.0 / z;
    vec3 d = q * inverse;
    // The receiver's plane, moved towards the light by what its position and its normal are not sure of.
    float distance = dot(n, q);
    float sure = max(abs(distance) - shadow_rounding(q, p) - SHADOW_NORMAL_ERROR * cube.layout_.x * z, 1e-6 * z);
    vec3 plane = n * ((distance < 0.0 ? -1.0 : 1.0) / sure);
    inverse *= 1.000001;

    float turn = 6.2831853 * fract(shadow_noise(gl_FragCoord.xy) + uShadowTurn);
    vec2 direction = vec2(cos(turn), sin(turn));
    const vec2 golden = vec2(-0.73736888, 0.67549029);
    float search = clamp(radius * (first - inverse), 0.0, 1.0);
    float blockers = 0.0, sum = 0.0;
    int i = 0;
    do {
        vec2 o = direction * (search * sqrt((float(i) + 0.5) / float(SHADOW_BLOCKER_TAPS)));
        ShadowTap tap = shadow_tap(cube, d + across * o.x + up * o.y, plane);
        float blocks = tap.nearest > max(tap.plane, inverse) ? 1.0 : 0.0;
        blockers += blocks;
        sum += blocks * tap.nearest;
        direction = vec2(direction.x * golden.x - direction.y * golden.y, direction.x * golden.y + direction.y * golden.x);
    } while (++i < SHADOW_BLOCKER_TAPS);

    float wide = clamp(radius * (sum / max(blockers, 1.0) - inverse), 0.5 * cube.layout_.x, 1.0);
    float dark = 0.0;
    i = 0;
    do {
        vec2 o = direction * (wide * sqrt((float(i) + 0.5) / float(SHADOW_TAPS)));
        ShadowTap tap = shadow_tap(cube, d + across * o.x + up * o.y, plane);
        dark += tap.nearest > max(tap.plane, inverse) ? 1.0 : 0.0;
        direction = vec2(direction.x * golden.x - direction.y * golden.y, direction.x * golden.y + direction.y * golden.x);
    } while (++i < SHADOW_TAPS);
    return blockers > 0.0 ? 1.0 - dark / float(SHADOW_TAPS) : 1.0;
}

/// Of the light with a body whose shadow is in `slot`, counted from the first record of its type.
float shadow_maps_soft(int first, float slot, LightReceiver r, float radius)
{
    float visible = 1.0;
    if (slot >= 0.0)
        visible = shadow_soft(first + 5 * int(slot), r.position, r.geometric_normal, radius);
    return visible;
}
