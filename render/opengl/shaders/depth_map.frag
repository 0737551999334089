// Casts the rays of the metaballs' depth map from the light: four for each texel, a quarter of a texel from its sides.
#include "frame.glsl"
#include "packing.glsl"
#include "cast.glsl"

flat in int tile;

uniform vec4 lightImage;  // 2 / width, 2 / height, half the width and half the height of the light's picture (m)

out vec4 depths;  // below the map's top, over the map's height

void main() {
    loadFrame();
    vec2 corner = 2.0 * floor(gl_FragCoord.xy) + 0.5;
    vec4 x = ((corner.x + vec4(0.0, 1.0, 0.0, 1.0)) * lightImage.x - 1.0) * lightImage.z;
    vec4 y = (1.0 - (corner.y + vec4(0.0, 0.0, 1.0, 1.0)) * lightImage.y) * lightImage.w;
    FourRays rays = fourRays(x, y);
    castRays(tile, nearestBall(tile), kFarDepth, rays);
    depths = mix(vec4(1.0), rays.found * depthMapSize.z, greaterThan(rays.found, vec4(0.0)));
}
