// How open to the sky a point of a particle is, see view.h: of a sphere's six values, or a sample of the metaballs.
uniform samplerBuffer sphereOpen;    // two texels a sphere: along +x, +y, +z | along -x, -y, -z
uniform usamplerBuffer fieldOpen;    // a sample's openness along the normal, against it, along the mirrored ray; 10 bits each

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
