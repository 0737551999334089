// The surface of the metaballs that a pixel shows: what the passes before found in the middle of the pixel or, where a
// silhouette crosses it, a ray of its own for each of its samples.

uniform usampler2DArray pixelHits;  // cells.glsl: of each cell of 2 x 2 pixels, a layer for each pixel

struct Surface {
    float depth;  // view depth; 0 without a surface
    vec3 normal;  // along the world's axes
    vec3 albedo;
    vec3 sky;     // sky visibility along the normal, against it and along the mirrored ray
};

uvec4 hitWords(ivec2 pixel) {
    return texelFetch(pixelHits, ivec3(pixel >> 1, (pixel.x & 1) + 2 * (pixel.y & 1)), 0);
}

float hitDepthAt(ivec2 pixel) {
    return uintBitsToFloat(hitWords(pixel).x);
}

// The depths of the four pixels beside one.
vec4 depthsAround(ivec2 pixel) {
    ivec2 last = ivec2(round(2.0 / image.xy)) - 1;
    return vec4(hitDepthAt(max(pixel - ivec2(1, 0), 0)), hitDepthAt(min(pixel + ivec2(1, 0), last)),
                hitDepthAt(max(pixel - ivec2(0, 1), 0)), hitDepthAt(min(pixel + ivec2(0, 1), last)));
}

// Depths that differ by less belong to one surface.
float sameSurface() {
    return 0.5 * smallestRadius;
}

#ifdef MARKED
FourHits samples;  // what the pixel's samples meet

// Which samples show the surface of one of them: 1, else 0.
vec4 samplesWith(int index) {
    vec4 depth = samples.depth;
    return vec4(lessThan(abs(depth - depth[index]), vec4(sameSurface()))) * vec4(greaterThan(depth, vec4(0.0)));
}

// The hit of each sample as the index of the first sample that shows the same surface.
ivec4 surfacesOfSamples() {
    vec4 depth = samples.depth;
    float least = sameSurface();
    int second = abs(depth.y - depth.x) < least ? 0 : 1;
    int third = abs(depth.z - depth.x) < least ? 0 : abs(depth.z - depth.y) < least ? second : 2;
    int fourth = abs(depth.w - depth.x) < least   ? 0
                 : abs(depth.w - depth.y) < least ? second
                 : abs(depth.w - depth.z) < least ? third
                                                  : 3;
    return ivec4(0, second, third, fourth);
}

// The mean of the samples that show the same surface.
Surface surfaceOf(int index) {
    vec4 weights = samplesWith(index);
    weights /= dot(weights, vec4(1.0));
    vec3 normal = vec3(dot(samples.normalX, weights), dot(samples.normalY, weights), dot(samples.normalZ, weights));
    return Surface(dot(samples.depth, weights), normalize(normal),
                   vec3(dot(samples.red, weights), dot(samples.green, weights), dot(samples.blue, weights)),
                   vec3(dot(samples.skyAlong, weights), dot(samples.skyAgainst, weights),
                        dot(samples.skyMirrored, weights)));
}

// The depths between which the rays of the samples are searched for the surface: from a radius before the nearest hit
// of the pixel and of those beside it. Where one of these shows no surface, to two radii behind the farthest: the
// samples are to see no more than the pixels around them.
vec2 searchRange(ivec2 pixel) {
    float own = hitDepthAt(pixel);
    vec4 around = depthsAround(pixel);
    vec4 hits = mix(vec4(kFarDepth), around, greaterThan(around, vec4(0.0)));
    float nearest = min(own > 0.0 ? own : kFarDepth, leastOf(hits));
    float farthest = max(own, greatestOf(around));
    bool isOpen = own == 0.0 || leastOf(around) == 0.0;
    return vec2(max(nearest - smallestRadius, 0.0), isOpen ? farthest + 2.0 * smallestRadius : kFarDepth);
}
#else
Surface pixelSurface;  // what all samples of the pixel show

Surface surfaceOf(int index) {
    return pixelSurface;
}

// The surface in the middle of a pixel.
Surface surfaceInMiddle(ivec2 pixel) {
    uvec4 words = hitWords(pixel);
    return Surface(uintBitsToFloat(words.x), unpackNormal(words.y), unpackColor(words.z), unpackSky(words.w));
}

// Whether a silhouette runs between a pixel and one beside it.
bool isAtSilhouette(ivec2 pixel, float depth) {
    vec4 around = depthsAround(pixel);
    vec4 isOther = abs(vec4(greaterThan(around, vec4(0.0))) - (depth > 0.0 ? 1.0 : 0.0));
    vec4 isApart = vec4(greaterThan(abs(around - depth), vec4(sameSurface())));
    return dot(isOther + isApart, vec4(1.0)) > 0.0;
}
#endif
