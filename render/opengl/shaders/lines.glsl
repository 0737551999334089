// Lines over a pixel: the share that they cover, hidden by what is nearer, as in render/cpu/raster/lines.cpp.

// A surface hides a line if its depth is less than this share of the line's depth.
const float kNearer = 0.999;

bool isFlat(int id) {
    return id < 0 || (id >= kHitMesh && id < kHitMetaballs);
}

// Share of the pixel's samples at which neither a sphere nor metaballs hide a line at this depth.
float shareInFront(SampleHits hits, float depth) {
    float shown = 0.0;
    for (int s = 0; s < SAMPLES; ++s)
#if SAMPLES == 1
        shown += isFlat(hits.id) || hits.depth >= depth * kNearer ? 1.0 : 0.0;
#else
        shown += isFlat(hits.id[s]) || hits.depth[s] >= depth * kNearer ? 1.0 : 0.0;
#endif
    return shown / float(SAMPLES);
}

// @return the lines' color times the share of the pixel that they cover, and in w that share
vec4 lineCoverage(SampleHits hits, vec2 pixel) {
    vec4 over = vec4(0.0);
    int end = numberOf(kLineBegins, tile + 1);
    for (int k = numberOf(kLineBegins, tile); k < end; ++k) {
        int line = 3 * numberOf(kLineItems, k);
        vec4 ends = texelOf(kLines, line);
        vec4 depths = texelOf(kLines, line + 1);  // at both ends; z: width of the line
        vec3 color = texelOf(kLines, line + 2).rgb;
        vec2 along = ends.zw - ends.xy;
        float t = clamp(dot(pixel - ends.xy, along) / max(dot(along, along), 1.0e-12), 0.0, 1.0);
        vec2 nearest = ends.xy + t * along;
#ifdef PERSPECTIVE
        float depth = 1.0 / mix(1.0 / depths.x, 1.0 / depths.y, t);
#else
        float depth = mix(depths.x, depths.y, t);
#endif
        // A line thinner than a pixel covers no more than its width.
        float coverage = clamp(0.5 * depths.z + 0.5 - distance(pixel, nearest), 0.0, min(depths.z, 1.0));
        vec2 at = imagePoint(nearest);
        float surfaceDepth = flatHits(at.x, at.y).depth;
#ifdef MESHES
        surfaceDepth = min(surfaceDepth, meshDepthAt(nearest));
#endif
        float share = surfaceDepth < depth * kNearer ? 0.0 : coverage * shareInFront(hits, depth);
        over = over * (1.0 - share) + share * vec4(color, 1.0);
    }
    return over;
}
