// Where a ray of any direction crosses the surface of metaballs. In each cell of their grid that the ray passes the
// field is sampled at eight distances at a time, because fetching a ball costs more than evaluating its kernel.

uniform isamplerBuffer cellBegins;  // of each cell, x fastest: its first ball
// Two texels a ball: center (m) and peak, color and slope (1/m). Two more for an ellipsoid: the entries xx, yy, zz, xy,
// xz and yz of its form (1/m^2).
uniform samplerBuffer cellBalls;
uniform usamplerBuffer cellSky;     // of each ball, as sphereAttributes
uniform vec4 cellGrid;              // corner of the first cell relative to the eye (m), side of a cell (m)
uniform vec4 cellCount;             // cells along each axis; w: 1 if there are balls
uniform vec4 castField;             // threshold, spacing of samples (m), distance from a surface to the next search (m)

const float kNoCrossing = 1.0e30;

// A point of the surface, at a distance along a ray.
struct FieldCrossing {
    float distance;
    vec3 normal;  // out of the metaballs
    vec3 color;
    vec3 skyPlus;
    vec3 skyMinus;
};

int ballCellIndex(int x, int y, int z) {
    return (z * int(cellCount.y) + y) * int(cellCount.x) + x;
}

#ifdef ELLIPSOIDS
const int kBallTexels = 4;

mat3 formOf(int ball) {
    vec4 first = texelFetch(cellBalls, kBallTexels * ball + 2);
    vec2 second = texelFetch(cellBalls, kBallTexels * ball + 3).xy;
    return mat3(first.x, first.w, second.x, first.w, first.y, second.y, second.x, second.y, first.z);
}
#else
const int kBallTexels = 2;

mat3 formOf(int ball) {
    float slope = texelFetch(cellBalls, kBallTexels * ball + 1).w;
    return mat3(slope * slope);
}
#endif

// A loop over the balls whose kernels may reach a cell: `k` is the index of a ball.
#define FOR_BALLS_NEAR(cell)                                                                   \
    ivec3 low = max(cell - 1, ivec3(0));                                                       \
    ivec3 high = min(cell + 1, ivec3(cellCount.xyz) - 1);                                      \
    for (int z = low.z; z <= high.z; ++z)                                                      \
        for (int y = low.y; y <= high.y; ++y)                                                  \
            for (int k = texelFetch(cellBegins, ballCellIndex(low.x, y, z)).x,                     \
                     end = texelFetch(cellBegins, ballCellIndex(high.x, y, z) + 1).x;              \
                 k < end; ++k)

// The field and its derivative at eight distances.
struct FieldSamples {
    vec4 field[2];
    vec4 slope[2];
};

FieldSamples sampleField(ivec3 cell, vec3 origin, vec3 direction, vec4 distances[2]) {
    FieldSamples found;
    found.field[0] = found.field[1] = found.slope[0] = found.slope[1] = vec4(0.0);
    FOR_BALLS_NEAR(cell) {
        vec4 ball = texelFetch(cellBalls, kBallTexels * k);
        mat3 form = formOf(k);
        vec3 toCenter = ball.xyz - origin;
        vec3 turned = form * direction;
        float square = dot(direction, turned);
        float closest = dot(toCenter, turned) / square;
        vec3 off = toCenter - direction * closest;
        float w = ball.w - dot(off, form * off);
        if (w <= 0.0) continue;
        for (int group = 0; group < 2; ++group) {
            vec4 along = distances[group] - closest;
            vec4 root = max(w - square * along * along, 0.0);
            found.field[group] += root * root;
            found.slope[group] -= 4.0 * square * root * along;
        }
    }
    return found;
}

// The index of the first true one of eight; 8 if none is.
int firstOf(bvec4 a, bvec4 b) {
    return a.x ? 0 : a.y ? 1 : a.z ? 2 : a.w ? 3 : b.x ? 4 : b.y ? 5 : b.z ? 6 : b.w ? 7 : 8;
}

int firstAcross(FieldSamples at, bool isInside) {
    vec4 limit = vec4(castField.x);
    return isInside ? firstOf(lessThan(at.field[0], limit), lessThan(at.field[1], limit))
                    : firstOf(greaterThanEqual(at.field[0], limit), greaterThanEqual(at.field[1], limit));
}

// Eight distances that divide an interval into equal parts, of which the last one ends it.
void divide(float from, float to, float parts, out vec4 distances[2]) {
    float share = (to - from) / parts;
    distances[0] = from + share * vec4(1.0, 2.0, 3.0, 4.0);
    distances[1] = from + share * vec4(5.0, 6.0, 7.0, 8.0);
}

// The distance between two at which the field crosses the threshold, the first of them being on the ray's side.
float refinedCrossing(ivec3 cell, vec3 origin, vec3 direction, float from, float to, bool isInside) {
    for (int pass = 0; pass < 4; ++pass) {
        vec4 distances[2];
        divide(from, to, 9.0, distances);
        int first = firstAcross(sampleField(cell, origin, direction, distances), isInside);
        float part = (to - from) / 9.0;
        to = first < 8 ? from + part * float(first + 1) : to;
        from = to - part;
    }
    return 0.5 * (from + to);
}

