// The share of a pixel that a face of a box shows where the face's outline crosses the pixel, as in
// render/cpu/raster/box_outlines.cpp.

// The share of a pixel on the positive side of a line. @param at  value in the middle of the pixel of a function that is
// linear over the picture and 0 on the line. @param slope  its absolute changes from pixel to pixel
float halfPlaneShare(float at, vec2 slope) {
    float total = max(slope.x + slope.y, 1.0e-30);
    float inside = clamp(at / total, -0.5, 0.5);
    float larger = max(slope.x, slope.y) / total;
    float lesser = min(slope.x, slope.y) / total;
    float rest = 0.5 - abs(inside);
    float share = rest >= lesser ? 0.5 + abs(inside) / max(larger, 0.5)
                                 : 1.0 - rest * rest / max(2.0 * larger * lesser, 1.0e-30);
    return inside >= 0.0 ? share : 1.0 - share;
}

// The sine of the angle between a ray through a point of the picture and an edge, times lengths; its sign says on which
// side the ray passes. @param edge  its length and direction
float rayPastEdge(vec2 pixel, vec3 corner, vec3 edge) {
    Ray ray = worldRay(imagePoint(pixel));
    return dot(cross(corner - ray.origin, edge), ray.direction);
}

// The share of a pixel that a face covers. @param id  hit id of the face, less kHitBox
float faceShare(int id, vec2 middle) {
    vec3 low = texelOf(kBoxes, 3 * (id >> 4)).xyz;
    vec3 size = texelOf(kBoxes, 3 * (id >> 4) + 1).xyz - low;
    int axis = (id & 7) >> 1;
    vec3 sideways = axis == 0 ? vec3(0.0, size.y, 0.0) : axis == 1 ? vec3(0.0, 0.0, size.z) : vec3(size.x, 0.0, 0.0);
    vec3 along = axis == 0 ? vec3(0.0, 0.0, size.z) : axis == 1 ? vec3(size.x, 0.0, 0.0) : vec3(0.0, size.y, 0.0);
    if ((id & 1) == 0) low[axis] += size[axis];
    vec3 corner = low;
    vec3 center = low + 0.5 * (sideways + along);
    float share = 1.0;
    for (int k = 0; k < 4; ++k) {
        vec3 edge = k == 0 ? sideways : k == 1 ? along : k == 2 ? -sideways : -along;
#ifdef PERSPECTIVE
        float ofCenter = dot(cross(corner, edge), center);
#else
        float ofCenter = dot(cross(corner - center, edge), forward.xyz);
#endif
        float at = rayPastEdge(middle, corner, edge);
        vec2 slope = vec2(rayPastEdge(middle + vec2(1.0, 0.0), corner, edge) - at,
                          rayPastEdge(middle + vec2(0.0, 1.0), corner, edge) - at);
        share *= halfPlaneShare(ofCenter < 0.0 ? -at : at, abs(slope));
        corner += edge;
    }
    return share;
}

// The shares of the samples in the color of their pixel: a quarter each, but where samples hit two things, of which one
// is a face of a box whose outline crosses the pixel, its samples together have the share that the face covers.
vec4 sampleShares(ivec4 ids, vec2 middle) {
    vec4 isFirst = vec4(equal(ids, ivec4(ids.x)));
    int other = isFirst.y == 0.0 ? ids.y : isFirst.z == 0.0 ? ids.z : ids.w;
    vec4 isOther = vec4(equal(ids, ivec4(other)));
    if (other == ids.x || dot(isFirst + isOther, vec4(1.0)) != 4.0) return vec4(0.25);
    for (int k = 0; k < 2; ++k) {
        int id = (k == 0 ? ids.x : other) - kHitBox;
        if (id < 0 || id >= kHitMetaballs - kHitBox || (id & 8) != 0) continue;
        vec4 isFace = k == 0 ? isFirst : isOther;
        float count = dot(isFace, vec4(1.0));
        float share = faceShare(id, middle);
        if (share > 0.0 && share < 1.0 && abs(share - 0.25 * count) <= 0.25)
            return isFace * (share / count) + (1.0 - isFace) * ((1.0 - share) / (4.0 - count));
    }
    return vec4(0.25);
}
