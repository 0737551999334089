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

// Of an ellipsoid the second texel has the diagonal of its form (1/m^2) and its reach along the view depth, and a third one
// the entries xy, xz and yz.
struct Ball {
    vec3 center;
    float reach;
    float peak;
#ifdef ELLIPSOIDS
    vec3 diagonal;
    vec3 mixed;
#else
    float slopeSquare;
#endif
};

Ball ballAt(int index) {
#if defined(ELLIPSOIDS)
    vec4 first = texelFetch(balls, 3 * index);
    vec4 second = texelFetch(balls, 3 * index + 1);
    return Ball(first.xyz, second.w, first.w, second.xyz, texelFetch(balls, 3 * index + 2).xyz);
#elif defined(ONE_REACH)
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

#ifdef ELLIPSOIDS
// The products of a ball's form with four vectors.
void formTimes(Ball ball, vec4 x, vec4 y, vec4 z, out vec4 steepX, out vec4 steepY, out vec4 steepZ) {
    steepX = ball.diagonal.x * x + ball.mixed.x * y + ball.mixed.y * z;
    steepY = ball.mixed.x * x + ball.diagonal.y * y + ball.mixed.z * z;
    steepZ = ball.mixed.y * x + ball.mixed.z * y + ball.diagonal.z * z;
}

// The greatest root of a ball's kernel on the rays, the depth of that point, and q for depths in units of `unit`. The
// point is found from the one nearest to the center, where numbers are small.
void approach(FourRays rays, Ball ball, float unit, out vec4 w, out vec4 closest, out vec4 q) {
    vec4 alongX, alongY, alongZ;
#ifdef PERSPECTIVE
    formTimes(ball, rays.x, rays.y, vec4(1.0), alongX, alongY, alongZ);
    closest = (ball.center.x * rays.x + ball.center.y * rays.y + ball.center.z) * rays.inverse;
    vec4 offX = closest * rays.x - ball.center.x;
    vec4 offY = closest * rays.y - ball.center.y;
    vec4 offZ = closest - ball.center.z;
    q = rays.x * alongX + rays.y * alongY + alongZ;
    vec4 change = -(offX * alongX + offY * alongY + offZ * alongZ) / q;
    offX += change * rays.x;
    offY += change * rays.y;
#else
    formTimes(ball, vec4(0.0), vec4(0.0), vec4(1.0), alongX, alongY, alongZ);
    closest = vec4(ball.center.z);
    vec4 offX = rays.x - ball.center.x;
    vec4 offY = rays.y - ball.center.y;
    vec4 offZ = vec4(0.0);
    q = alongZ;
    vec4 change = -(offX * alongX + offY * alongY) / q;
#endif
    offZ += change;
    closest += change;
    vec4 steepX, steepY, steepZ;
    formTimes(ball, offX, offY, offZ, steepX, steepY, steepZ);
    w = ball.peak - (offX * steepX + offY * steepY + offZ * steepZ);
    q *= unit * unit;
}
#else
// The greatest root of a ball's kernel on the rays, where they come closest to its center, the depth of that point,
// and q for depths in units of `unit`.
void approach(FourRays rays, Ball ball, float unit, out vec4 w, out vec4 closest, out vec4 q) {
    q = rays.square * (ball.slopeSquare * unit * unit);
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
#endif

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