// The distance at which the ray crosses the threshold within a cell.
float crossingInCell(ivec3 cell, vec3 origin, vec3 direction, float from, float to, bool isInside) {
    float sign = isInside ? -1.0 : 1.0;
    float begin = from;
    float lastSlope = 0.0;
    float lastField = isInside ? 1.0e30 : 0.0;
    // At first the beginning itself is a sample.
    float next = from - castField.y;
    while (next < to) {
        vec4 distances[2];
        divide(next, next + 8.0 * castField.y, 8.0, distances);
        distances[0] = min(distances[0], to);
        distances[1] = min(distances[1], to);
        FieldSamples at = sampleField(cell, origin, direction, distances);
        for (int k = 0; k < 8; ++k) {
            float distance = distances[k >> 2][k & 3];
            float field = at.field[k >> 2][k & 3];
            float slope = at.slope[k >> 2][k & 3];
            if (isInside ? field < castField.x : field >= castField.x)
                return distance <= from ? from : refinedCrossing(cell, origin, direction, begin, distance, isInside);
            // Where the field turns back between two samples it may have been across: at the secant of its slopes.
            if (sign * lastSlope > 0.0 && sign * slope < 0.0) {
                float turn = (distance - begin) * (lastSlope / (lastSlope - slope));
                float extreme = lastField + 0.5 * lastSlope * turn;
                if (isInside ? extreme < castField.x : extreme >= castField.x)
                    return refinedCrossing(cell, origin, direction, begin, begin + turn, isInside);
            }
            begin = distance;
            lastSlope = slope;
            lastField = field;
        }
        next += 8.0 * castField.y;
    }
    return kNoCrossing;
}

FieldCrossing fieldSurfaceAt(ivec3 cell, vec3 point, vec3 direction, float distance) {
    FieldCrossing found = FieldCrossing(distance, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    float kernels = 0.0;
    FOR_BALLS_NEAR(cell) {
        vec4 ball = texelFetch(cellBalls, kBallTexels * k);
        vec3 off = point - ball.xyz;
        vec3 turned = formOf(k) * off;
        float root = ball.w - dot(off, turned);
        if (root <= 0.0) continue;
        found.normal += root * turned;
        found.color += root * root * texelFetch(cellBalls, kBallTexels * k + 1).rgb;
        kernels += root * root;
#ifdef PARTICLE_SKY
        uvec4 words = texelFetch(cellSky, k);
        found.skyPlus += root * root * unpackSky(words.y);
        found.skyMinus += root * root * unpackSky(words.z);
#endif
    }
    float square = dot(found.normal, found.normal);
    found.normal = square > 0.0 ? found.normal * inversesqrt(square) : -direction;
    float inverse = kernels > 0.0 ? 1.0 / kernels : 0.0;
    found.color *= inverse;
    found.skyPlus *= inverse;
    found.skyMinus *= inverse;
    return found;
}

// The first point of a part of a ray at which the field is on the other side of the threshold than the ray.
FieldCrossing findCrossing(vec3 origin, vec3 direction, float from, float to, bool isInside) {
    FieldCrossing none = FieldCrossing(kNoCrossing, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    if (cellCount.w == 0.0) return none;
    vec3 inverse = 1.0 / mix(max(direction, 1.0e-30), min(direction, -1.0e-30), lessThan(direction, vec3(0.0)));
    vec3 a = (cellGrid.xyz - origin) * inverse;
    vec3 b = (cellGrid.xyz + cellGrid.w * cellCount.xyz - origin) * inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float at = max(from, max(near.x, max(near.y, near.z)));
    float last = min(to, min(far.x, min(far.y, far.z)));
    ivec3 steps = ivec3(sign(inverse));
    ivec3 cell = clamp(ivec3((origin + at * direction - cellGrid.xyz) / cellGrid.w), ivec3(0), ivec3(cellCount.xyz) - 1);
    while (at < last) {
        vec3 sides = (cellGrid.xyz + vec3(cell + max(steps, 0)) * cellGrid.w - origin) * inverse;
        float end = max(min(last, min(sides.x, min(sides.y, sides.z))), at);
        float distance = crossingInCell(cell, origin, direction, at, end, isInside);
        if (distance < kNoCrossing) return fieldSurfaceAt(cell, origin + distance * direction, direction, distance);
        int axis = sides.x <= sides.y && sides.x <= sides.z ? 0 : sides.y <= sides.z ? 1 : 2;
        cell[axis] += steps[axis];
        if (cell[axis] < 0 || cell[axis] >= int(cellCount[axis])) break;
        at = end;
    }
    // Outside of the grid is no ball: a ray that is inside leaves the metaballs where the grid ends.
    none.distance = isInside && last < to ? max(last, from) : kNoCrossing;
    none.normal = -direction;
    return none;
}
