// Where four rays first meet the surface of the metaballs (view.h defines their field), and what the surface is there.
// Four rays at a time, because fetching a ball costs more than evaluating its kernel: each ball of the tile's list is
// fetched once for four rays and eight samples of the field on each.
//
// On a ray at view depth t the root of a ball's kernel is w - q (t - t0)^2, where t0 is the depth closest to the ball's
// center, as in render/cpu/metaballs/near_balls-inl.h. At equal steps it follows from two additions.

#define threshold metaballs.x
#define fieldStep metaballs.y
#define smallestRadius metaballs.z
#define hiddenField metaballs.w
#define greatestReach depthMapSize.w

// A ball: its center in view coordinates (m) and the peak of its kernel's root; unless all have the same reach, a second
// texel with the reach (m) and the squared slope (1/m^2).
uniform samplerBuffer balls;
uniform isamplerBuffer ballBegins;
uniform isamplerBuffer ballItems; // of each tile, front to back
uniform usamplerBuffer ballAttributes;  // color, sky visibility along +x +y +z, along -x -y -z, packed

struct Ball {
    vec3 center;
    float reach;
    float peak;
    float slopeSquare;
};

Ball ballAt(int index) {
#ifdef ONE_REACH
    vec4 ball = texelFetch(balls, index);
    return Ball(ball.xyz, greatestReach, ball.w, ball.w / (greatestReach * greatestReach));
#else
    vec4 first = texelFetch(balls, 2 * index);
    vec4 second = texelFetch(balls, 2 * index + 1);
    return Ball(first.xyz, second.x, first.w, second.y);
#endif
}

// The rays through four points of the image plane, and what they meet. A found depth of 0 means no hit.
struct FourRays {
    vec4 x;
    vec4 y;
    vec4 square;    // squared length of the direction
    vec4 inverse;   // 1 / square
    vec4 found;     // view depth of the hit (m)
    vec4 low;       // depths between which it lies
    vec4 high;
    vec4 maxField;  // greatest sample of the field
    int first;      // balls of the list before this one end before the nearest hit
};

FourRays fourRays(vec4 x, vec4 y) {
#ifdef PERSPECTIVE
    vec4 square = x * x + y * y + 1.0;
    return FourRays(x, y, square, 1.0 / square, vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), 0);
#else
    return FourRays(x, y, vec4(1.0), vec4(1.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), 0);
#endif
}

// Eight samples of the field on each ray.
struct Window {
    vec4 f0, f1, f2, f3, f4, f5, f6, f7;
};

// The root of a ball's kernel where rays come closest to its center, and the depth of that point.
void approach(FourRays rays, Ball ball, out vec4 w, out vec4 closest) {
#ifdef PERSPECTIVE
    closest = (ball.center.x * rays.x + ball.center.y * rays.y + ball.center.z) * rays.inverse;
    vec4 offX = ball.center.x - closest * rays.x;
    vec4 offY = ball.center.y - closest * rays.y;
    vec4 offZ = ball.center.z - closest;
    w = ball.peak - (offX * offX + offY * offY + offZ * offZ) * ball.slopeSquare;
#else
    closest = vec4(ball.center.z);
    vec4 offX = ball.center.x - rays.x;
    vec4 offY = ball.center.y - rays.y;
    w = ball.peak - (offX * offX + offY * offY) * ball.slopeSquare;
#endif
}

