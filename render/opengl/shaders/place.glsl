// The tile that a fragment belongs to, and its place in the target that it is drawn for: its own or, with MARKED, that
// of a fragment in a list.

#ifdef MARKED
uniform isamplerBuffer marked;  // places as column + row * width
// Columns of this target and of the marked one, columns of tiles, pixels along a side of a tile.
uniform vec4 markedGrid;

int tile;
ivec2 place;

void locate() {
    int entry = texelFetch(marked, int(gl_FragCoord.x) + int(gl_FragCoord.y) * int(markedGrid.x)).x;
    int width = int(markedGrid.y);
    place = ivec2(entry % width, entry / width);
    ivec2 at = place / int(markedGrid.w);
    tile = at.x + at.y * int(markedGrid.z);
}
#else
flat in int tile;

ivec2 place;

void locate() {
    place = ivec2(gl_FragCoord.xy);
}
#endif
