// The light of glowing particles, as in render/cpu/lighting/glow_light-inl.h.

uniform samplerBuffer glowGrid;  // six texels a cube: irradiance on its sides +x, -x, +y, -y, +z, -z

vec3 glowOnSide(int first, vec3 part, int side) {
    int row = int(glowCellCount.x);
    int slice = row * int(glowCellCount.y);
    vec3 sum = vec3(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 step = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        vec3 weights = mix(1.0 - part, part, vec3(step));
        int cell = first + step.x + row * step.y + slice * step.z;
        sum += weights.x * weights.y * weights.z * texelFetch(glowGrid, 6 * cell + side).rgb;
    }
    return sum;
}

vec3 glowLight(vec3 position, vec3 normal) {
    vec3 at = (position - glowCells.xyz) * glowCells.w;
    vec3 corner = floor(at);
    vec3 part = at - corner;
    ivec3 cell = ivec3(corner);
    ivec3 count = ivec3(glowCellCount.xyz);
    bool isInGrid = all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, count - 1));
    int first = isInGrid ? cell.x + count.x * (cell.y + count.y * cell.z) : 0;
    vec3 light = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis)
        light += normal[axis] * normal[axis] * glowOnSide(first, part, 2 * axis + (normal[axis] > 0.0 ? 0 : 1));
    return isInGrid ? light : vec3(0.0);
}
