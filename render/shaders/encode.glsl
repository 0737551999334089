// sRGB encoding without pow(), which is slow in a software renderer and differs in its last bits between processors.
// 1.055 c^(1/2.4) - 0.055 is a smooth function of y = c^(1/4), two square roots away: a polynomial of degree 5 in y through the
// Chebyshev nodes of [0.0031308^(1/4), 1] is within 0.0025 of an 8-bit step. tests/render/encode_test.cpp measures it.
vec3 encodeSrgb(vec3 linear) {
    vec3 c = clamp(linear, 0.0, 1.0);
    // y^2 and y^4 are there before the second root, so that little waits for it.
    vec3 square = sqrt(c);
    vec3 y = sqrt(square);
    vec3 even = 0.2727522 * c + 1.2442140 * square - 0.0616297;
    vec3 odd = -0.0627590 * c - 0.5575557 * square + 0.1649740;
    vec3 curve = even + y * odd;
    return mix(curve, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

// The nearest 8-bit value, so that the conversion to bytes has nothing left to round.
vec3 encodeBytes(vec3 linear) { return floor(encodeSrgb(linear) * 255.0 + 0.5) * (1.0 / 255.0); }
