// What is written for a pixel: its color, encoded, or the sum of its linear colors over several samplings.
#include "srgb.glsl"

out vec4 pixel;

#ifdef SUM
uniform sampler2D sums;  // of the samplings before this one
#endif

// @param place  of the pixel in the picture
void writeColor(vec3 color, ivec2 place) {
#if defined(FIRST_SUM)
    pixel = vec4(clamp(color, 0.0, 1.0), 1.0);
#elif defined(SUM)
    pixel = vec4(clamp(color, 0.0, 1.0), 1.0) + texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
#else
    pixel = vec4(encode(color, place), 1.0);
#endif
}
