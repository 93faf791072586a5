#include "baked_readme.hpp"

namespace lobe::app {

std::string bakedReadme() {
    return R"(# A prefiltered environment

Written by `lobe bake`. `environment.json` names every file; this says what is in them. All pictures are OpenEXR with
32-bit floats, linear sRGB primaries, row 0 at the top.

## Axes and scale
+Y is up. A direction d of the world is looked up at d_map = transpose(world_from_map) d, where `world_from_map` lists the
columns of a rotation. What is looked up is multiplied by `scale` (R, G, B): the product is radiance in W/(m^2 sr).
`sun`, where it is not null, is in none of the pictures: a light from `direction` (unit, towards it, world axes) of
`irradiance` (W/m^2 on a facing surface) and angular `diameter` (rad; 0: a directional light).

## environment.exr
Radiance, equirectangular. For a unit d_map = (x, y, z):
    u = atan2(x, -z) / (2 pi), wrapped to [0, 1);  v = acos(y) / pi, 0 at the top
Texel i has its middle at u = (i + 0.5) / width. Ideal mirrors look it up along the mirrored ray.

## Octahedral squares
`irradiance.exr` and the layers of models. For a unit d_map = (x, y, z), with n = |x| + |y| + |z| and p = (x, y) / n:
    if z < 0:  p = ((1 - |p.y|) sign(p.x), (1 - |p.x|) sign(p.y)), where sign(0) = 1
    texel coordinates = (p * 0.5 + 0.5) * size, the first texel's middle at 0.5, rows counted from row 0
Bilinear between texels; over an edge, texel (x, y) with x < 0 or x >= size is (clamp(x), size - 1 - y), and alike for y.

## irradiance.exr
E / pi by the direction of the normal: what a white Lambert surface shows. `harmonics_order_2` (9) and `harmonics_order_4` (18,
whose third band is 0 and left out) are the same as coefficients c of real orthonormal spherical harmonics without the
Condon-Shortley phase, E / pi = sum of c_i Y_i(n):
    Y_0 = 0.282095;  Y_1..3 = 0.488603 (y, z, x);  Y_4, 5, 7 = 1.092548 (xy, yz, xz);
    Y_6 = 0.315392 (3 zz - 1);  Y_8 = 0.546274 (xx - yy);
    Y_9 = 2.503343 xy (xx - yy);  Y_10 = 1.770131 yz (3 xx - yy);  Y_11 = 0.946175 xy (7 zz - 1);
    Y_12 = 0.669047 yz (7 zz - 3);  Y_13 = 0.105786 (35 zz zz - 30 zz + 3);  Y_14 = 0.669047 xz (7 zz - 3);
    Y_15 = 0.473087 (xx - yy) (7 zz - 1);  Y_16 = 1.770131 xz (xx - 3 yy);
    Y_17 = 0.625836 (xx (xx - 3 yy) - yy (3 xx - yy))
Where they would be negative anywhere, bands are weakened until they are not.

## Models
A model's f cos(theta_i) is lambert base cos(theta_i) / pi + sum over terms of weight times term, where `lambert` and the weights are
colours: what NAME_area() of shaders/glsl/brdf/NAME.glsl of Lobe returns. For a unit normal n, a unit direction w to the eye and
c = dot(n, w):

    place = (sqrt(c) * (angles - 1), row)             in texels of NAME/split.exr, bilinear, texel i at i
    row   = clamp((ln(width) - first_ln) * rows_per_ln, 0, rows - 1)     or 0 where `width` is null
    across = normalize(c n - w)                        any unit vector at right angles to n where c = 1
    d      = lobe.across * across + lobe.along * n
    light  = layer(d, lobe.layer)                      linear between layers floor(lobe.layer) and the next
    shown  = scale * (lambert * base.Y * irradiance(n)
                      + (weight_1 * first.RGB + weight_2 * second.RGB) * light)

`first` and `second` are what the terms reflect of a constant environment of 1; d is the middle of the lobe; the layers hold the
environment blurred by the model's own lobe, from narrow to wide, seen from the normal. Models with 0 terms have no layers.
Other parameters than colours and width are the model's defaults.
)";
}

}  // namespace lobe::app
