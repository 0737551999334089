// A point per square of tiles: a rectangle without the diagonal that two triangles would shade twice.
uniform isamplerBuffer tileTable;   // column and row of its first tile, tiles along its side
uniform int firstTile;
uniform int targetWidth;            // pixels of the target, whole numbers of tiles
uniform int targetHeight;

void main() {
    frame = block;
    ivec4 square = texelFetch(tileTable, firstTile + gl_VertexID);
    vec2 center = (vec2(square.xy) + 0.5 * float(square.z)) * 16.0;
    // Row 0 of the target is the top row of the picture, so that reading back needs no flip.
    gl_Position = vec4(2.0 * center / vec2(targetWidth, targetHeight) - 1.0, 0.0, 1.0);
    gl_PointSize = 16.0 * float(square.z);
}
