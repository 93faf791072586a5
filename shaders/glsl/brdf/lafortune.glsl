/// lafortune.glsl - sum of generalised cosine lobes. Registry name: lafortune.
///
/// value  f_r cos(theta_i) in 1/sr, f_r = k_d / pi + sum over the lobes of
///        max(cx wi.x wo.x + cy wi.y wo.y + cz wi.z wo.z, 0)^n, per channel
/// frame  Dirs d: local, z = shading normal, x = tangent (common/dirs.glsl)
/// params diffuse  0..1   per channel, no unit: k_d
///        lobes    0..2e7  first row of the table (common/table.glsl): a row with the number of lobes in x, then four
///                        rows a lobe: cx, cy, cz, n, each per channel
/// domain 0 unless d.wi.z > 0 and d.wo.z > 0; lobes whose largest value, max(|cx|, |cy|, |cz|)^n, exceeds 1e30 are
///        refused when they are read
/// source Lafortune et al., SIGGRAPH 1997
/// stable the power as exp(n ln s), whose error is n times that of the sum s; nothing is raised to a power at s <= 0
/// error  relative, at most 3 x 2^-24 (4 + c) with c the condition number (docs/how_to/add_a_brdf.md)
/// twin   engine/shading/brdf/lafortune.cpp
#include "common/area_weights.glsl"
#include "common/constants.glsl"
#include "common/dirs.glsl"
#include "common/numeric.glsl"
#include "common/table.glsl"

struct LafortuneParams { vec3 diffuse; int lobes; };

/// max(s, 0)^n for n > 0
float lafortune_power(float s, float n) { return s > 0.0 ? numeric_exp(n * numeric_log(max(s, 1e-37))) : 0.0; }

vec3 lafortune_f_cos(Dirs d, LafortuneParams p)
{
    vec3 products = d.wi * d.wo;
    vec3 f = p.diffuse * INV_PI;
    int count = int(table_row(p.lobes).x);
    for (int i = 0; i < count; ++i) {
        int row = p.lobes + 1 + 4 * i;
        vec3 s = table_row(row).xyz * products.x + table_row(row + 1).xyz * products.y + table_row(row + 2).xyz * products.z;
        vec3 n = table_row(row + 3).xyz;
        f += vec3(lafortune_power(s.x, n.x), lafortune_power(s.y, n.y), lafortune_power(s.z, n.z));
    }
    return d.wi.z > 0.0 && d.wo.z > 0.0 ? f * d.wi.z : vec3(0.0);
}

vec3 lafortune_ambient(LafortuneParams p) { return p.diffuse; }

/// Roughness r of a lobe as wide as the sharpest one: r^4 = 2 / (4 n + 2).
float lafortune_roughness(LafortuneParams p)
{
    float n = 0.0;
    int count = int(table_row(p.lobes).x);
    for (int i = 0; i < count; ++i) {
        vec3 own = table_row(p.lobes + 4 + 4 * i).xyz;
        n = max(n, max(own.x, max(own.y, own.z)));
    }
    return sqrt(sqrt(1.0 / (2.0 * n + 1.0)));
}

/// Lambert's part, and the lobe's weights for lights with a body.
AreaWeights lafortune_area(LafortuneParams p) { return AreaWeights(p.diffuse, vec3(1.0), vec3(0.0)); }
