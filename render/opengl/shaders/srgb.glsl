// Threshold of a pixel for the ordered dither of section 5 of shading_model.h, from 0 to 1.
float ditherThreshold(ivec2 place) {
    ivec3 y = ivec3(place.y, place.y >> 1, place.y >> 2) & 1;
    ivec3 differs = (ivec3(place.x, place.x >> 1, place.x >> 2) & 1) ^ y;
    ivec3 digits = 2 * differs + y;
    return (float(16 * digits.x + 4 * digits.y + digits.z) + 0.5) / 64.0;
}

// sRGB encoding to whole steps of 1/255, by the polynomial of render/cpu/shading/shade.cpp: the standard gives `pow` no
// accuracy to rely on.
vec3 encode(vec3 linear, ivec2 place) {
    vec3 color = clamp(linear, 0.0, 1.0);
    vec3 square = sqrt(color);
    vec3 y = sqrt(square);
    vec3 even = 0.2727522 * color + 1.2442140 * square - 0.0616297;
    vec3 odd = -0.0627590 * color - 0.5575557 * square + 0.1649740;
    vec3 value = mix(even + y * odd, 12.92 * color, lessThanEqual(color, vec3(0.0031308)));
    return floor(value * 255.0 + ditherThreshold(place)) / 255.0;
}
