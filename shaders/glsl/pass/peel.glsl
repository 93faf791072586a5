/// peel.glsl - the order of a pixel's blended fragments: by depth, and at one place in the order of the scene.
///
/// Keys are compared bit by bit, so that a fragment is itself again in every pass over the same triangles.
uniform usampler2D uLayer;   // key of the layer that is drawn, or was found last
uniform int uFirstTriangle;  // of the instance, among all of the scene

/// Greater is nearer in x; at one place, less is nearer in y.
uvec2 peel_key()
{
    uint depth = floatBitsToUint(gl_FragCoord.z);
#ifdef LINEAR_Z
    depth = ~depth;
#endif
    return uvec2(depth, uint(uFirstTriangle + gl_PrimitiveID));
}

uvec2 peel_layer() { return texelFetch(uLayer, ivec2(gl_FragCoord.xy), 0).xy; }

bool peel_in_front(uvec2 key, uvec2 layer) { return key.x > layer.x || (key.x == layer.x && key.y < layer.y); }
