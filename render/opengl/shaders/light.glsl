// How much of the light and of the sky reaches a point: sections 3 and 4 of shading_model.h, computed as in
// render/cpu/lighting/light_visibility.cpp.

// The transition across the edge of a shadow. @param x  distance inside the edge, in widths of the edge
float shadowEdge(float x) {
    float t = clamp(x + 0.5, 0.0, 1.0);
#ifdef SOFT
    return t * t * (3.0 - 2.0 * t);
#else
    return t;
#endif
}

#ifdef SPHERE_SHADOWS
// What the spheres of one cell of the light's grid cover of a strip around the ray to the light, as wide as a pixel or
// as the soft edge. They are listed from the light on, so that those after one that does not reach above the point do
// not either. Coverages are added, which closes the seam between two spheres that touch.
float sphereCoverage(vec3 at, float pixelWidth, bool isFacing) {
    ivec2 cell = ivec2(floor((at.xy - lightCells.xy) * lightCells.z));
    bool isInGrid = isFacing && all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, ivec2(lightCellCount.xy)));
    int index = isInGrid ? cell.y * int(lightCellCount.x) + cell.x : 0;
    int k = isInGrid ? numberOf(kCasterBegins, index) : 0;
    int end = isInGrid ? numberOf(kCasterBegins, index + 1) : 0;
    int first = placeOf(kCasters);
    float coverage = 0.0;
    for (; k < end && coverage < 1.0; ++k) {
        vec4 sphere = texelFetch(listedTexels, first + k);
        float radius = sphere.w;
        if (sphere.z + radius < at.z) break;
        vec2 off = at.xy - sphere.xy;
        float square = dot(off, off);
        float top = sphere.z + sqrt(max(radius * radius - square, 0.0));
        float edge = clamp(pixelWidth, 1.0e-4 * radius, 0.2 * radius);
#ifdef SOFT
        edge = max(edge, toLight.w * clamp(0.5 * (sphere.z - at.z), 0.0, radius));
#endif
        // A point on the sphere itself lies at `top`; the tolerance is far above the rounding.
        if (top > at.z + 0.01 * radius) coverage += shadowEdge((radius - sqrt(square)) / edge);
    }
    return coverage;
}
#endif

#ifdef BOX_SHADOWS
// The gap between entering one pair of faces and leaving another, as a distance from the outline that the two share.
float outlineGap(vec2 entered, vec2 left, float inverseA, float inverseB) {
    return (left.y - entered.x) / sqrt(inverseA * inverseA + inverseB * inverseB);
}

#ifdef BOX_CELLS
// The first entry and the end of the list of boxes whose shadows may fall on a point.
ivec2 boxList(vec2 at, float pixelWidth) {
    vec2 cell = clamp(floor((at - boxCells.xy) * boxCells.z), vec2(0.0), lightCellCount.zw - 1.0);
    bool isNarrow = pixelWidth <= boxCells.w;
    int list = int(isNarrow ? cell.y * lightCellCount.z + cell.x : lightCellCount.z * lightCellCount.w);
    return ivec2(numberOf(kBoxCasterBegins, list), numberOf(kBoxCasterBegins, list + 1));
}
#endif

// Coverage by boxes, of which those come first whose coverage is subtracted. Their outlines seen from the light are hexagons
// (box_shadows-inl.h derives the distance).
float boxCoverage(vec3 position, vec3 at, float pixelWidth, bool isFacing) {
#ifdef BOX_CELLS
    ivec2 list = boxList(at.xy, pixelWidth);
#else
    ivec2 list = ivec2(0, int(counts.z));
#endif
    int end = isFacing ? list.y : 0;
    int begin = placeOf(kBoxCasters);
    vec3 direction = mix(vec3(1.0e-6), toLight.xyz, greaterThan(abs(toLight.xyz), vec3(1.0e-6)));
    vec3 inverse = 1.0 / direction;
    float coverage = 0.0;
    for (int k = list.x; k < end && coverage < 1.0; ++k) {
        vec4 lowAndTop = texelFetch(listedTexels, begin + 2 * k);
#ifdef BOX_CELLS
        if (lowAndTop.w < at.z) continue;
#endif
        vec3 low = lowAndTop.xyz;
        vec4 highAndSign = texelFetch(listedTexels, begin + 2 * k + 1);
        vec3 high = highAndSign.xyz;
        vec3 first = (low - position) * inverse;
        vec3 second = (high - position) * inverse;
        vec3 near = min(first, second);
        vec3 far = max(first, second);
        vec2 x = vec2(near.x, far.x);
        vec2 y = vec2(near.y, far.y);
        vec2 z = vec2(near.z, far.z);
        float inside = outlineGap(x, y, inverse.x, inverse.y);
        inside = min(inside, outlineGap(y, z, inverse.y, inverse.z));
        inside = min(inside, outlineGap(z, x, inverse.z, inverse.x));
        inside = min(inside, outlineGap(x, z, inverse.x, inverse.z));
        inside = min(inside, outlineGap(y, x, inverse.y, inverse.x));
        inside = min(inside, outlineGap(z, y, inverse.z, inverse.y));
        float exit = min(far.x, min(far.y, far.z));
        float tolerance = 1.0e-4 * length(high - low);
        float width = pixelWidth;
#ifdef SOFT
        width = max(width, toLight.w * min(lightU.w, 0.5 * exit));
#endif
        if (exit > tolerance) coverage += highAndSign.w * shadowEdge(inside / max(width, tolerance));
    }
    return coverage;
}
#endif

