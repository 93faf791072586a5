/// measured.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

#include "common/table.glsl"

vec3 textbook_turned(vec3 v, vec3 axis, float angle)
{
    float c = cos(angle);
    return v * c + cross(axis, v) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}

/// Rusinkiewicz's angles by two rotations, as in the database's own reader; between cells as the model.
vec3 measured_f_cos(Dirs d, MeasuredParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 n = table_row(p.file).xyz;
    vec3 h = normalize(d.wi + d.wo);
    float theta_h = acos(min(h.z, 1.0));
    float phi_h = atan(h.y, h.x);
    vec3 diff = textbook_turned(textbook_turned(d.wi, vec3(0.0, 0.0, 1.0), -phi_h), vec3(0.0, 1.0, 0.0), -theta_h);
    float theta_d = acos(min(diff.z, 1.0));
    float phi_d = atan(diff.y, diff.x);
    if (phi_d < 0.0)
        phi_d += 3.14159265;
    vec3 x = vec3(sqrt(theta_h / 1.57079633) * n.x, theta_d / 1.57079633 * n.y, phi_d / 3.14159265 * n.z) - 0.5;
    x.xy = clamp(x.xy, vec2(0.0), n.xy - 1.0);
    vec3 low = floor(x);
    vec3 share = x - low;
    vec3 f = vec3(0.0);
    for (int k = 0; k < 8; ++k) {
        vec3 corner = vec3(k & 1, (k >> 1) & 1, (k >> 2) & 1);
        vec3 weight = mix(1.0 - share, share, corner);
        vec3 cell = low + corner;
        cell.xy = min(cell.xy, n.xy - 1.0);
        cell.z = mod(cell.z, n.z);
        f += weight.x * weight.y * weight.z * table_row(p.file + 2 + int(cell.z + n.z * (cell.y + n.y * cell.x))).xyz;
    }
    return p.scale * f * d.wi.z;
}
