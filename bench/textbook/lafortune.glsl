/// lafortune.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

#include "common/table.glsl"

vec3 lafortune_f_cos(Dirs d, LafortuneParams p)
{
    if (d.wi.z <= 0.0 || d.wo.z <= 0.0)
        return vec3(0.0);
    vec3 f = p.diffuse / 3.14159265;
    int count = int(table_row(p.lobes).x);
    for (int i = 0; i < count; ++i) {
        int row = p.lobes + 1 + 4 * i;
        vec3 s = table_row(row).xyz * d.wi.x * d.wo.x + table_row(row + 1).xyz * d.wi.y * d.wo.y +
                 table_row(row + 2).xyz * d.wi.z * d.wo.z;
        f += pow(max(s, 0.0), table_row(row + 3).xyz);
    }
    return f * d.wi.z;
}
