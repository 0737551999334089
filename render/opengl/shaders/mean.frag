// The mean of a picture's samplings, encoded.
uniform sampler2D sums;  // linear colors and, in w, the number of samplings

out vec4 pixel;

#include "srgb.glsl"

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, place, 0);
    pixel = vec4(encode(sum.rgb / sum.w, place), 1.0);
}
