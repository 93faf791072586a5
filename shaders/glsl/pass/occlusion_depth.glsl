/// occlusion_depth.glsl - how pixels that are beside each other in the picture are told from such as are beside each other in
/// the scene.
///
/// Depth as a number above 0 and up to 1 that begins anew with each factor of 2^(1/4): two that differ by less than
/// OCCLUSION_NEAR, the ends being one, are as far away to 2 %. 0: the background.
const float OCCLUSION_NEAR = 0.115;

float occlusion_depth_code(float z) { return max(fract(4.0 * log2(max(z, 1e-30))), 1.0 / 65535.0); }
