// Tiles that show nothing but the background or nothing but ground.
#include "frame.glsl"
#include "lists.glsl"

uniform samplerBuffer groundSky;

#include "packing.glsl"
#include "light.glsl"
#ifdef GLOW_LIGHT
#include "glow_light.glsl"
#endif
#include "shading.glsl"
#include "points.glsl"
#include "output.glsl"

void main() {
    loadFrame();
    vec2 at = gl_FragCoord.xy + sampleOffset.xy;
#ifdef GROUND
    vec3 color = colorOf(kHitGround, at);
#else
    vec3 color = background(at.y);
#endif
    writeColor(color, ivec2(gl_FragCoord.xy));
}
