// The point of a surface that a ray through the picture shows, given what it hits, and its color.
#ifdef TRANSPARENCY
#include "transparency.glsl"
#endif

vec3 mirroredRay(vec3 direction, vec3 normal) {
    return direction - 2.0 * dot(direction, normal) * normal;
}

#ifdef GROUND
void setGround(Ray ray, inout Point at) {
    at.depth = (forward.w - ray.origin.y) / ray.direction.y;
    at.normal = vec3(0.0, 1.0, 0.0);
    at.albedo = groundColor.rgb;
}
#endif

#ifdef SPHERES
void setSphere(Ray ray, int index, inout Point at) {
    vec4 sphere = texelOf(kSpheres, index);
    uvec4 attributes = texelFetch(sphereAttributes, index);
    vec3 center = right.xyz * sphere.x + up.xyz * sphere.y + forward.xyz * sphere.z;
    float inverseSquare = 1.0 / dot(ray.direction, ray.direction);
    vec3 toCenter = center - ray.origin;
    float closest = dot(toCenter, ray.direction) * inverseSquare;
    vec3 off = ray.direction * closest - toCenter;
    float inside = max(sphere.w * sphere.w - dot(off, off), 0.0);
    at.depth = max(closest - sqrt(inside * inverseSquare), 0.0);
    at.normal = normalize(off + ray.direction * (at.depth - closest));
    at.albedo = unpackColor(attributes.x);
    at.isParticle = index < int(counts.x) ? 1.0 : 0.0;
#ifdef PARTICLE_SKY
    vec3 plus = unpackSky(attributes.y);
    vec3 minus = unpackSky(attributes.z);
    vec3 reflected = mirroredRay(ray.direction * sqrt(inverseSquare), at.normal);
    vec3 visible = vec3(skyVisibilityToward(at.normal, plus, minus), skyVisibilityToward(at.normal, minus, plus),
                        skyVisibilityToward(reflected, plus, minus));
    at.sky = index < int(counts.x) ? visible : at.sky;
#endif
}
#endif

#ifdef BOXES
void setBox(Ray ray, int id, inout Point at) {
    int box = 3 * (id >> 4);
    int axis = (id & 7) >> 1;
    bool isPlus = (id & 1) == 0;
    vec3 corner = isPlus ? texelOf(kBoxes, box + 1).xyz : texelOf(kBoxes, box).xyz;
    vec3 axes = vec3(axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0);
    // In a pixel at an outline the ray through the mean of the samples may run parallel to the face.
    float slope = dot(ray.direction, axes);
    slope = abs(slope) > 1.0e-20 ? slope : 1.0e-20;
    float reached = clamp(dot(corner - ray.origin, axes) / slope, 0.0, 1.0e30);
    at.depth = (id & 8) == 0 ? reached : 0.0;
    at.normal = isPlus ? axes : -axes;
    at.albedo = texelOf(kBoxes, box + 2).rgb;
}
#endif

#ifdef METABALLS
void setMetaball(int index, inout Point at) {
    Surface found = surfaceOf(index);
    at.depth = found.depth;
    at.normal = found.normal;
    at.albedo = found.albedo;
    at.sky = found.sky;
    at.isParticle = 1.0;
}
#endif

// @param id  not kHitBackground
Point pointOf(int id, Ray ray) {
    Point at;
    at.toEye = -normalize(ray.direction);
    at.depth = 0.0;
    at.normal = -toLight.xyz;
    at.albedo = vec3(1.0);
    at.isParticle = 0.0;
    at.light = 1.0;
    at.sky = vec3(1.0);
    at.glow = vec3(0.0);
#ifdef LIGHT_TINT
    at.tint = vec3(1.0);
#endif
#ifdef TRANSPARENCY
    at.mesh = -1;
    at.bodyShare = 1.0;
    at.added = vec3(0.0);
#endif
#ifdef GROUND
    if (id == kHitGround) setGround(ray, at);
#endif
#ifdef SPHERES
    if (id >= 0 && id < kHitMesh) setSphere(ray, id, at);
#endif
#ifdef MESHES
    if (id >= kHitMesh && id < kHitBox) setMesh(id - kHitMesh, at);
#endif
#ifdef BOXES
    if (id >= kHitBox && id < kHitMetaballs) setBox(ray, id - kHitBox, at);
#endif
#ifdef METABALLS
    if (id >= kHitMetaballs) setMetaball(id - kHitMetaballs, at);
#endif
    at.position = ray.origin + ray.direction * at.depth;
    return at;
}

// Sets how much light and sky reaches a point.
void receiveLight(int id, inout Point at) {
#ifdef SHADOWS
#ifdef LIGHT_TINT
    at.light = lightVisibility(at.position, at.normal, at.depth, at.tint);
#else
    at.light = lightVisibility(at.position, at.normal, at.depth);
#endif
#endif
#ifdef GROUND_OCCLUSION
    if (id == kHitGround) at.sky.x = groundSkyVisibility(at.position);
#endif
#ifdef OBSTACLE_OCCLUSION
    if (id >= int(counts.x) && id < kHitMetaballs) at.sky.x = obstacleSkyVisibility(at.position, at.normal);
#endif
#ifdef GLOW_LIGHT
    at.glow = glowLight(at.position, at.normal);
#endif
#ifdef METABALL_MEDIUM
    if (at.isParticle == 0.0) at.sky.x = 1.0 - (1.0 - metaballMedium.x) * (1.0 - at.sky.x);
#endif
}

// Linear color of a point that has received its light. @param row  of pixels, whose background the ground fades into
vec3 pointColor(int id, Point at, float row) {
    vec3 color = surfaceColor(at);
#ifdef GROUND
    if (id == kHitGround) color = fadedGround(color, at.position, row);
#endif
    return id == kHitBackground ? background(row) : color;
}

#ifdef TRANSPARENCY
// The color of a transparent body, and of what is seen through it.
// @param at  a point of the body, which has received no light yet
vec3 throughColor(int id, Point at, float transparency, float row) {
    int endId;
    Point end;
    Walk walk = followRay(at, id, endId, end);
    receiveLight(id, at);
    at.bodyShare = 1.0 - transparency;
    at.added = walk.mirrored;
    if (id < kHitMetaballs) at.added += mirroredByMesh(at);
    vec3 own = clamp(pointColor(id, at, row), 0.0, 1.0);
    float endRow = backgroundRow(walk.direction, row);
    vec3 behind = background(endRow);
    if (endId != kHitBackground) {
        receiveLight(endId, end);
        behind = pointColor(endId, end, endRow);
    }
    return own + transparency * walk.weight * clamp(behind, 0.0, 1.0);
}
#endif

// Linear color of what the ray through a point of the picture shows, given what it hits.
vec3 colorOf(int id, vec2 pixel) {
    Ray ray = worldRay(imagePoint(pixel));
    Point at = pointOf(id, ray);
#ifdef TRANSPARENCY
    float transparency = id >= kHitMetaballs ? metaballMedium.x : at.mesh >= 0 ? mediumOfMesh(at.mesh).transparency : 0.0;
    if (transparency > 0.0) return throughColor(id, at, transparency, pixel.y);
#endif
    receiveLight(id, at);
    return pointColor(id, at, pixel.y);
}
