// The balls of the metaballs, and four rays at a time to meet them: fetching a ball costs more than evaluating its
// kernel, so
// that each ball of a tile's list is fetched once for four rays.
//
// On a ray at view depth t the root of a ball's kernel is w - q (t - t0)^2, where t0 is the depth closest to the ball's
// center, as in render/cpu/metaballs/near_balls-inl.h.

#define threshold metaballs.x
#define fieldStep metaballs.y
#define smallestRadius metaballs.z
#define hiddenField metaballs.w
#define greatestReach depthMapSize.w

// A ball: its center in view coordinates (m) and the peak of its kernel's root. Unless all have the same reach, a
// second
// texel follows with the reach (m) and the squared slope (1/m^2).
uniform samplerBuffer balls;
uniform isamplerBuffer ballBegins;
uniform isamplerBuffer ballItems;  // of each tile, front to back

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

vec4 asNumbers(bvec4 flags) {
    return vec4(flags);
}

float leastOf(vec4 v) {
    return min(min(v.x, v.y), min(v.z, v.w));
}

float greatestOf(vec4 v) {
    return max(max(v.x, v.y), max(v.z, v.w));
}

// The view depth at which the first ball of a tile begins, or that of the eye.
float nearestBall(int tile) {
    Ball ball = ballAt(texelFetch(ballItems, texelFetch(ballBegins, tile).x).x);
    return max(ball.center.z - ball.reach, 0.0);
}