#if defined(METABALL_SHADOWS) || defined(MESH_SHADOWS)
// Depth maps are 0 at the top of the metaballs or meshes, and 1 at their bottom and where there are none.
#ifdef METABALL_SHADOWS
uniform sampler2DShadow depthMap;
#endif
#ifdef MESH_SHADOWS
uniform sampler2DShadow meshDepthMap;
uniform vec4 meshMapGrid;  // as depthMapGrid
uniform vec4 meshMapSize;  // as depthMapSize; w: 0
#endif

// The weights of six heights in a row, half a texel apart, in pairs: a quadratic B-spline, three texels wide, around a
// point between the third and the fourth height. The sampler interpolates between the two of a pair.
// @param behind   distance of the point from the third height, in half texels
// @param weights  of the pairs
// @param parts    shares of the second height of each pair
void heightWeights(float behind, out vec3 weights, out vec3 parts) {
    float off = 0.5 * behind;
    vec3 first = vec3(0.25 * (0.5 - off) * (0.5 - off), 0.375 - 0.5 * off * off, 0.25 * (0.5 + off) * (0.5 + off));
    vec3 second = vec3(0.25 * (1.0 - off) * (1.0 - off), 0.375 - 0.5 * (0.5 - off) * (0.5 - off), 0.25 * off * off);
    weights = first + second;
    parts = second / max(weights, 1.0e-20);
}

// The share of heights above the point, which is raised off the surface by as much as the filter reaches sideways, so
// that a slope does not shade itself.
// @param grid, size  of the map, as depthMapGrid and depthMapSize
// @param lift        distance along the normal by which the point is raised
// @param above       distance toward the light by which it is raised then
float mapCoverage(sampler2DShadow map, vec4 grid, vec4 size, vec3 position, vec3 normal, float lift, float above) {
    vec3 raised = position + lift * normal;
    vec2 at = (vec2(dot(raised, lightU.xyz), dot(raised, lightV.xyz)) - grid.xy) / grid.z;
    float depth = min((grid.w - dot(raised, toLight.xyz) - above) * size.z, 1.0);
    vec2 fine = 2.0 * at - 0.5;
    vec2 corner = floor(fine);
    vec3 weightsU, weightsV, partsU, partsV;
    heightWeights(fine.x - corner.x, weightsU, partsU);
    heightWeights(fine.y - corner.y, weightsV, partsV);
    vec3 u = (corner.x + vec3(-1.5, 0.5, 2.5) + partsU) / (2.0 * size.x);
    vec3 v = (corner.y + vec3(-1.5, 0.5, 2.5) + partsV) / (2.0 * size.y);
    float coverage = 0.0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            coverage += weightsU[column] * weightsV[row] * textureLod(map, vec3(u[column], v[row], depth), 0.0);
    bool isInMap = all(greaterThanEqual(at, vec2(2.0))) && all(lessThan(at, size.xy - 2.0));
    return isInMap ? coverage : 0.0;
}
#endif

#if defined(METABALL_MEDIUM) || defined(TRANSPARENCY)
uniform vec4 metaballMedium;  // transparency, refractive index, 1 / attenuation distance (1/m)
#endif

#ifdef LIGHT_TINT
uniform samplerBuffer opticalDepths;  // of columns of metaballs along the light, row by row, for red, green and blue
uniform vec4 opticalGrid;             // middle of the first texel (m), 1 / side of a texel (1/m), columns
uniform vec4 opticalRows;             // rows

// The share of light of each color that the column of metaballs along the light lets through.
vec3 transmissionAt(vec3 position) {
    vec2 at = (vec2(dot(position, lightU.xyz), dot(position, lightV.xyz)) - opticalGrid.xy) * opticalGrid.z;
    ivec2 cell = ivec2(floor(at));
    vec2 part = at - floor(at);
    ivec2 size = ivec2(opticalGrid.w, opticalRows.x);
    if (any(lessThan(cell, ivec2(0))) || any(greaterThanEqual(cell, size - 1))) return vec3(1.0);
    int first = cell.y * size.x + cell.x;
    vec3 upper = mix(texelFetch(opticalDepths, first).rgb, texelFetch(opticalDepths, first + 1).rgb, part.x);
    first += size.x;
    vec3 lower = mix(texelFetch(opticalDepths, first).rgb, texelFetch(opticalDepths, first + 1).rgb, part.x);
    return exp2(-mix(upper, lower, part.y));
}
#endif

