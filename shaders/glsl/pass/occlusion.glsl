/// occlusion.glsl - what keeps the prefiltered environment from a surface: occlusion textures (OCCLUSION_TEXTURES) and what the
/// depth buffer shows (AMBIENT_OCCLUSION, pass/ambient_occlusion.frag). Where both know of something the darker counts: they
/// may know of the same.
///
/// value  shares of light, 0 to 1. What is open is taken for a cone about the mean direction that light comes from, as wide as
///        lets the share of irradiance through: its half-angle a has sin(a)^2 = share
/// source Jimenez, Wu, Pesce, Jarabo, "Practical real-time strategies for accurate indirect occlusion", 2016, section 6; the caps'
///        overlap after Oat and Sander, "Ambient aperture lighting", 2007
#include "common/octahedral.glsl"
#include "pass/occlusion_depth.glsl"

struct OpenCone {
    vec3 axis;    // unit, world
    float share;  // of the irradiance of a constant environment
};

#ifdef GBUFFER_READ
#ifdef OCCLUSION_TEXTURES
uniform sampler2D uOcclusion;
#endif
#ifdef AMBIENT_OCCLUSION
uniform sampler2D uAmbientOcclusion;
#endif

OpenCone occlusion_cone(vec3 n)
{
    OpenCone cone = OpenCone(n, 1.0);
#ifdef AMBIENT_OCCLUSION
    float code = texelFetch(uAmbientOcclusion, gbuffer_pixel(), 0).a, count = 0.0;
    ivec2 last = textureSize(uAmbientOcclusion, 0) - 1;
    vec3 axis = vec3(0.0);
    cone.share = 0.0;
    for (int i = 0; i < 9; ++i) {
        vec4 seen = texelFetch(uAmbientOcclusion, clamp(gbuffer_pixel() + ivec2(i % 3, i / 3) - 1, ivec2(0), last), 0);
        float apart = abs(seen.a - code);
        if (seen.a > 0.0 && min(apart, 1.0 - apart) < OCCLUSION_NEAR) {
            cone.share += seen.x;
            axis += seen.x * octahedral_decode(seen.yz * 2.0 - 1.0);
            count += 1.0;
        }
    }
    cone.share = min(cone.share / count, 1.0);  // the pixel itself is among them
    cone.axis = dot(axis, axis) > 1e-12 ? normalize(axis) : n;
#endif
#ifdef OCCLUSION_TEXTURES
    cone.share = min(cone.share, texelFetch(uOcclusion, gbuffer_pixel(), 0).x);
#endif
    return cone;
}
#else
OpenCone occlusion_cone(vec3 n) { return OpenCone(n, clamp(surface_occlusion(), 0.0, 1.0)); }
#endif

/// Share of a cone of half-angle `lobe` about `middle` that is open.
float occlusion_overlap(OpenCone cone, vec3 middle, float lobe)
{
    float open = acos(sqrt(1.0 - cone.share));
    float apart = acos(clamp(dot(cone.axis, middle), -1.0, 1.0));
    float least = abs(open - lobe), most = open + lobe;
    float t = clamp((apart - least) / max(most - least, 1e-6), 0.0, 1.0);
    float overlap = 1.0 - t * t * (3.0 - 2.0 * t);  // of the smaller of the two
    float whole = 1.0 - cos(lobe), smaller = 1.0 - cos(min(open, lobe));
    return overlap * smaller / max(whole, 1e-6);
}

/// Share of a lobe about `middle`, unit, half of whose light is within the tangent 2 alpha / (1 - alpha^2) of it, of what of
/// it is above the horizon about n.
float occlusion_of_lobe(OpenCone cone, vec3 n, vec3 middle, float alpha)
{
    float lobe = 2.0 * atan(max(alpha, 0.01));
    float above = occlusion_overlap(OpenCone(n, 1.0), middle, lobe);
    return min(occlusion_overlap(cone, middle, lobe) / max(above, 1e-3), 1.0);
}
