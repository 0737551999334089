// sRGB encoding without pow(), which is slow in a software renderer and differs in its last bits between processors.
// 1.055 c^(1/2.4) - 0.055 is a smooth function of y = c^(1/4), two square roots away: a polynomial of degree 5 in y through the
// Chebyshev nodes of [0.0031308^(1/4), 1] is within 0.0025 of an 8-bit step. tests/render/encode_test.cpp measures it, and
// the same polynomial in shade.cpp, which encodes the pixels that are coloured one by one.
// root: of the linear colour; to the nearest 8-bit value, so that the conversion to bytes has nothing left to round.
vec3 encodeRoots(vec3 root) {
    vec3 square = clamp(root, 0.0, 1.0);
    vec3 c = square * square;
    vec3 y = sqrt(square);
    vec3 even = 0.2727522 * c + 1.2442140 * square - 0.0616297;
    vec3 odd = -0.0627590 * c - 0.5575557 * square + 0.1649740;
    vec3 curve = mix(even + y * odd, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
    return floor(curve * 255.0 + 0.5) * (1.0 / 255.0);
}
