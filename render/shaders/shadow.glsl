// How much of the light reaches a point. Spheres and boxes are tested exactly, so there is neither grain nor acne; their edge
// is softened over one pixel's width. Metaballs are looked up in the depth map that the CPU cast from the light.
uniform isamplerBuffer lightLists;      // per cell of the light's grid: begin, end
uniform samplerBuffer lightSpheres;     // u, v, height towards the light, radius; the nearest to the light first
uniform samplerBuffer lightDepths;      // height of the metaballs' surface per texel of the depth map

float softened(float x) {
    float t = clamp(x + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Sum of what each sphere covers of a strip one pixel wide around the ray to the light. The sum (not the product) closes the
// seam between two spheres that touch.
// facing: points turned away from the light walk no list.
float coverOfSpheres(vec3 point, float width, bool facing) {
    vec2 at = vec2(dot(point, lightU.xyz), dot(point, lightV.xyz));
    float height = dot(point, toLight.xyz);
    ivec2 cell = ivec2(floor((at - lightGrid.xy) * lightGrid.z));
    bool inGrid = facing && all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, lightCells.xy));
    ivec2 list = inGrid ? texelFetch(lightLists, cell.y * lightCells.x + cell.x).xy : ivec2(0);
    float cover = 0.0;
    for (int k = list.x; k < list.y && cover < 1.0; ++k) {
        vec4 sphere = texelFetch(lightSpheres, k);
        // Front to back: nothing further on the list reaches above the point.
        if (sphere.z + sphere.w < height) break;
        vec2 off = at - sphere.xy;
        float square = dot(off, off);
        float top = sphere.z + sqrt(max(sphere.w * sphere.w - square, 0.0));
        // A point of this very sphere lies at `top`; one hundredth of a radius is far above the rounding and invisible.
        bool above = top > height + 0.01 * sphere.w;
#ifdef SOFT
        float most = soft.x * min(sphere.w, max(0.5 * (sphere.z - height), 0.0));
        float edge = max(most, clamp(width, 1.0e-4 * sphere.w, 0.2 * sphere.w));
        cover += above ? softened((sphere.w - sqrt(square)) / edge) : 0.0;
#else
        // The light's grid leaves a tenth of a radius for the softened edge.
        float edge = clamp(width, 1.0e-4 * sphere.w, 0.2 * sphere.w);
        cover += above ? clamp(0.5 + (sphere.w - sqrt(square)) / edge, 0.0, 1.0) : 0.0;
#endif
    }
    return cover;
}

// Seen from the light a box is a convex hexagon. For faces i (entered) and j (left) the gap between entry and exit,
// (b_j - p_j)/l_j - (a_i - p_i)/l_i, falls linearly with the distance to the hexagon's side; its gradient in p is e_i/l_i - e_j/l_j,
// of length sqrt(1/l_i^2 + 1/l_j^2). The least gap over that length is the signed distance to the outline.
float coverOfBox(vec3 point, vec3 minimum, vec3 maximum, float width) {
    vec3 slope = mix(vec3(1.0e-6), toLight.xyz, greaterThan(abs(toLight.xyz), vec3(1.0e-6)));
    vec3 inverse = 1.0 / slope;
    vec3 first = (minimum - point) * inverse;
    vec3 second = (maximum - point) * inverse;
    vec3 near = min(first, second);
    vec3 far = max(first, second);
    vec3 square = inverse * inverse;
    vec3 nextGap = (far.yzx - near) * inversesqrt(square + square.yzx);
    vec3 lastGap = (far.zxy - near) * inversesqrt(square + square.zxy);
    vec3 gap = min(nextGap, lastGap);
    float inside = min(gap.x, min(gap.y, gap.z));
    float exit = min(far.x, min(far.y, far.z));
    float tolerance = 1.0e-4 * length(maximum - minimum);
#ifdef SOFT
    width = max(width, soft.x * min(soft.y, 0.5 * exit));
    return exit > tolerance ? softened(inside / max(width, tolerance)) : 0.0;
#else
    return exit > tolerance ? clamp(0.5 + inside / max(width, tolerance), 0.0, 1.0) : 0.0;
#endif
}

float coverOfBoxes(vec3 point, float width) {
    float cover = 0.0;
    for (int box = 0; box < counts.x; ++box) {
        cover += coverOfBox(point, texelFetch(boxes, 3 * box).xyz, texelFetch(boxes, 3 * box + 1).xyz, width);
    }
    return cover;
}

// Weights of three texels around the place in the middle one, from -0.5 to 0.5 off its middle.
#ifdef SOFT
// A quadratic B-spline, three texels wide.
vec3 texelWeights(float off) {
    return vec3(0.5 * (0.5 - off) * (0.5 - off), 0.75 - off * off, 0.5 * (0.5 + off) * (0.5 + off));
}
#else
// A box two texels wide.
vec3 texelWeights(float off) { return vec3(0.25 - 0.5 * off, 0.5, 0.25 + 0.5 * off); }
#endif

// Nine texels at the exact place, weights that change continuously with the point.
float coverOfField(vec3 point, vec3 normal) {
    // Off the surface by as much as the filter reaches sideways, so that a slope does not shade itself.
    vec3 raised = point + normal * (1.5 * depthMap.w);
    vec2 at = (vec2(dot(raised, lightU.xyz), dot(raised, lightV.xyz)) - depthMap.xy) * depthMap.z;
    float height = dot(raised, toLight.xyz) + 0.5 * depthMap.w;
    vec2 corner = floor(at);
    ivec2 texel = ivec2(corner);
    bool inMap = all(greaterThanEqual(texel, ivec2(1))) && all(lessThan(texel, lightCells.zw - 1));
    texel = inMap ? texel : ivec2(1);
    vec3 across = texelWeights(at.x - corner.x - 0.5);
    vec3 along = texelWeights(at.y - corner.y - 0.5);
    float sum = 0.0;
    for (int row = 0; row < 3; ++row) {
        int start = (texel.y + row - 1) * lightCells.z + texel.x;
        vec3 heights = vec3(texelFetch(lightDepths, start - 1).x, texelFetch(lightDepths, start).x, texelFetch(lightDepths, start + 1).x);
        sum += along[row] * dot(across, mix(vec3(0.0), vec3(1.0), greaterThan(heights, vec3(height))));
    }
    return inMap ? sum : 0.0;
}

float visibility(Point point, bool facing) {
    float cover = 0.0;
#ifdef LIGHT_SPHERES
    cover += coverOfSpheres(point.position, point.pixelWidth, facing);
#endif
#ifdef LIGHT_BOXES
    cover += coverOfBoxes(point.position, point.pixelWidth);
#endif
#ifdef LIGHT_FIELD
    cover += coverOfField(point.position, point.normal);
#endif
    return max(0.0, 1.0 - cover);
}
