// A point for each tile of the picture that the pass draws, as large as the tile in the target.
#include "frame_block.glsl"

uniform isamplerBuffer tiles;  // indices of the tiles
uniform vec2 tilesInTarget;    // size of the target, in tiles

flat out int tile;
#ifdef MANY_VARYINGS
#define FLAT_FIELD(name) flat out vec4 name;
FRAME_FIELDS(FLAT_FIELD)
#endif

void main() {
#ifdef MANY_VARYINGS
#define HAND_OVER(name) name = frame.name;
    FRAME_FIELDS(HAND_OVER)
#endif
    tile = texelFetch(tiles, gl_VertexID).x;
    int columns = int(tilesInTarget.x);
    vec2 middle = (vec2(tile % columns, tile / columns) + 0.5) / tilesInTarget;
    gl_Position = vec4(2.0 * middle - 1.0, 0.0, 1.0);
    gl_PointSize = float(POINT_SIZE);
}
