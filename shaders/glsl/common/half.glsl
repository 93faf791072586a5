/// half.glsl - what microfacet models need of the half vector h = wi + wo, which is not unit.
///
/// stable every quantity is a sum of squares or a ratio of sums; nothing is 1 minus something
#include "common/dirs.glsl"

struct Half {
    float h2;      // |h|^2 = 4 cos^2(theta_d)
    float vh;      // cos(theta_d), theta_d between either direction and h
    float s2;      // sin^2(theta_d)
    vec2 slope;    // tan(theta_h) (cos(phi_h), sin(phi_h))
    float tan2;    // tan^2(theta_h), theta_h between normal and h
    float nh2;     // cos^2(theta_h)
};

/// For directions above the surface; finite for any.
Half half_make(Dirs d)
{
    Half r;
    r.h2 = max(dot(d.h, d.h), 1e-37);
    r.vh = min(0.5 * sqrt(r.h2), 1.0);
    vec3 difference = d.wi - d.wo;
    r.s2 = min(0.25 * dot(difference, difference), 1.0);
    r.slope = d.h.xy / max(d.h.z, 1e-18);
    r.tan2 = dot(r.slope, r.slope);
    r.nh2 = 1.0 / (1.0 + r.tan2);
    return r;
}
