// How open to the sky a point is, see view.h: six values, of a particle, of a sample of the metaballs, of a place in the grid.
uniform samplerBuffer sphereOpen;    // two texels a sphere: along +x, +y, +z | along -x, -y, -z
uniform usamplerBuffer fieldOpen;    // a sample's openness along the normal, against it, along the mirrored ray; 10 bits each
uniform samplerBuffer gridOpen;      // six grids of cubes one after another, x fastest
uniform samplerBuffer groundOpen;    // upwards, on the ground

float openAlong(vec3 direction, vec3 plus, vec3 minus) {
    return dot(direction * direction, mix(minus, plus, greaterThan(direction, vec3(0.0))));
}

vec3 openOfSphere(int sphere, vec3 normal, vec3 mirrored) {
    vec3 plus = texelFetch(sphereOpen, 2 * sphere).xyz;
    vec3 minus = texelFetch(sphereOpen, 2 * sphere + 1).xyz;
    return vec3(openAlong(normal, plus, minus), openAlong(-normal, plus, minus), openAlong(mirrored, plus, minus));
}

vec3 openOfSample(int place) {
    uint bits = texelFetch(fieldOpen, place).x;
    return vec3(float(bits & 0x3ffu), float((bits >> 10) & 0x3ffu), float((bits >> 20) & 0x3ffu)) / 1023.0;
}

float openOfGround(vec3 position) {
    vec2 at = (position.xz - openMap.xy) * openMap.z;
    vec2 corner = floor(at);
    vec2 part = at - corner;
    ivec2 cell = ivec2(corner);
    bool inMap = all(greaterThanEqual(corner, vec2(0.0))) && all(lessThan(corner + 1.0, vec2(float(openCells.w), openMap.w)));
    int place = inMap ? cell.y * openCells.w + cell.x : 0;
    int row = inMap ? openCells.w : 0;
    int next = inMap ? 1 : 0;
    float near = mix(texelFetch(groundOpen, place).x, texelFetch(groundOpen, place + next).x, part.x);
    float far = mix(texelFetch(groundOpen, place + row).x, texelFetch(groundOpen, place + row + next).x, part.x);
    return inMap ? mix(near, far, part.y) : 1.0;
}

#ifdef OPEN_OBSTACLES
float openInGrid(vec3 position, vec3 direction, int grid) {
    vec3 at = (position - openGrid.xyz) * openGrid.w + 0.75 * direction;
    vec3 corner = floor(at);
    vec3 part = at - corner;
    bool inGrid = all(greaterThanEqual(corner, vec3(0.0))) && all(lessThan(corner + 1.0, vec3(openCells.xyz)));
    ivec3 cell = inGrid ? ivec3(corner) : ivec3(0);
    int row = openCells.x;
    int slice = row * openCells.y;
    int first = grid * slice * openCells.z + cell.z * slice + cell.y * row + cell.x;
    float sum = 0.0;
    for (int z = 0; z < 2; ++z) {
        for (int y = 0; y < 2; ++y) {
            int place = first + z * slice + y * row;
            float value = mix(texelFetch(gridOpen, place).x, texelFetch(gridOpen, place + 1).x, part.x);
            sum += value * (y == 0 ? 1.0 - part.y : part.y) * (z == 0 ? 1.0 - part.z : part.z);
        }
    }
    return inGrid ? sum : 1.0;
}

float openOfObstacle(vec3 position, vec3 normal) {
    float open = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 direction = vec3(0.0);
        direction[axis] = normal[axis] > 0.0 ? 1.0 : -1.0;
        open += normal[axis] * normal[axis] * openInGrid(position, direction, 2 * axis + (normal[axis] > 0.0 ? 0 : 1));
    }
    return open;
}
#endif
