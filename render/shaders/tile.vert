// One point of 16 x 16 pixels per tile: a rectangle without the diagonal that two triangles would shade twice.
uniform isamplerBuffer tileTable;   // two texels a tile: x, y in tiles, begin and end of its spheres | field slot, begin, end of lines
uniform int firstTile;
uniform int targetWidth;             // pixels, a whole number of tiles
uniform int targetHeight;

flat out ivec4 tile;
flat out ivec4 tileExtra;
#if defined(PLAIN) && defined(GROUND)
flat out vec3 groundLit;
#endif

void main() {
    int row = firstTile + gl_VertexID;
    tile = texelFetch(tileTable, 2 * row);
    tileExtra = texelFetch(tileTable, 2 * row + 1);
    vec2 center = (vec2(tile.xy) + 0.5) * 16.0;
    // Row 0 of the target is the top row of the picture, so that reading back needs no flip.
    gl_Position = vec4(2.0 * center / vec2(targetWidth, targetHeight) - 1.0, 0.0, 1.0);
    gl_PointSize = 16.0;
#if defined(PLAIN) && defined(GROUND)
    Point point;
    point.normal = vec3(0.0, 1.0, 0.0);
    point.albedo = groundColor.xyz;
    point.particle = 0.0;
    groundLit = shade(point, vec3(0.0, 1.0, 0.0));
#endif
}
