// Exact intersections. Each returns the view depth of the first hit in front of the eye, kFar for none. Spheres and boxes are
// solid: a ray that starts inside one hits it at depth 0.

// Measured from the point of the ray that is closest to the center: no cancellation, however far the sphere.
float hitSphere(Ray ray, vec4 sphere) {
    vec3 toCenter = sphere.xyz - ray.origin;
    float closest = dot(toCenter, ray.direction) * ray.inverseSquare;
    vec3 off = toCenter - closest * ray.direction;
    float inside = sphere.w * sphere.w - dot(off, off);
    float halfChord = sqrt(max(inside, 0.0) * ray.inverseSquare);
    return inside > 0.0 && closest + halfChord >= 0.0 ? max(closest - halfChord, 0.0) : kFar;
}

// From inside, the nearest face is the one that is seen.
vec3 nearestFace(vec3 toMinimum, vec3 toMaximum) {
    vec3 nearest = min(toMinimum, toMaximum);
    float least = min(nearest.x, min(nearest.y, nearest.z));
    vec3 face = vec3(equal(nearest, vec3(least)));
    return face * mix(vec3(1.0), vec3(-1.0), lessThan(toMinimum, toMaximum));
}

float hitBox(Ray ray, vec3 minimum, vec3 maximum, out vec3 normal) {
    vec3 slope = mix(vec3(1.0e-20), ray.direction, greaterThan(abs(ray.direction), vec3(1.0e-20)));
    vec3 first = (minimum - ray.origin) / slope;
    vec3 second = (maximum - ray.origin) / slope;
    vec3 near = min(first, second);
    vec3 far = max(first, second);
    float entry = max(near.x, max(near.y, near.z));
    float exit = min(far.x, min(far.y, far.z));
    normal = entry >= 0.0 ? -sign(slope) * vec3(equal(near, vec3(entry)))
                          : nearestFace(ray.origin - minimum, maximum - ray.origin);
    // On an edge two faces are hit; one is enough.
    normal.yz *= 1.0 - abs(normal.x);
    normal.z *= 1.0 - abs(normal.y);
    return entry <= exit && exit >= 0.0 ? max(entry, 0.0) : kFar;
}

float hitGround(Ray ray) {
    float depth = (groundColor.w - ray.origin.y) / ray.direction.y;
    return depth > 0.0 && depth < kFar ? depth : kFar;
}
