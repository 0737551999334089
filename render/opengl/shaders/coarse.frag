// Casts the rays through every second pixel of every second row, four by four. Other pixels are interpolated between
// them where the surface is smooth.
#include "frame.glsl"
#include "packing.glsl"
#include "cast.glsl"
#include "hit_surface.glsl"

flat in int tile;

// Of each ray: view depth (0 without a hit), normal, color, sky visibility. Without a hit, the greatest sample of the
// field stands in place of the normal.
layout(location = 0) out uvec4 ray0;
layout(location = 1) out uvec4 ray1;
layout(location = 2) out uvec4 ray2;
layout(location = 3) out uvec4 ray3;

void main() {
    loadFrame();
    vec2 corner = 4.0 * floor(gl_FragCoord.xy) + 0.5 + sampleOffset.xy;
    vec4 x = ((corner.x + vec4(0.0, 2.0, 0.0, 2.0)) * image.x - 1.0) * image.z + imageMiddle().x;
    vec4 y = (1.0 - (corner.y + vec4(0.0, 0.0, 2.0, 2.0)) * image.y) * image.w + imageMiddle().y;
    FourRays rays = fourRays(x, y);
    castRays(tile, nearestBall(tile), kFarDepth, rays);
    FourHits hits = surfaceAt(tile, rays);
    uvec4 depth = floatBitsToUint(hits.depth);
    uvec4 normal = packNormal(hits.normalX, hits.normalY, hits.normalZ);
    uvec4 field = floatBitsToUint(rays.maxField);
    uvec4 color = packColor(hits.red, hits.green, hits.blue);
    uvec4 sky = packSky(hits.skyAlong, hits.skyAgainst, hits.skyMirrored);
    ray0 = uvec4(depth.x, hits.depth.x > 0.0 ? normal.x : field.x, color.x, sky.x);
    ray1 = uvec4(depth.y, hits.depth.y > 0.0 ? normal.y : field.y, color.y, sky.y);
    ray2 = uvec4(depth.z, hits.depth.z > 0.0 ? normal.z : field.z, color.z, sky.z);
    ray3 = uvec4(depth.w, hits.depth.w > 0.0 ? normal.w : field.w, color.w, sky.w);
}
