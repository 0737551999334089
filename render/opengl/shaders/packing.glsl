// Colors as square roots in 11, 11 and 10 bits, sky visibilities in 10 bits each, normals unfolded from an octahedron.

vec3 unpackColor(uint word) {
    vec3 root = vec3(word & 2047u, (word >> 11) & 2047u, word >> 22) / vec3(2047.0, 2047.0, 1023.0);
    return root * root;
}

vec3 unpackSky(uint word) {
    return vec3(word & 1023u, (word >> 10) & 1023u, (word >> 20) & 1023u) / 1023.0;
}

uvec4 packColor(vec4 red, vec4 green, vec4 blue) {
    uvec4 r = uvec4(sqrt(clamp(red, 0.0, 1.0)) * 2047.0 + 0.5);
    uvec4 g = uvec4(sqrt(clamp(green, 0.0, 1.0)) * 2047.0 + 0.5);
    uvec4 b = uvec4(sqrt(clamp(blue, 0.0, 1.0)) * 1023.0 + 0.5);
    return r | (g << 11) | (b << 22);
}

uvec4 packSky(vec4 along, vec4 against, vec4 mirrored) {
    uvec4 a = uvec4(clamp(along, 0.0, 1.0) * 1023.0 + 0.5);
    uvec4 b = uvec4(clamp(against, 0.0, 1.0) * 1023.0 + 0.5);
    uvec4 c = uvec4(clamp(mirrored, 0.0, 1.0) * 1023.0 + 0.5);
    return a | (b << 10) | (c << 20);
}

// Of vectors that are not zero.
uvec4 packNormal(vec4 x, vec4 y, vec4 z) {
    vec4 scale = 1.0 / max(abs(x) + abs(y) + abs(z), 1.0e-30);
    x *= scale;
    y *= scale;
    bvec4 isBelow = lessThan(z, vec4(0.0));
    vec4 signX = mix(vec4(-1.0), vec4(1.0), greaterThanEqual(x, vec4(0.0)));
    vec4 signY = mix(vec4(-1.0), vec4(1.0), greaterThanEqual(y, vec4(0.0)));
    vec4 foldedX = mix(x, (1.0 - abs(y)) * signX, isBelow);
    vec4 foldedY = mix(y, (1.0 - abs(x)) * signY, isBelow);
    return uvec4(clamp((foldedX + 1.0) * 32767.5, 0.0, 65535.0) + 0.5) |
           (uvec4(clamp((foldedY + 1.0) * 32767.5, 0.0, 65535.0) + 0.5) << 16);
}

vec3 unpackNormal(uint word) {
    vec2 at = vec2(word & 65535u, word >> 16) / 32767.5 - 1.0;
    float z = 1.0 - abs(at.x) - abs(at.y);
    float below = max(-z, 0.0);
    at.x += at.x >= 0.0 ? -below : below;
    at.y += at.y >= 0.0 ? -below : below;
    return normalize(vec3(at, z));
}
