// sRGB encoding to whole steps of 1/255, by the polynomial of render/cpu/shading/shade.cpp: the standard gives `pow` no
// accuracy to rely on.
vec3 encode(vec3 linear) {
    vec3 color = clamp(linear, 0.0, 1.0);
    vec3 square = sqrt(color);
    vec3 y = sqrt(square);
    vec3 even = 0.2727522 * color + 1.2442140 * square - 0.0616297;
    vec3 odd = -0.0627590 * color - 0.5575557 * square + 0.1649740;
    vec3 value = mix(even + y * odd, 12.92 * color, lessThanEqual(color, vec3(0.0031308)));
    return floor(value * 255.0 + 0.5) / 255.0;
}
