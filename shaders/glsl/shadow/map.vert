/// map.vert - vertices of what casts shadows, relative to the origin of a shadow map.
layout(location = 0) in vec3 aPosition;
#ifdef UV0
layout(location = 3) in vec2 aUv0;
out vec2 vUv0;
#endif
#ifdef UV1
layout(location = 4) in vec2 aUv1;
out vec2 vUv1;
#endif
#ifdef VERTEX_COLORS
layout(location = 5) in vec4 aColor;
out vec4 vColor;
#endif

uniform mat4 uRelativeFromLocal;
uniform mat4 uClipFromRelative;

void main()
{
#ifdef UV0
    vUv0 = aUv0;
#endif
#ifdef UV1
    vUv1 = aUv1;
#endif
#ifdef VERTEX_COLORS
    vColor = aColor;
#endif
    gl_Position = uClipFromRelative * (uRelativeFromLocal * vec4(aPosition, 1.0));
}
