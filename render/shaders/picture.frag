// One tile of the picture: a pixel shows one thing, shaded at its one sample, or at its middle where four samples agree.
uniform isamplerBuffer pixels;      // 256 a tile, row by row: what is seen, and what reaches it

flat in ivec4 tile;
out vec4 pixel;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    ivec2 within = place & 15;
    int inTile = within.y * 16 + within.x;
    int tilePlace = (place.y >> 4) * (rowLength >> 4) + (place.x >> 4);
    ivec2 fragment = texelFetch(pixels, tilePlace * 256 + inTile).xy;
    vec2 at = vec2(place) + 0.5 + frame.picture.zw;
#ifdef SURFACE
    Point point = pointOn(fragment.x, rayThrough(at));
    pixel = vec4(point.normal, point.depth);
#else
    vec3 color = colorOf(fragment.x, fragment.y, at);
#ifdef LINES
    color = underLines(color, 256 * tile.w + inTile);
#endif
#ifdef ENCODE
    pixel = vec4(encodeBytes(color), 1.0);
#else
    pixel = vec4(clamp(color, 0.0, 1.0), 1.0);
#endif
#endif
}
