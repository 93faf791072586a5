/// area_weights.glsl - how the colours of a surface weigh the parts of its reflection, for lights with a body.
///
/// value  f_r cos(theta_i) = lambert base cos(theta_i) / pi + first term_1 + second term_2, in which `base` and the terms
///        are what tables hold (light/transformed_lobe.glsl); no unit
/// twin   lobe::AreaWeights (engine/shading/area_model.hpp)

struct AreaWeights { vec3 lambert, first, second; };

/// Of microfacet models: the terms of Schlick's F = f0 (1 - S) + S; of the exact F (type other than 0) the whole lobe is
/// the first.
AreaWeights area_microfacet(vec3 diffuse, vec3 specular, int fresnel, vec3 f0)
{
    bool schlick = fresnel == 0;
    return AreaWeights(diffuse, schlick ? specular * f0 : specular, schlick ? specular : vec3(0.0));
}
