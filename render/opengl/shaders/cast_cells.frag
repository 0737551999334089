// Casts a ray through the middle of each pixel of a cell: with CASTS_ALL of every cell, else of those that are marked
// because the surface of the metaballs is not smooth there.
#include "frame.glsl"
#include "packing.glsl"
#include "cast.glsl"
#include "hit_surface.glsl"
#include "cells.glsl"
#include "place.glsl"

#ifdef CASTS_ALL
#define REFINEMENTS 3

float searchBegin(ivec2 cell) {
    return 0.0;
}
#else
#define REFINEMENTS 2
uniform usampler2DArray coarseRays;

// Where the rays of a cell begin to be searched for the surface: a radius before the nearest hit of the coarse rays
// around it, or at the eye where there are none or a small ball fits between them.
float searchBegin(ivec2 cell) {
    float nearest = kFarDepth;
    for (int k = 0; k < 4; ++k) {
        ivec2 corner = cell + ivec2(k & 1, k >> 1);
        float depth =
            uintBitsToFloat(texelFetch(coarseRays, ivec3(corner >> 1, (corner.x & 1) + 2 * (corner.y & 1)), 0).x);
        nearest = depth > 0.0 ? min(nearest, depth) : nearest;
    }
    // Half the diagonal between four coarse rays, two pixels apart, is 1.42 pixels.
    bool isFine = nearest < kFarDepth && smallestRadius > 1.5 * pixelWidthAt(nearest);
    return isFine ? max(nearest - smallestRadius, 0.0) : 0.0;
}
#endif

void main() {
    loadFrame();
    locate();
    ivec2 cell = place;
    vec2 corner = 2.0 * vec2(cell) + 0.5 + sampleOffset.xy;
    vec4 x = ((corner.x + vec4(0.0, 1.0, 0.0, 1.0)) * image.x - 1.0) * image.z + imageMiddle().x;
    vec4 y = (1.0 - (corner.y + vec4(0.0, 0.0, 1.0, 1.0)) * image.y) * image.w + imageMiddle().y;
    FourRays rays = fourRays(x, y);
    castRays(tile, max(searchBegin(cell), nearestBall(tile)), kFarDepth, rays);
    refineHits(tile, REFINEMENTS, rays);
    FourHits hits = surfaceAt(tile, rays);
    writeCell(hits.depth, packNormal(hits.normalX, hits.normalY, hits.normalZ),
              packColor(hits.red, hits.green, hits.blue), packSky(hits.skyAlong, hits.skyAgainst, hits.skyMirrored));
}
