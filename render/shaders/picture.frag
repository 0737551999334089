// Tiles whose pixels were coloured one by one.
uniform isamplerBuffer pixels;      // 256 a tile, row by row: the square roots of red, green and blue, 21 bits each

flat in int tilesInRow;
out vec4 pixel;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    ivec2 tile = place >> 4;
    ivec2 within = place & 15;
    ivec2 bits = texelFetch(pixels, (tile.y * tilesInRow + tile.x) * 256 + within.y * 16 + within.x).xy;
    int green = ((bits.x >> 21) & 0x7ff) | ((bits.y & 0x3ff) << 11);
    vec3 root = vec3(bits.x & 0x1fffff, green, (bits.y >> 10) & 0x1fffff) * (1.0 / 2097151.0);
    pixel = vec4(encodeRoots(root), 1.0);
}
