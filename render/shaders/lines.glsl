// Antialiased lines of constant width in pixels, hidden by what is nearer than they are.
uniform samplerBuffer lines;        // three texels a line: ends in pixels | view depth at the ends, width, unused | color
uniform isamplerBuffer lineLists;   // indices of lines, tile after tile

struct LinePoint {
    float cover;        // share of the pixel that the line covers
    float depth;        // view depth of the nearest point of the line
    vec2 at;            // where that point is, in pixels
};

LinePoint nearestOnLine(int line, vec2 at) {
    vec4 ends = texelFetch(lines, 3 * line);
    vec4 depths = texelFetch(lines, 3 * line + 1);
    vec2 along = ends.zw - ends.xy;
    float part = clamp(dot(at - ends.xy, along) / max(dot(along, along), 1.0e-12), 0.0, 1.0);
    LinePoint point;
    point.at = ends.xy + part * along;
    // 1/depth is linear on the picture in perspective, depth itself in parallel projection.
    float perspective = 1.0 / mix(1.0 / depths.x, 1.0 / depths.y, part);
    point.depth = right.w > 0.5 ? perspective : mix(depths.x, depths.y, part);
    // A line thinner than a pixel covers no more than its width.
    float width = depths.z;
    point.cover = clamp(0.5 * width + 0.5 - length(at - point.at), 0.0, min(width, 1.0));
    return point;
}

// Lines mostly run along faces of boxes and over the ground, where the depth of the pixel says nothing (the pixel is beside the
// line): follow the ray to the line's own point instead. A thousandth of the depth is closer than anything stands to a line.
bool hiddenByFlat(LinePoint point) {
    Ray ray = rayThrough(point.at);
    float limit = point.depth * 0.999;
    bool hidden = false;
#ifdef GROUND
    hidden = hitGround(ray) < limit;
#endif
#ifdef BOXES
    for (int box = 0; box < counts.x; ++box) {
        vec3 normal;
        hidden = hidden || hitBox(ray, texelFetch(boxes, 3 * box).xyz, texelFetch(boxes, 3 * box + 1).xyz, normal) < limit;
    }
#endif
    return hidden;
}
