// A point per square of tiles: a rectangle without the diagonal that two triangles would shade twice.
uniform isamplerBuffer tileTable;   // column and row of its first tile, tiles along its side, its place in `lines` over 256 or -1
uniform int firstTile;
uniform int targetHeight;

flat out ivec4 tile;
#if defined(PLAIN) && defined(GROUND)
flat out vec3 groundLit;
#endif

void main() {
    handOver();
    tile = texelFetch(tileTable, firstTile + gl_VertexID);
    vec2 center = (vec2(tile.xy) + 0.5 * float(tile.z)) * 16.0;
    // Row 0 of the target is the top row of the picture, so that reading back needs no flip.
    gl_Position = vec4(2.0 * center / vec2(targetWidth, targetHeight) - 1.0, 0.0, 1.0);
    gl_PointSize = 16.0 * float(tile.z);
#if defined(PLAIN) && defined(GROUND)
    Point point;
    point.normal = vec3(0.0, 1.0, 0.0);
    point.albedo = frame.groundColor.xyz;
    point.particle = 0.0;
    groundLit = shade(point, vec3(0.0, 1.0, 0.0));
#endif
}
