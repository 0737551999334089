// Where a ray of any direction meets spheres, boxes, triangles and the ground, by a hierarchy of boxes around them.

uniform samplerBuffer solidNodes;    // two texels a node: low corner, high corner (m)
uniform isamplerBuffer solidLinks;   // two numbers a node: first child or solid, number of solids (0: two children)
uniform isamplerBuffer solidIds;     // hit ids of the CPU, of which those of triangles begin with kSolidTriangle
uniform usamplerBuffer triangles;    // corners and mesh of each triangle
uniform samplerBuffer meshCorners;   // relative to the eye along the world's axes (m)
uniform samplerBuffer meshNormals;
uniform samplerBuffer meshMedia;     // two texels a mesh: color and transparency; refractive index and 1/distance (1/m)
uniform vec4 solidCount;             // nodes

const int kSolidTriangle = 1 << 27;

struct SolidHit {
    float distance;
    int id;  // kHitBackground if there is none
};

struct SolidSurface {
    vec3 normal;  // on the side that the ray comes from
    vec3 color;
    int mesh;     // -1 if it is none
    bool isInner;
};

void keepSolid(inout SolidHit best, float distance, int id, float least) {
    bool isNearer = distance > least && (distance < best.distance || (distance == best.distance && id < best.id));
    if (isNearer) best = SolidHit(distance, id);
}

void meetSolid(inout SolidHit best, int id, vec3 origin, vec3 direction, vec3 inverse, float least) {
#ifdef VIEW_BOXES
    if (id >= kHitBox) {
        int box = 3 * ((id - kHitBox) >> 4);
        vec3 a = (texelOf(kBoxes, box).xyz - origin) * inverse;
        vec3 b = (texelOf(kBoxes, box + 1).xyz - origin) * inverse;
        vec3 near = min(a, b);
        vec3 far = max(a, b);
        int axis = near.x >= near.y && near.x >= near.z ? 0 : near.y >= near.z ? 1 : 2;
        if (near[axis] <= min(far.x, min(far.y, far.z)))
            keepSolid(best, near[axis], id + 2 * axis + (direction[axis] > 0.0 ? 1 : 0), least);
        return;
    }
#endif
#ifdef VIEW_MESHES
    if (id >= kSolidTriangle) {
        uvec4 corners = texelFetch(triangles, id - kSolidTriangle);
        vec3 corner = texelFetch(meshCorners, int(corners.x)).xyz;
        vec3 toSecond = texelFetch(meshCorners, int(corners.y)).xyz - corner;
        vec3 toThird = texelFetch(meshCorners, int(corners.z)).xyz - corner;
        vec3 across = cross(direction, toThird);
        float determinant = dot(toSecond, across);
        vec3 off = origin - corner;
        vec3 aside = cross(off, toSecond);
        float second = dot(off, across) / determinant;
        float third = dot(direction, aside) / determinant;
        bool isMet = determinant != 0.0 && second >= -1.0e-6 && third >= -1.0e-6 && second + third <= 1.000001;
        if (isMet) keepSolid(best, dot(toThird, aside) / determinant, id, least);
        return;
    }
#endif
#ifdef SPHERES
    vec4 sphere = texelOf(kSpheres, id);
    vec3 toCenter = right.xyz * sphere.x + up.xyz * sphere.y + forward.xyz * sphere.z - origin;
    float closest = dot(toCenter, direction);
    vec3 off = toCenter - closest * direction;
    float inside = sphere.w * sphere.w - dot(off, off);
    if (inside > 0.0) keepSolid(best, closest - sqrt(inside), id, least);
#endif
}

// The distance at which a ray enters a node's box; kFarDepth if it misses the box.
float nodeEntry(int node, vec3 origin, vec3 inverse) {
    vec3 a = (texelFetch(solidNodes, 2 * node).xyz - origin) * inverse;
    vec3 b = (texelFetch(solidNodes, 2 * node + 1).xyz - origin) * inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float enter = max(max(near.x, near.y), max(near.z, 0.0));
    // A little more than rounding can take from the interval of a flat box.
    return enter <= min(far.x, min(far.y, far.z)) * 1.00001 ? enter : kFarDepth;
}

