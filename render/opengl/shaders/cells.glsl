// What the middles of the 2 x 2 pixels of a cell show of the metaballs, a layer for each pixel: view depth (0 without a
// surface), normal, color, sky visibility.
layout(location = 0) out uvec4 pixel0;
layout(location = 1) out uvec4 pixel1;
layout(location = 2) out uvec4 pixel2;
layout(location = 3) out uvec4 pixel3;

void writeCell(vec4 depth, uvec4 normal, uvec4 color, uvec4 visible) {
    uvec4 bits = floatBitsToUint(depth);
    pixel0 = uvec4(bits.x, normal.x, color.x, visible.x);
    pixel1 = uvec4(bits.y, normal.y, color.y, visible.y);
    pixel2 = uvec4(bits.z, normal.z, color.z, visible.z);
    pixel3 = uvec4(bits.w, normal.w, color.w, visible.w);
}