// @param inverse  1 / spacing of the samples
void addBall(FourRays rays, Ball ball, vec4 start, float spacing, float inverse, inout Window at) {
    vec4 w, closest;
    approach(rays, ball, w, closest);
    vec4 q = rays.square * (ball.slopeSquare * spacing * spacing);
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

// The first sample interval of a window in which each ray meets the surface, or may have met it unseen.
struct Event {
    vec4 index;             // of the interval's first sample; -1 without an event
    vec4 f0, f1, f2, f3;    // samples before, at both ends of and after the interval
};

void addEvent(vec4 index, vec4 f0, vec4 f1, vec4 f2, vec4 f3, inout Event event) {
    bvec4 isMet = greaterThanEqual(f2, vec4(threshold));
    event.index = mix(event.index, vec4(index), isMet);
    event.f0 = mix(event.f0, f0, isMet);
    event.f1 = mix(event.f1, f1, isMet);
    event.f2 = mix(event.f2, f2, isMet);
    event.f3 = mix(event.f3, f3, isMet);
}

Event firstEvent(Window at) {
    Event event = Event(vec4(-1.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    addEvent(vec4(6.0), at.f5, at.f6, at.f7, 2.0 * at.f7 - at.f6, event);
    addEvent(vec4(5.0), at.f4, at.f5, at.f6, at.f7, event);
    addEvent(vec4(4.0), at.f3, at.f4, at.f5, at.f6, event);
    addEvent(vec4(3.0), at.f2, at.f3, at.f4, at.f5, event);
    addEvent(vec4(2.0), at.f1, at.f2, at.f3, at.f4, event);
    addEvent(vec4(1.0), at.f0, at.f1, at.f2, at.f3, event);
    addEvent(vec4(0.0), max(2.0 * at.f0 - at.f1, 0.0), at.f0, at.f1, at.f2, event);
    return event;
}

// Where the cubic through four samples meets the threshold between the second and the third, by Newton's method from
// the chord; from 0 to 1.
vec4 cubicRoot(Event at) {
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

vec4 asNumbers(bvec4 flags) {
    return vec4(flags);
}

float leastOf(vec4 v) {
    return min(min(v.x, v.y), min(v.z, v.w));
}

float greatestOf(vec4 v) {
    return max(max(v.x, v.y), max(v.z, v.w));
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

// Sets hits. @param isMet  1 for rays that meet the surface between two depths, near a third one
void setHits(vec4 isMet, vec4 low, vec4 high, vec4 depth, int first, inout FourRays rays) {
    bvec4 chosen = greaterThan(isMet, vec4(0.0));
    rays.found = mix(rays.found, max(depth, 1.0e-30), chosen);
    rays.low = mix(rays.low, low, chosen);
    rays.high = mix(rays.high, high, chosen);
    rays.first = greatestOf(isMet) > 0.0 ? min(rays.first, first) : rays.first;
}

// Sets the hits of open rays that meet the surface in a window.
// @param isOpen  1 for rays that may be hit, else 0
void addHits(Window at, vec4 start, float spacing, vec4 isOpen, int first, inout FourRays rays) {
    Event event = firstEvent(at);
    // A ray that begins inside the surface hits it there.
    bvec4 isInside = greaterThanEqual(at.f0, vec4(threshold));
    vec4 low = mix(start + event.index * spacing, start, isInside);
    vec4 hit = mix(low + cubicRoot(event) * spacing, start, isInside);
    vec4 isMet = max(asNumbers(greaterThanEqual(event.index, vec4(0.0))), asNumbers(isInside)) * isOpen;
    setHits(isMet, low, mix(low + spacing, start, isInside), hit, first, rays);
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

// Sets the hits of open rays that touch the surface between the samples of a dense window.
void addTouches(Window at, vec4 start, float spacing, vec4 isOpen, int first, inout FourRays rays) {
    vec4 index, before, middle, behind;
    greatestTriple(at, index, before, middle, behind);
    vec4 bend = max(2.0 * middle - before - behind, 1.0e-20);
    vec4 turn = behind - before;
    vec4 peak = middle + turn * turn / (8.0 * bend);
    vec4 isMet = asNumbers(greaterThanEqual(peak, vec4(threshold))) * asNumbers(lessThan(middle, vec4(threshold))) * isOpen;
    vec4 touch = start + (index + clamp(0.5 * turn / bend, -1.0, 1.0)) * spacing;
    setHits(isMet, touch, touch, touch, first, rays);
}

// The first ball of a tile that may reach beyond a depth: the balls are listed by the depths at which they begin.
int firstBeyond(int first, int end, float depth) {
    float least = depth - 2.0 * greatestReach;
    while (first < end) {
        int middle = (first + end) >> 1;
        Ball ball = ballAt(texelFetch(ballItems, middle).x);
        if (ball.center.z - ball.reach < least)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

// The depth at which the first ball begins that one of the rays meets, if that is beyond a depth.
// @param first  advanced past balls that no ray meets
float entryOf(FourRays rays, float depth, int end, inout int first) {
    float entry = kFarDepth;
    for (int k = first; k < end; ++k) {
        Ball ball = ballAt(texelFetch(ballItems, k).x);
        if (ball.center.z - ball.reach > entry) break;
        vec4 w, closest;
        approach(rays, ball, w, closest);
        bool isMet = greatestOf(w) > 0.0 && ball.center.z + ball.reach > depth;
        entry = isMet ? min(entry, ball.center.z - ball.reach) : entry;
        first = !isMet && k == first ? k + 1 : first;
    }
    return max(depth, entry);
}

// Finds the hits between two view depths, a window of eight samples after another. Where the field may have exceeded
// the threshold between samples, the next window is a dense one around the greatest of them.
// @param tile  whose list of balls is taken
void castRays(int tile, float from, float to, inout FourRays rays) {
    int end = texelFetch(ballBegins, tile + 1).x;
#ifdef SEARCHED
    int first = firstBeyond(texelFetch(ballBegins, tile).x, end, from);
#else
    int first = texelFetch(ballBegins, tile).x;
#endif
    // Depth of the window's first sample.
    float base = entryOf(rays, from, end, first);
    vec4 before = vec4(0.0);   // the sample before it
    float suspect = -1.0;      // sample of the window around which the next window is dense; -1: none
    vec4 isSuspect = vec4(0.0);
    rays.first = end;
    for (int count = 0; first < end && count < 1000; ++count) {
        bool isDense = suspect >= 0.0;
        float spacing = isDense ? fieldStep * (2.0 / 7.0) : fieldStep;
        vec4 start = vec4(isDense ? max(base + (suspect - 1.0) * fieldStep, 0.0) : base);
        float inverse = 1.0 / spacing;
        float last = base + 7.0 * fieldStep;
        Window at = Window(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
        bool hasEnded = true;    // whether no ball reaches beyond the window
        bool isEmpty = true;     // whether none of those that have begun does
        float ahead = last;      // where the next ball begins
        int skipped = first;
        for (int k = first; k < end; ++k) {
            Ball ball = ballAt(texelFetch(ballItems, k).x);
            if (ball.center.z - ball.reach > last) {
                hasEnded = false;
                ahead = ball.center.z - ball.reach;
                break;
            }
            addBall(rays, ball, start, spacing, inverse, at);
            bool isOver = ball.center.z + ball.reach <= last;
            hasEnded = hasEnded && isOver;
            isEmpty = isEmpty && isOver;
            skipped = k == skipped && isOver ? k + 1 : skipped;
        }
        rays.maxField = max(rays.maxField, greatestSample(at));
        vec4 isOpen = asNumbers(equal(rays.found, vec4(0.0)));
        if (isDense) {
            addHits(at, start, spacing, isOpen * isSuspect, first, rays);
            isOpen = asNumbers(equal(rays.found, vec4(0.0)));
            addTouches(at, start, spacing, isOpen * isSuspect, first, rays);
            // The window begins again at the suspect sample, which is not suspect twice.
            base += suspect * fieldStep;
            before = vec4(1.0e30);
            suspect = -1.0;
        } else {
            vec4 found = suspectOf(at, before);
            vec4 met = firstEvent(at).index;
            vec4 isEarlier = max(asNumbers(lessThan(found, met)), asNumbers(lessThan(met, vec4(0.0))));
            vec4 isHidden = asNumbers(greaterThanEqual(found, vec4(0.0))) * isEarlier * isOpen;
            addHits(at, start, spacing, isOpen * (1.0 - isHidden), first, rays);
            suspect = leastOf(mix(vec4(100.0), found, greaterThan(isHidden, vec4(0.0))));
            isSuspect = isHidden * asNumbers(equal(found, vec4(suspect)));
            if (suspect > 99.0) {
                suspect = -1.0;
                if (hasEnded || last > to) break;
                before = isEmpty ? vec4(0.0) : at.f6;
                base = isEmpty ? max(last, ahead) : last;
                first = skipped;
            }
        }
        if (leastOf(rays.found) > 0.0) break;
    }
}

// Brings the hits nearer to the surface by steps of Newton's method on the field itself, or of bisection where such a step
// would leave the interval that the hit lies in.
void refineHits(int tile, int steps, inout FourRays rays) {
    int end = texelFetch(ballBegins, tile + 1).x;
    for (int step = 0; step < steps; ++step) {
        float deepest = greatestOf(rays.found);
        vec4 field = vec4(0.0);
        vec4 slope = vec4(0.0);
        for (int k = rays.first; k < end; ++k) {
            Ball ball = ballAt(texelFetch(ballItems, k).x);
            if (ball.center.z - ball.reach > deepest) break;
            vec4 w, closest;
            approach(rays, ball, w, closest);
            vec4 off = rays.found - closest;
            vec4 steep = rays.square * ball.slopeSquare;
            vec4 root = max(w - steep * off * off, 0.0);
            field += root * root;
            slope -= 4.0 * root * steep * off;
        }
        vec4 excess = field - threshold;
        bvec4 isInside = greaterThanEqual(excess, vec4(0.0));
        rays.high = mix(rays.high, min(rays.high, rays.found), isInside);
        rays.low = mix(max(rays.low, rays.found), rays.low, isInside);
        vec4 newton = rays.found - excess / max(slope, 1.0e-20);
        bvec4 isBracketed = greaterThan(asNumbers(greaterThanEqual(newton, rays.low)) *
                                        asNumbers(lessThanEqual(newton, rays.high)), vec4(0.0));
        vec4 next = mix(0.5 * (rays.low + rays.high), newton, isBracketed);
        rays.found = mix(rays.found, max(next, 1.0e-30), greaterThan(rays.found, vec4(0.0)));
    }
}

// The surface at the hits of four rays.
struct FourHits {
    vec4 depth;   // 0 without a hit
    vec4 normalX, normalY, normalZ;  // in view coordinates
    vec4 red, green, blue;
    vec4 skyAlong, skyAgainst, skyMirrored;
};

vec4 toward(vec4 direction, vec4 plus, vec4 minus) {
    return direction * direction * mix(minus, plus, greaterThan(direction, vec4(0.0)));
}

// Gradient, color and sky visibility at the hits.
FourHits surfaceAt(int tile, FourRays rays) {
    int end = texelFetch(ballBegins, tile + 1).x;
    float deepest = greatestOf(rays.found);
    vec4 field = vec4(0.0);
    vec4 x = field, y = field, z = field;                          // gradient over -4
    vec4 red = field, green = field, blue = field;
    vec4 plusX = field, plusY = field, plusZ = field, minusX = field, minusY = field, minusZ = field;
    for (int k = rays.first; k < end; ++k) {
        int index = texelFetch(ballItems, k).x;
        Ball ball = ballAt(index);
        if (ball.center.z - ball.reach > deepest) break;
#ifdef PERSPECTIVE
        vec4 offX = rays.found * rays.x - ball.center.x;
        vec4 offY = rays.found * rays.y - ball.center.y;
#else
        vec4 offX = rays.x - ball.center.x;
        vec4 offY = rays.y - ball.center.y;
#endif
        vec4 offZ = rays.found - ball.center.z;
        vec4 root = max(ball.peak - (offX * offX + offY * offY + offZ * offZ) * ball.slopeSquare, 0.0);
        vec4 kernel = root * root;
        vec4 steep = root * ball.slopeSquare;
        field += kernel;
        x += steep * offX;
        y += steep * offY;
        z += steep * offZ;
        uvec4 attributes = texelFetch(ballAttributes, index);
        vec3 color = unpackColor(attributes.x);
        red += color.r * kernel;
        green += color.g * kernel;
        blue += color.b * kernel;
#ifdef PARTICLE_SKY
        vec3 plus = unpackSky(attributes.y);
        vec3 minus = unpackSky(attributes.z);
        plusX += plus.x * kernel;
        plusY += plus.y * kernel;
        plusZ += plus.z * kernel;
        minusX += minus.x * kernel;
        minusY += minus.y * kernel;
        minusZ += minus.z * kernel;
#endif
    }
    FourHits hits;
    hits.depth = rays.found;
    vec4 scale = 1.0 / sqrt(max(x * x + y * y + z * z, 1.0e-30));
    x *= scale;
    y *= scale;
    z *= scale;
    vec4 share = 1.0 / max(field, 1.0e-30);
    hits.red = red * share;
    hits.green = green * share;
    hits.blue = blue * share;
    hits.normalX = right.x * x + up.x * y + forward.x * z;
    hits.normalY = right.y * x + up.y * y + forward.y * z;
    hits.normalZ = right.z * x + up.z * y + forward.z * z;
#ifdef PARTICLE_SKY
    hits.skyAlong = (toward(hits.normalX, plusX, minusX) + toward(hits.normalY, plusY, minusY) +
                     toward(hits.normalZ, plusZ, minusZ)) * share;
    hits.skyAgainst = (toward(hits.normalX, minusX, plusX) + toward(hits.normalY, minusY, plusY) +
                       toward(hits.normalZ, minusZ, plusZ)) * share;
    vec4 inverseLength = 1.0 / sqrt(rays.square);
#ifdef PERSPECTIVE
    vec4 cosine = 2.0 * (x * rays.x + y * rays.y + z) * inverseLength;
    vec4 mirroredX = rays.x * inverseLength - cosine * x;
    vec4 mirroredY = rays.y * inverseLength - cosine * y;
#else
    vec4 cosine = 2.0 * z;
    vec4 mirroredX = -cosine * x;
    vec4 mirroredY = -cosine * y;
#endif
    vec4 mirroredZ = inverseLength - cosine * z;
    hits.skyMirrored =
        (toward(right.x * mirroredX + up.x * mirroredY + forward.x * mirroredZ, plusX, minusX) +
         toward(right.y * mirroredX + up.y * mirroredY + forward.y * mirroredZ, plusY, minusY) +
         toward(right.z * mirroredX + up.z * mirroredY + forward.z * mirroredZ, plusZ, minusZ)) * share;
#else
    hits.skyAlong = vec4(1.0);
    hits.skyAgainst = vec4(1.0);
    hits.skyMirrored = vec4(1.0);
#endif
    return hits;
}

// The view depth at which the first ball of a tile begins, or that of the eye.
float nearestBall(int tile) {
    Ball ball = ballAt(texelFetch(ballItems, texelFetch(ballBegins, tile).x).x);
    return max(ball.center.z - ball.reach, 0.0);
}