SolidHit nearestSolid(vec3 origin, vec3 direction, float least, float most) {
    vec3 inverse = 1.0 / mix(max(direction, 1.0e-30), min(direction, -1.0e-30), lessThan(direction, vec3(0.0)));
    SolidHit best = SolidHit(most, kHitBackground);
#ifdef GROUND
    keepSolid(best, (forward.w - origin.y) * inverse.y, kHitGround, least);
#endif
    int stack[73];  // kDeepestTree of solid_tree.h, and one
    int height = 0;
    if (solidCount.x > 0.0) stack[height++] = 0;
    while (height > 0) {
        int node = stack[--height];
        if (nodeEntry(node, origin, inverse) > best.distance) continue;
        int first = texelFetch(solidLinks, 2 * node).x;
        int count = texelFetch(solidLinks, 2 * node + 1).x;
        for (int k = first; k < first + count; ++k)
            meetSolid(best, texelFetch(solidIds, k).x, origin, direction, inverse, least);
        if (count > 0) continue;
        bool isSecondNearer = nodeEntry(first + 1, origin, inverse) < nodeEntry(first, origin, inverse);
        stack[height++] = isSecondNearer ? first : first + 1;
        stack[height++] = isSecondNearer ? first + 1 : first;
    }
    return best;
}

#ifdef VIEW_MESHES
SolidSurface surfaceOfTriangle(int index, vec3 point, vec3 direction) {
    uvec4 corners = texelFetch(triangles, index);
    vec3 corner = texelFetch(meshCorners, int(corners.x)).xyz;
    vec3 toSecond = texelFetch(meshCorners, int(corners.y)).xyz - corner;
    vec3 toThird = texelFetch(meshCorners, int(corners.z)).xyz - corner;
    vec3 flat_ = cross(toSecond, toThird);
    float inverse = 1.0 / max(dot(flat_, flat_), 1.0e-37);
    vec3 off = point - corner;
    float second = clamp(dot(cross(off, toThird), flat_) * inverse, 0.0, 1.0);
    float third = clamp(dot(cross(toSecond, off), flat_) * inverse, 0.0, 1.0);
    vec3 mean = texelFetch(meshNormals, int(corners.x)).xyz * (1.0 - second - third) +
                texelFetch(meshNormals, int(corners.y)).xyz * second +
                texelFetch(meshNormals, int(corners.z)).xyz * third;
    bool isInner = dot(flat_, direction) > 0.0;
    float side = isInner ? -1.0 : 1.0;
    // Interpolated normals that the ray sees from behind, or that cancel each other, are no direction to refract by.
    bool isSmooth = dot(mean, mean) > 1.0e-12 && side * dot(mean, direction) < 0.0;
    int mesh = int(corners.w);
    return SolidSurface(side * normalize(isSmooth ? mean : flat_), texelFetch(meshMedia, 2 * mesh).rgb, mesh, isInner);
}
#endif

// @pre the ray has hit something
SolidSurface solidSurface(SolidHit hit, vec3 origin, vec3 direction) {
    vec3 point = origin + hit.distance * direction;
#ifdef VIEW_BOXES
    if (hit.id >= kHitBox) {
        int face = (hit.id - kHitBox) & 7;
        vec3 normal = vec3(0.0);
        normal[face >> 1] = (face & 1) == 0 ? 1.0 : -1.0;
        return SolidSurface(normal, texelOf(kBoxes, 3 * ((hit.id - kHitBox) >> 4) + 2).rgb, -1, false);
    }
#endif
#ifdef VIEW_MESHES
    if (hit.id >= kSolidTriangle) return surfaceOfTriangle(hit.id - kSolidTriangle, point, direction);
#endif
#ifdef SPHERES
    if (hit.id >= 0) {
        vec4 sphere = texelOf(kSpheres, hit.id);
        vec3 center = right.xyz * sphere.x + up.xyz * sphere.y + forward.xyz * sphere.z;
        return SolidSurface(normalize(point - center), unpackColor(texelFetch(sphereAttributes, hit.id).x), -1, false);
    }
#endif
    return SolidSurface(vec3(0.0, 1.0, 0.0), groundColor.rgb, -1, false);
}
