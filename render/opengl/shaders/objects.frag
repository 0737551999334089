// Tiles that show objects: finds what each sample of a pixel hits, and colors each thing that the samples hit once, at
// the mean position of its samples. With MARKED, metaballs are cast through each of four samples; else all samples have
// the metaballs of the pixel's middle.
#include "frame.glsl"
#include "place.glsl"
#include "lists.glsl"

uniform usamplerBuffer sphereAttributes; // color, sky visibility along +x +y +z, along -x -y -z, packed
uniform samplerBuffer groundSky;
uniform samplerBuffer skyGrid;

#include "lanes.glsl"

#if SAMPLES == 1
#define REAL float
#define INTEGER int
#define BOOLEAN bool
#else
#define REAL vec4
#define INTEGER ivec4
#define BOOLEAN bvec4
#endif
#define HITS SampleHits
#define SAMPLE_HITS
#include "hits.glsl"

#if SAMPLES != 1
// Offsets of the samples from the middle of the pixel: kFourSamples of camera_frame.h.
const vec4 kOffsetX = vec4(-0.125, 0.375, -0.375, 0.125);
const vec4 kOffsetY = vec4(-0.375, -0.125, 0.125, 0.375);
#endif

#include "packing.glsl"
#include "light.glsl"
#ifdef GLOW_LIGHT
#include "glow_light.glsl"
#endif
#include "shading.glsl"
#ifdef METABALLS
#ifdef MARKED
#include "cast.glsl"
#include "hit_surface.glsl"
#else
#define smallestRadius metaballs.z
#endif
#include "surface.glsl"
#endif
#ifdef MESHES
#include "meshes.glsl"
#endif
#include "points.glsl"
#include "output.glsl"

#ifdef METABALLS
REAL hitDepth(vec4 depth) {
#if SAMPLES == 1
    return depth.x > 0.0 ? depth.x : kFarDepth;
#else
    return mix(vec4(kFarDepth), depth, greaterThan(depth, vec4(0.0)));
#endif
}

#ifdef MARKED
// @param x, y  of the samples' rays on the image plane
void addMetaballs(inout SampleHits hits, REAL x, REAL y) {
    FourRays rays = fourRays(vec4(x), vec4(y));
    vec2 range = searchRange(place);
    castRays(tile, range.x, range.y, rays);
    samples = surfaceAt(tile, rays);
    addHit(hits, hitDepth(samples.depth), kHitMetaballs + surfacesOfSamples());
}
#else
void addMetaballs(inout SampleHits hits, REAL x, REAL y) {
    pixelSurface = surfaceInMiddle(place);
    addHit(hits, hitDepth(vec4(pixelSurface.depth)), INTEGER(kHitMetaballs));
}
#endif
#endif

#if SAMPLES == 1
SampleHits hitsOf(vec2 middle) {
    vec2 at = imagePoint(middle + sampleOffset.xy);
    SampleHits hits = flatHits(at.x, at.y);
#ifdef MESHES
    addMeshes(hits);
#endif
#ifdef METABALLS
    addMetaballs(hits, at.x, at.y);
#endif
#ifdef SPHERES
    addSpheres(hits, at.x, at.y);
#endif
    return hits;
}

vec3 colorOfSamples(SampleHits hits, vec2 middle) {
    return clamp(colorOf(hits.id, middle + sampleOffset.xy), 0.0, 1.0);
}
#else
SampleHits hitsOf(vec2 middle) {
    vec4 x = ((middle.x + kOffsetX) * image.x - 1.0) * image.z + imageMiddle().x;
    vec4 y = (1.0 - (middle.y + kOffsetY) * image.y) * image.w + imageMiddle().y;
    SampleHits hits = flatHits(x, y);
#ifdef MESHES
    addMeshes(hits);
#endif
#ifdef METABALLS
    addMetaballs(hits, x, y);
#endif
#ifdef SPHERES
    addSpheres(hits, x, y);
#endif
    return hits;
}

#ifdef BOXES
#include "box_outlines.glsl"
#endif

vec3 colorOfSamples(SampleHits hits, vec2 middle) {
#ifdef BOXES
    vec4 shares = sampleShares(hits.id, middle);
#else
    vec4 shares = vec4(0.25);
#endif
    vec3 sum = vec3(0.0);
    vec4 left = vec4(1.0);  // 1 for each sample that has no color yet
    do {
        int id = left.x > 0.0 ? hits.id.x : left.y > 0.0 ? hits.id.y : left.z > 0.0 ? hits.id.z : hits.id.w;
        vec4 same = left * vec4(equal(hits.id, ivec4(id)));
        float count = dot(same, vec4(1.0));
        vec2 offset = vec2(dot(same, kOffsetX), dot(same, kOffsetY)) / count;
        sum += dot(same, shares) * clamp(colorOf(id, middle + offset), 0.0, 1.0);
        left -= same;
    } while (dot(left, vec4(1.0)) > 0.0);
    return sum;
}
#endif

#ifdef LINES
#if SAMPLES != 1
#undef REAL
#undef INTEGER
#undef BOOLEAN
#undef HITS
#undef SAMPLE_HITS
#define REAL float
#define INTEGER int
#define BOOLEAN bool
#define HITS RayHits
#include "hits.glsl"
#endif
#include "lines.glsl"
#endif

#ifdef VISIBLE_POINTS
// Writes the normal and the view depth of the point that the ray through the middle of the pixel shows.
void main() {
    loadFrame();
    locate();
    vec2 middle = vec2(place) + 0.5;
    SampleHits hits = hitsOf(middle);
    Point at = pointOf(hits.id, worldRay(imagePoint(middle)));
    pixel = vec4(at.normal, hits.id == kHitBackground ? -1.0 : at.depth);
}
#else
void main() {
    loadFrame();
    locate();
    vec2 middle = vec2(place) + 0.5;
    SampleHits hits = hitsOf(middle);
    vec3 color = colorOfSamples(hits, middle);
#ifdef LINES
    vec4 over = lineCoverage(hits, middle + sampleOffset.xy);
    color = min(color * (1.0 - over.w) + over.rgb, 1.0);
#endif
    writeColor(color, place);
#if defined(METABALLS) && SAMPLES == 4 && !defined(MARKED)
    // Pixels that a silhouette crosses are marked by alpha 0, to be drawn again.
    if (isAtSilhouette(place, pixelSurface.depth)) pixel.a = 0.0;
#endif
}
#endif
