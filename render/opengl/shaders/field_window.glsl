// Samples of the field at equal steps along four rays, and where they meet the surface between samples.

// Eight samples of the field on each ray.
struct Window {
    vec4 f0, f1, f2, f3, f4, f5, f6, f7;
};

// @param inverse  1 / spacing of the samples
void addBall(FourRays rays, Ball ball, vec4 start, float spacing, float inverse, inout Window at) {
    vec4 w, closest, q;
    approach(rays, ball, spacing, w, closest, q);
    vec4 off = (start - closest) * inverse;
    vec4 root = w - q * off * off;
    vec4 change = q * (-1.0 - 2.0 * off);
    vec4 bend = -2.0 * q;
    vec4 kernel = max(root, 0.0); at.f0 += kernel * kernel; root += change; change += bend;
    kernel = max(root, 0.0); at.f1 += kernel * kernel; root += change; change += bend;
    kernel = max(root, 0.0); at.f2 += kernel * kernel; root += change; change += bend;
    kernel = max(root, 0.0); at.f3 += kernel * kernel; root += change; change += bend;
    kernel = max(root, 0.0); at.f4 += kernel * kernel; root += change; change += bend;
    kernel = max(root, 0.0); at.f5 += kernel * kernel; root += change; change += bend;
    kernel = max(root, 0.0); at.f6 += kernel * kernel; root += change; change += bend;
    kernel = max(root, 0.0); at.f7 += kernel * kernel;
}

// The first interval between two samples of a window in which each ray meets the surface.
struct Crossing {
    vec4 index;             // of the interval's first sample; -1 if the ray does not meet the surface
    vec4 f0, f1, f2, f3;    // samples before, at both ends of and after the interval
};

void addCrossing(vec4 index, vec4 f0, vec4 f1, vec4 f2, vec4 f3, inout Crossing crossing) {
    bvec4 isMet = greaterThanEqual(f2, vec4(threshold));
    crossing.index = mix(crossing.index, vec4(index), isMet);
    crossing.f0 = mix(crossing.f0, f0, isMet);
    crossing.f1 = mix(crossing.f1, f1, isMet);
    crossing.f2 = mix(crossing.f2, f2, isMet);
    crossing.f3 = mix(crossing.f3, f3, isMet);
}

Crossing firstCrossing(Window at) {
    Crossing crossing = Crossing(vec4(-1.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    addCrossing(vec4(6.0), at.f5, at.f6, at.f7, 2.0 * at.f7 - at.f6, crossing);
    addCrossing(vec4(5.0), at.f4, at.f5, at.f6, at.f7, crossing);
    addCrossing(vec4(4.0), at.f3, at.f4, at.f5, at.f6, crossing);
    addCrossing(vec4(3.0), at.f2, at.f3, at.f4, at.f5, crossing);
    addCrossing(vec4(2.0), at.f1, at.f2, at.f3, at.f4, crossing);
    addCrossing(vec4(1.0), at.f0, at.f1, at.f2, at.f3, crossing);
    addCrossing(vec4(0.0), max(2.0 * at.f0 - at.f1, 0.0), at.f0, at.f1, at.f2, crossing);
    return crossing;
}

// Where the cubic through four samples meets the threshold between the second and the third, by Newton's method from
// the chord; from 0 to 1.
vec4 cubicRoot(Crossing at) {
    vec4 rise = 0.5 * (at.f2 - at.f0);
    vec4 square = at.f0 - 2.5 * at.f1 + 2.0 * at.f2 - 0.5 * at.f3;
    vec4 cube = 0.5 * (at.f3 - at.f0) + 1.5 * (at.f1 - at.f2);
    vec4 missing = threshold - at.f1;
    vec4 u = clamp(missing / max(at.f2 - at.f1, 1.0e-20), 0.0, 1.0);
    for (int k = 0; k < 2; ++k) {
        vec4 value = u * (rise + u * (square + u * cube));
        vec4 slope = rise + u * (2.0 * square + 3.0 * u * cube);
        u = clamp(u + (missing - value) / max(slope, 1.0e-20), 0.0, 1.0);
    }
    return u;
}

vec4 greatestSample(Window at) {
    return max(max(max(at.f0, at.f1), max(at.f2, at.f3)), max(max(at.f4, at.f5), max(at.f6, at.f7)));
}

// 1 where the parabola through three samples, of which the second is below the threshold and the greatest, reaches the
// threshold, or nearly.
vec4 isHiddenMaximum(vec4 before, vec4 at, vec4 behind) {
    vec4 bend = 2.0 * at - before - behind;
    vec4 turn = behind - before;
    vec4 peak = at + turn * turn / (8.0 * max(bend, 1.0e-20));
    return asNumbers(greaterThanEqual(peak, vec4(threshold - hiddenField))) * asNumbers(lessThan(at, vec4(threshold))) *
           asNumbers(greaterThanEqual(at, before)) * asNumbers(greaterThanEqual(at, behind));
}

// The first sample of a window where the field may exceed the threshold unseen; -1 without one.
vec4 suspectOf(Window at, vec4 before) {
    vec4 suspect = vec4(-1.0);
    suspect = mix(suspect, vec4(6.0), isHiddenMaximum(at.f5, at.f6, at.f7));
    suspect = mix(suspect, vec4(5.0), isHiddenMaximum(at.f4, at.f5, at.f6));
    suspect = mix(suspect, vec4(4.0), isHiddenMaximum(at.f3, at.f4, at.f5));
    suspect = mix(suspect, vec4(3.0), isHiddenMaximum(at.f2, at.f3, at.f4));
    suspect = mix(suspect, vec4(2.0), isHiddenMaximum(at.f1, at.f2, at.f3));
    suspect = mix(suspect, vec4(1.0), isHiddenMaximum(at.f0, at.f1, at.f2));
    return mix(suspect, vec4(0.0), isHiddenMaximum(before, at.f0, at.f1));
}

// The greatest sample of a window but the outer ones, with those beside it.
void greatestTriple(Window at, out vec4 index, out vec4 before, out vec4 middle, out vec4 behind) {
    index = vec4(1.0); before = at.f0; middle = at.f1; behind = at.f2;
#define TAKE_GREATER(k, f0, f1, f2) { \
        bvec4 isGreater = greaterThan(f1, middle); \
        index = mix(index, vec4(k), isGreater); \
        before = mix(before, f0, isGreater); \
        behind = mix(behind, f2, isGreater); \
        middle = mix(middle, f1, isGreater); \
    }
    TAKE_GREATER(2.0, at.f1, at.f2, at.f3)
    TAKE_GREATER(3.0, at.f2, at.f3, at.f4)
    TAKE_GREATER(4.0, at.f3, at.f4, at.f5)
    TAKE_GREATER(5.0, at.f4, at.f5, at.f6)
    TAKE_GREATER(6.0, at.f5, at.f6, at.f7)
}
