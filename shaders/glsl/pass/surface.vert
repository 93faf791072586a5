/// surface.vert - vertices of a scene's surfaces, in camera-relative world space.
///
/// frame  world axes, origin at the eye: coordinates stay small however far from the world's origin the camera is;
///        matrices are differences taken in double on the CPU
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
#ifdef TANGENTS
layout(location = 2) in vec4 aTangent;
#endif
#ifdef UV0
layout(location = 3) in vec2 aUv0;
#endif
#ifdef UV1
layout(location = 4) in vec2 aUv1;
#endif
#ifdef VERTEX_COLORS
layout(location = 5) in vec4 aColor;
#endif

uniform mat4 uRelativeFromLocal;
uniform mat3 uNormalFromLocal;   // inverse transpose, any scale
uniform mat4 uClipFromRelative;

out vec3 vPosition;
out vec3 vNormal;
#ifdef TANGENTS
out vec4 vTangent;
#endif
#ifdef UV0
out vec2 vUv0;
#endif
#ifdef UV1
out vec2 vUv1;
#endif
#ifdef VERTEX_COLORS
out vec4 vColor;
#endif

/// v / |v|, or zero. The largest component is divided out first: squares of lengths below 1e-16 flush to zero.
vec3 surface_unit(vec3 v)
{
    float m = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return m > 0.0 ? normalize(v / m) : vec3(0.0);
}

#ifdef PEELED
invariant gl_Position;  // the layer is found by one program and shaded by another
#endif

void main()
{
    vec4 position = uRelativeFromLocal * vec4(aPosition, 1.0);
    vPosition = position.xyz;
    vNormal = surface_unit(uNormalFromLocal * aNormal);
#ifdef TANGENTS
    vTangent = vec4(surface_unit(mat3(uRelativeFromLocal) * aTangent.xyz), aTangent.w);
#endif
#ifdef UV0
    vUv0 = aUv0;
#endif
#ifdef UV1
    vUv1 = aUv1;
#endif
#ifdef VERTEX_COLORS
    vColor = aColor;
#endif
    gl_Position = uClipFromRelative * position;
}
