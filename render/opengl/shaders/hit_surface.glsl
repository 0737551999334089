// The surface at the hits of four rays: refined depths, normals, colors and sky visibilities.

uniform usamplerBuffer ballAttributes;  // color, sky visibility along +x +y +z, along -x -y -z, packed

// Brings the hits nearer to the surface by steps of Newton's method on the field itself, or of bisection where such
// a step
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
            vec4 w, closest, steep;
            approach(rays, ball, 1.0, w, closest, steep);
            vec4 off = rays.found - closest;
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

// Gradient, color and sky visibility at the hits. What is summed up also gives a last step of Newton's method for their
// depths.
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
#ifdef ELLIPSOIDS
        vec4 steepX, steepY, steepZ;
        formTimes(ball, offX, offY, offZ, steepX, steepY, steepZ);
        vec4 root = max(ball.peak - (offX * steepX + offY * steepY + offZ * steepZ), 0.0);
        x += root * steepX;
        y += root * steepY;
        z += root * steepZ;
#else
        vec4 root = max(ball.peak - (offX * offX + offY * offY + offZ * offZ) * ball.slopeSquare, 0.0);
        vec4 steep = root * ball.slopeSquare;
        x += steep * offX;
        y += steep * offY;
        z += steep * offZ;
#endif
        vec4 kernel = root * root;
        field += kernel;
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
#ifdef PERSPECTIVE
    vec4 slope = -4.0 * (x * rays.x + y * rays.y + z);
#else
    vec4 slope = -4.0 * z;
#endif
    vec4 newton = rays.found - (field - threshold) / max(slope, 1.0e-20);
    vec4 isBracketed = asNumbers(greaterThanEqual(newton, rays.low)) * asNumbers(lessThanEqual(newton, rays.high));
    FourHits hits;
    hits.depth = mix(rays.found, max(newton, 1.0e-30), greaterThan(isBracketed * rays.found, vec4(0.0)));
    // Where a ray was found to touch the surface between samples, which is an estimate, the field itself has the last
    // word. It may miss the threshold by a little, because the depth of the touch is an estimate, too.
    vec4 isEstimate = asNumbers(equal(rays.low, rays.high)) * asNumbers(lessThan(field, vec4(0.99 * threshold)));
    hits.depth *= 1.0 - isEstimate;
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
