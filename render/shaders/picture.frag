// Tiles whose pixels were coloured one by one.
uniform samplerBuffer pixels;       // 256 a tile, row by row: sRGB

flat in int tilesInRow;
out vec4 pixel;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    ivec2 tile = place >> 4;
    ivec2 within = place & 15;
    pixel = texelFetch(pixels, (tile.y * tilesInRow + tile.x) * 256 + within.y * 16 + within.x);
}
