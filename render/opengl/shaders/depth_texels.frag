// Spreads the four depths of each texel of depth_map.frag over the depth texture that shadows are looked up in.
uniform sampler2D depths;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    gl_FragDepth = texelFetch(depths, at >> 1, 0)[(at.x & 1) + 2 * (at.y & 1)];
}
