// How much of the light reaches a point. Spheres and boxes are tested exactly, so there is neither grain nor acne; their edge
// is softened over one pixel's width. Metaballs are looked up in the depth map that the CPU cast from the light.
uniform isamplerBuffer lightLists;      // per cell of the light's grid: begin, end
uniform samplerBuffer lightSpheres;     // u, v, height towards the light, radius; the nearest to the light first
uniform samplerBuffer lightDepths;      // height of the metaballs' surface per texel of the depth map

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
        // The light's grid leaves a tenth of a radius for the softened edge.
        float soft = clamp(width, 1.0e-4 * sphere.w, 0.2 * sphere.w);
        cover += above ? clamp(0.5 + (sphere.w - sqrt(square)) / soft, 0.0, 1.0) : 0.0;
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
    return exit > tolerance ? clamp(0.5 + inside / max(width, tolerance), 0.0, 1.0) : 0.0;
}

float coverOfBoxes(vec3 point, float width) {
    float cover = 0.0;
    for (int box = 0; box < counts.x; ++box) {
        cover += coverOfBox(point, texelFetch(boxes, 3 * box).xyz, texelFetch(boxes, 3 * box + 1).xyz, width);
    }
    return cover;
}

// Box filter two texels wide at the exact place: nine texels, weights that change continuously with the point.
float coverOfField(vec3 point, vec3 normal) {
    // Off the surface by as much as the filter reaches sideways, so that a slope does not shade itself.
    vec3 raised = point + normal * (1.5 * depthMap.w);
    vec2 at = (vec2(dot(raised, lightU.xyz), dot(raised, lightV.xyz)) - depthMap.xy) * depthMap.z;
    float height = dot(raised, toLight.xyz) + 0.5 * depthMap.w;
    vec2 corner = floor(at);
    vec2 part = at - corner;
    ivec2 texel = ivec2(corner);
    bool inMap = all(greaterThanEqual(texel, ivec2(1))) && all(lessThan(texel, lightCells.zw - 1));
    texel = inMap ? texel : ivec2(1);
    float sum = 0.0;
    for (int row = -1; row <= 1; ++row) {
        int start = (texel.y + row) * lightCells.z + texel.x;
        float line = (texelFetch(lightDepths, start - 1).x > height ? 1.0 - part.x : 0.0) +
                     (texelFetch(lightDepths, start).x > height ? 1.0 : 0.0) +
                     (texelFetch(lightDepths, start + 1).x > height ? part.x : 0.0);
        sum += line * (row < 0 ? 1.0 - part.y : (row > 0 ? part.y : 1.0));
    }
    return inMap ? 0.25 * sum : 0.0;
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
