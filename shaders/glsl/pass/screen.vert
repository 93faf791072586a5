/// screen.vert - one triangle over the whole viewport, at the far plane, or one quad a tile of 64 x 64 pixels.
///
/// The depth test against the far plane (drawn where something nearer is stored) leaves the background out early.
uniform float uFarDepth;  // clip z of the far plane at w = 1
#ifdef TILES
layout(location = 0) in vec2 aTile;  // lower left corner, in tiles; one an instance
uniform vec2 uTileSize;              // of a tile, in clip units
#endif

void main()
{
    vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
#ifdef TILES
    gl_Position = vec4(min((aTile + corner) * uTileSize - 1.0, 1.0), uFarDepth, 1.0);
#else
    gl_Position = vec4(corner * 4.0 - 1.0, uFarDepth, 1.0);
#endif
}
