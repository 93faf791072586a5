/// measured.glsl - isotropic measurements over half and difference angles. Registry name: measured.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = scale times the table, interpolated linearly between the centres of its cells
/// frame  Dirs d: local, z = shading normal (common/dirs.glsl)
/// params scale  0..1    per channel, no unit: multiplies the table
///        file   0..2e7  first row of the table (common/table.glsl): numbers of cells along theta_h, theta_d and phi_d;
///                      albedo at normal incidence; then a row a cell, phi_d fastest, theta_h slowest
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0. theta_h = pi/2 (i / n)^2, theta_d = pi/2 i / n, phi_d = pi i / n, repeating:
///        cells 1.9e-4 rad wide at the peak of a MERL table
/// source Matusik et al., ACM TOG 22(3), 2003; Rusinkiewicz, EGWR 1998
/// stable all angles from ratios of lengths, never acos, which would be off by a cell and more where highlights are
/// error  relative, at most 8 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/measured.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/numeric.glsl"
#include "common/table.glsl"

struct MeasuredParams { vec3 scale; int file; };

/// Between cells i and i + 1 of n, whose centres lie at the half numbers: the first cell and the share of the second.
vec2 measured_place(float coordinate, float n)
{
    float x = clamp(coordinate - 0.5, 0.0, n - 1.0);
    float i = min(floor(x), max(n - 2.0, 0.0));
    return vec2(i, x - i);
}

vec3 measured_f_cos(Dirs d, MeasuredParams p)
{
    vec3 n = table_row(p.file).xyz;
    float h_xy = length(d.h.xy);
    float theta_h = numeric_angle(max(d.h.z, 0.0), h_xy);
    vec3 difference = d.wi - d.wo;
    float theta_d = numeric_angle(length(d.h), length(difference));

    // The difference vector turned so that h lies along z: its azimuth, from 0 to pi because L and V may be exchanged.
    vec2 along = h_xy > 0.0 ? d.h.xy / h_xy : vec2(1.0, 0.0);
    float h_length = max(length(d.h), 1e-18);
    float x = dot(difference.xy, along) * (d.h.z / h_length) - difference.z * (h_xy / h_length);
    float y = dot(difference.xy, vec2(-along.y, along.x));
    float angle = numeric_angle(abs(x), abs(y));
    float phi_d = x * y < 0.0 ? PI - angle : angle;

    vec2 ih = measured_place(n.x * sqrt(theta_h * (1.0 / HALF_PI)), n.x);
    vec2 id = measured_place(n.y * theta_d * (1.0 / HALF_PI), n.y);
    float xp = n.z * phi_d * INV_PI - 0.5;
    float p0 = floor(xp);
    float share = xp - p0;
    int np = int(n.z);
    ivec2 ip = ivec2(int(p0) + np, int(p0) + 1) % np;

    vec3 f = vec3(0.0);
    for (int k = 0; k < 8; ++k) {
        bvec3 upper = bvec3((k & 1) != 0, (k & 2) != 0, (k & 4) != 0);
        float weight = (upper.x ? ih.y : 1.0 - ih.y) * (upper.y ? id.y : 1.0 - id.y) * (upper.z ? share : 1.0 - share);
        int h = min(int(ih.x) + (upper.x ? 1 : 0), int(n.x) - 1);
        int e = min(int(id.x) + (upper.y ? 1 : 0), int(n.y) - 1);
        f += weight * table_row(p.file + 2 + (upper.z ? ip.y : ip.x) + np * (e + int(n.y) * h)).xyz;
    }
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? p.scale * f * d.wi.z : vec3(0.0);
}

vec3 measured_ambient(MeasuredParams p) { return p.scale * table_row(p.file + 1).xyz; }
float measured_roughness(MeasuredParams p) { return 0.5; }

/// For lights with a body: the table as a whole.
AreaWeights measured_area(MeasuredParams p) { return AreaWeights(vec3(0.0), p.scale, vec3(0.0)); }
