// Where four rays first meet the surface of the metaballs (view.h defines their field).
#include "balls.glsl"
#include "field_window.glsl"

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
    Crossing crossing = firstCrossing(at);
    // A ray that begins inside the surface hits it there.
    bvec4 isInside = greaterThanEqual(at.f0, vec4(threshold));
    vec4 low = mix(start + crossing.index * spacing, start, isInside);
    vec4 hit = mix(low + cubicRoot(crossing) * spacing, start, isInside);
    vec4 isMet = max(asNumbers(greaterThanEqual(crossing.index, vec4(0.0))), asNumbers(isInside)) * isOpen;
    setHits(isMet, low, mix(low + spacing, start, isInside), hit, first, rays);
}

// Sets the hits of open rays that touch the surface between the samples of a dense window.
void addTouches(Window at, vec4 start, float spacing, vec4 isOpen, int first, inout FourRays rays) {
    vec4 index, before, middle, behind;
    greatestTriple(at, index, before, middle, behind);
    vec4 bend = max(2.0 * middle - before - behind, 1.0e-20);
    vec4 turn = behind - before;
    vec4 peak = middle + turn * turn / (8.0 * bend);
    vec4 isMet = asNumbers(greaterThanEqual(peak, vec4(threshold))) * isOpen;
    isMet *= asNumbers(lessThan(middle, vec4(threshold)));
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
        vec4 w, closest, q;
        approach(rays, ball, 1.0, w, closest, q);
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
#ifdef MARKED
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
    for (int count = 0; first < end && count < 100000; ++count) {
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
            vec4 met = firstCrossing(at).index;
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
