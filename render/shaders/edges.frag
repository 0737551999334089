// Pixels that show several things, side by side: each thing is shaded once, at the middle of the samples that show it.
uniform isamplerBuffer edgePixels;      // column + 65536 row, first of its fragments, how many, place in `lines` or -1
uniform isamplerBuffer fragments;       // what is seen, what reaches it and which samples show it

flat in int placeCount;
out vec4 pixel;

const vec4 kSampleX = vec4(-0.125, 0.375, -0.375, 0.125);
const vec4 kSampleY = vec4(-0.375, -0.125, 0.125, 0.375);

void main() {
    int place = int(gl_FragCoord.y) * rowLength + int(gl_FragCoord.x);
    // The last row is not full.
    if (place >= placeCount) discard;
    ivec4 edge = texelFetch(edgePixels, place);
    vec2 middle = vec2(edge.x & 0xffff, edge.x >> 16) + 0.5;
    vec3 color = vec3(0.0);
    for (int k = edge.y; k < edge.y + edge.z; ++k) {
        ivec2 fragment = texelFetch(fragments, k).xy;
        vec4 taken = vec4(fragment.y & 1, (fragment.y >> 1) & 1, (fragment.y >> 2) & 1, (fragment.y >> 3) & 1);
        float count = taken.x + taken.y + taken.z + taken.w;
        color += count * colorOf(fragment.x, fragment.y, middle + vec2(dot(taken, kSampleX), dot(taken, kSampleY)) / count);
    }
    color *= 0.25;
#ifdef LINES
    color = edge.w >= 0 ? underLines(color, max(edge.w, 0)) : color;
#endif
    pixel = vec4(encodeBytes(color), 1.0);
}
