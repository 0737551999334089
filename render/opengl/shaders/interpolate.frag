// Interpolates the surface of the metaballs between coarse rays, for cells of 2 x 2 pixels of which the first has a
// coarse ray, as in render/cpu/metaballs/ray_interpolation.cpp. Cells with a pixel where the surface is not smooth are
// marked in the depth buffer by 1, and cast after that.
#include "frame.glsl"
#include "packing.glsl"
#include "cells.glsl"

#define MOST_APART sampleOffset.z
#define LEAST_FIELD sampleOffset.w

uniform usampler2DArray coarseRays;  // coarse.frag: a layer for each of four rays

struct CoarseRay {
    float depth;  // 0 without a hit
    vec3 normal;  // along the world's axes
    vec3 albedo;
    vec3 sky;     // sky visibility along the normal, against it and along the mirrored ray
    float maxField;
    Ray ray;
};

CoarseRay coarseRay(ivec2 index) {
    uvec4 words = texelFetch(coarseRays, ivec3(index >> 1, (index.x & 1) + 2 * (index.y & 1)), 0);
    CoarseRay found;
    found.depth = uintBitsToFloat(words.x);
    found.normal = unpackNormal(words.y);
    found.albedo = unpackColor(words.z);
    found.sky = unpackSky(words.w);
    found.maxField = found.depth > 0.0 ? metaballs.x : uintBitsToFloat(words.y);
    found.ray = worldRay(imagePoint(2.0 * vec2(index) + 0.5 + sampleOffset.xy));
    return found;
}

// Depth at which a ray meets the tangent plane of a hit.
float tangentDepth(Ray ray, CoarseRay side) {
    vec3 offset = side.ray.origin + side.ray.direction * side.depth - ray.origin;
    return dot(side.normal, offset) / dot(side.normal, ray.direction);
}

bool isFacing(Ray ray, CoarseRay side) {
    // Surfaces seen at a slant change too fast from one pixel to the next.
    const float kLeastFacing = 0.1;
    float toward = -dot(side.normal, ray.direction);
    return toward > 0.0 && toward * toward > kLeastFacing * kLeastFacing * dot(ray.direction, ray.direction);
}

// The depth between two hits; w.y is 1 where the surface is smooth between them, else 0.
vec2 depthBetween(Ray ray, CoarseRay a, CoarseRay b) {
    const float kLeastCosine = 0.9;  // of the angle between the normals: 26 degrees
    float fromA = tangentDepth(ray, a);
    float fromB = tangentDepth(ray, b);
    float sum = a.depth + b.depth;
#ifdef PERSPECTIVE
    float chord = 2.0 * a.depth * b.depth / sum;
#else
    float chord = 0.5 * sum;
#endif
    float tangents = 0.5 * (fromA + fromB);
    bool areHits = a.depth > 0.0 && b.depth > 0.0;
    bool isEven = abs(fromA - fromB) < MOST_APART && abs(tangents - chord) < MOST_APART;
    bool isStraight = dot(a.normal, b.normal) >= kLeastCosine;
    bool isSmooth = areHits && isEven && isStraight && isFacing(ray, a) && isFacing(ray, b);
    return vec2(0.5 * (chord + tangents), isSmooth ? 1.0 : 0.0);
}

// Whether a ray misses the surface by so much that it cannot lie beside it.
bool misses(CoarseRay ray) {
    return ray.depth == 0.0 && ray.maxField < LEAST_FIELD;
}

// Between rays, or in the middle of several: a depth, and whether the surface is smooth there.
vec2 betweenTwo(ivec2 cell, vec2 offset, CoarseRay a, CoarseRay b) {
    Ray ray = worldRay(imagePoint(2.0 * vec2(cell) + 0.5 + offset + sampleOffset.xy));
    return misses(a) && misses(b) ? vec2(0.0, 1.0) : depthBetween(ray, a, b);
}

void main() {
    loadFrame();
    ivec2 cell = ivec2(gl_FragCoord.xy);
    CoarseRay own = coarseRay(cell);
    CoarseRay beside = coarseRay(cell + ivec2(1, 0));
    CoarseRay below = coarseRay(cell + ivec2(0, 1));
    CoarseRay across = coarseRay(cell + ivec2(1, 1));
    vec2 besideDepth = betweenTwo(cell, vec2(1.0, 0.0), own, beside);
    vec2 belowDepth = betweenTwo(cell, vec2(0.0, 1.0), own, below);
    vec2 fallingDepth = betweenTwo(cell, vec2(1.0), own, across);
    vec2 risingDepth = betweenTwo(cell, vec2(1.0), beside, below);
    vec4 depth = vec4(own.depth, besideDepth.x, belowDepth.x, 0.5 * (fallingDepth.x + risingDepth.x));
    bool isSmooth = besideDepth.y * belowDepth.y * fallingDepth.y * risingDepth.y > 0.0;
    gl_FragDepth = isSmooth ? 0.0 : 1.0;

    // Means of the rays around each of the four pixels. Directions need not have unit length to be packed.
    vec3 n1 = own.normal + beside.normal;
    vec3 n2 = own.normal + below.normal;
    vec3 n3 = n1 + below.normal + across.normal;
    uvec4 normal = packNormal(vec4(own.normal.x, n1.x, n2.x, n3.x), vec4(own.normal.y, n1.y, n2.y, n3.y),
                              vec4(own.normal.z, n1.z, n2.z, n3.z));
    vec3 c1 = 0.5 * (own.albedo + beside.albedo);
    vec3 c2 = 0.5 * (own.albedo + below.albedo);
    vec3 c3 = 0.5 * c1 + 0.25 * (below.albedo + across.albedo);
    uvec4 color = packColor(vec4(own.albedo.x, c1.x, c2.x, c3.x), vec4(own.albedo.y, c1.y, c2.y, c3.y),
                            vec4(own.albedo.z, c1.z, c2.z, c3.z));
    vec3 s1 = 0.5 * (own.sky + beside.sky);
    vec3 s2 = 0.5 * (own.sky + below.sky);
    vec3 s3 = 0.5 * s1 + 0.25 * (below.sky + across.sky);
    uvec4 visible = packSky(vec4(own.sky.x, s1.x, s2.x, s3.x), vec4(own.sky.y, s1.y, s2.y, s3.y),
                            vec4(own.sky.z, s1.z, s2.z, s3.z));
    writeCell(depth, normal, color, visible);
}