// The share of the light that reaches a point and, where metaballs let some of it through, its tint.
#ifdef LIGHT_TINT
float lightVisibility(vec3 position, vec3 normal, float depth, out vec3 tint) {
    tint = vec3(1.0);
#else
float lightVisibility(vec3 position, vec3 normal, float depth) {
#endif
    bool isFacing = dot(normal, toLight.xyz) > 0.0;
    float pixelWidth = pixelWidthAt(depth);
    float coverage = 0.0;
#if defined(SPHERE_SHADOWS) || defined(BOX_SHADOWS)
    vec3 at = vec3(dot(position, lightU.xyz), dot(position, lightV.xyz), dot(position, toLight.xyz));
#endif
#ifdef SPHERE_SHADOWS
    coverage += sphereCoverage(at, pixelWidth, isFacing);
#endif
#ifdef BOX_SHADOWS
    coverage += boxCoverage(position, at, pixelWidth, isFacing);
#endif
#ifdef METABALL_SHADOWS
    float byMetaballs = mapCoverage(depthMap, depthMapGrid, depthMapSize, position, normal, 1.5 * depthMapGrid.z,
                                    0.5 * depthMapGrid.z);
#ifndef LIGHT_TINT
    coverage += byMetaballs;
#endif
#endif
#ifdef MESH_SHADOWS
    // Above the surfaces of meshes that light does not reach, which alone are in their map, the point need not be
    // farther than a plane rises sideways.
    float cosine = dot(normal, toLight.xyz);
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    coverage += mapCoverage(meshDepthMap, meshMapGrid, meshMapSize, position, normal, 1.5 * meshMapGrid.z * sine, 0.0);
#endif
#ifdef LIGHT_TINT
    vec3 reaching = 1.0 - coverage - byMetaballs * (1.0 - metaballMedium.x * transmissionAt(position));
    float greatest = max(max(reaching.x, reaching.y), max(reaching.z, 0.0));
    tint = greatest > 0.0 ? max(reaching, 0.0) / greatest : vec3(0.0);
    return isFacing ? greatest : 0.0;
#else
    return isFacing ? max(1.0 - coverage, 0.0) : 0.0;
#endif
}

#ifdef GROUND_OCCLUSION
float groundSkyVisibility(vec3 position) {
    vec2 at = (position.xz - skyCells.xz) * skyCells.w;
    vec2 corner = floor(at);
    vec2 part = at - corner;
    ivec2 cell = ivec2(corner);
    bool isInMap = all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, ivec2(skyCellCount.xz) - 1));
    int first = isInMap ? cell.y * int(skyCellCount.x) + cell.x : 0;
    float upper = mix(texelFetch(groundSky, first).x, texelFetch(groundSky, first + 1).x, part.x);
    int below = first + int(skyCellCount.x);
    float lower = mix(texelFetch(groundSky, below).x, texelFetch(groundSky, below + 1).x, part.x);
    return isInMap ? mix(upper, lower, part.y) : 1.0;
}
#endif

// skyVisibility(d) of shading_model.h from the values along the axes.
float skyVisibilityToward(vec3 direction, vec3 plus, vec3 minus) {
    return dot(direction * direction, mix(minus, plus, greaterThan(direction, vec3(0.0))));
}

#ifdef OBSTACLE_OCCLUSION
// Sky visibility toward one of the six sides of a cube, interpolated in the grid.
float skyVisibilityInGrid(int side, vec3 at) {
    vec3 ahead = vec3(0.0);
    ahead[side >> 1] = (side & 1) == 0 ? SKY_SAMPLE_OFFSET : -SKY_SAMPLE_OFFSET;
    vec3 point = at + ahead;
    vec3 corner = floor(point);
    vec3 part = point - corner;
    ivec3 cell = ivec3(corner);
    bool isInGrid = all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(skyCellCount.xyz) - 1));
    int row = int(skyCellCount.x);
    int slice = row * int(skyCellCount.y);
    int first = isInGrid ? side * slice * int(skyCellCount.z) + cell.x + row * cell.y + slice * cell.z : 0;
    vec4 low = vec4(texelFetch(skyGrid, first).x, texelFetch(skyGrid, first + row).x,
                    texelFetch(skyGrid, first + slice).x, texelFetch(skyGrid, first + slice + row).x);
    vec4 high = vec4(texelFetch(skyGrid, first + 1).x, texelFetch(skyGrid, first + row + 1).x,
                     texelFetch(skyGrid, first + slice + 1).x, texelFetch(skyGrid, first + slice + row + 1).x);
    vec4 alongX = mix(low, high, part.x);
    vec2 alongY = mix(alongX.xz, alongX.yw, part.y);
    return isInGrid ? mix(alongY.x, alongY.y, part.z) : 1.0;
}

float obstacleSkyVisibility(vec3 position, vec3 normal) {
    vec3 at = (position - skyCells.xyz) * skyCells.w;
    vec3 toward;
    for (int axis = 0; axis < 3; ++axis)
        toward[axis] = skyVisibilityInGrid(2 * axis + (normal[axis] > 0.0 ? 0 : 1), at);
    return dot(normal * normal, toward);
}
#endif
