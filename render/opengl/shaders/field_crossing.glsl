// Where a ray of any direction crosses the surface of metaballs. Where the field is surely on the ray's side it is not
// evaluated. In the subcells that the surface may pass through it is sampled at four distances at a time, because
// fetching a ball costs more than evaluating its kernel.

// Of FieldCells and BallCells: the number of subcells along a side of a cell, and where the next three lists begin; then
// the first ball of each cell, x fastest; the side of each cell, or the number of its subcells; two numbers a subcell,
// its first place in the last list and its side, or the number of its balls; the balls of subcells.
uniform isamplerBuffer cellNumbers;
// Two texels a ball: center (m) and peak, color and squared slope (1/m^2). Two more for an ellipsoid: the entries xx, yy,
// zz, xy, xz and yz of its form (1/m^2).
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

const int kAllInside = -2;
const int kFirstBegin = 4;

int numberOf(int index) {
    return texelFetch(cellNumbers, index).x;
}

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
    return mat3(texelFetch(cellBalls, kBallTexels * ball + 1).w);
}
#endif

// A part of a ray in a cell. Its balls are `count` from the place `first` in cellNumbers on or, if the cell is on one
// side of the threshold, those of the cells around.
struct RayPart {
    float from;
    float to;
    ivec3 cell;
    int first;
    int count;
};

// The field and its derivative at four distances.
struct FieldSamples {
    vec4 field;
    vec4 slope;
};

FieldSamples sampleField(RayPart part, vec3 origin, vec3 direction, vec4 distances) {
    FieldSamples found = FieldSamples(vec4(0.0), vec4(0.0));
    for (int k = part.first; k < part.first + part.count; ++k) {
        int index = numberOf(k);
        vec4 ball = texelFetch(cellBalls, kBallTexels * index);
        mat3 form = formOf(index);
        vec3 toCenter = ball.xyz - origin;
        vec3 turned = form * direction;
        float square = dot(direction, turned);
        float closest = dot(toCenter, turned) / square;
        vec3 off = toCenter - direction * closest;
        float w = ball.w - dot(off, form * off);
        if (w <= 0.0) continue;
        vec4 along = distances - closest;
        vec4 root = max(w - square * along * along, 0.0);
        found.field += root * root;
        found.slope -= 4.0 * square * root * along;
    }
    return found;
}

// The index of the first of four samples that is across the threshold; 4 if none is.
int firstAcross(FieldSamples at, bool isInside) {
    bvec4 isBelow = lessThan(at.field, vec4(castField.x));
    bvec4 isAcross = isInside ? isBelow : not(isBelow);
    return isAcross.x ? 0 : isAcross.y ? 1 : isAcross.z ? 2 : isAcross.w ? 3 : 4;
}

// The distance between two at which the field crosses the threshold, the first of them being on the ray's side.
float refinedCrossing(RayPart part, vec3 origin, vec3 direction, float from, float to, bool isInside) {
    for (int pass = 0; pass < 5; ++pass) {
        float share = (to - from) / 5.0;
        FieldSamples at = sampleField(part, origin, direction, from + share * vec4(1.0, 2.0, 3.0, 4.0));
        int first = firstAcross(at, isInside);
        to = first < 4 ? from + share * float(first + 1) : to;
        from = to - share;
    }
    return 0.5 * (from + to);
}

// What is known of the field where a part of a ray begins.
struct FieldStart {
    bool isKnown;  // whether it is on the ray's side
    float slope;   // 0 if it has not been sampled
    float field;
};

// The distance at which the ray crosses the threshold within a subcell.
float crossingInSubcell(RayPart part, vec3 origin, vec3 direction, bool isInside, inout FieldStart start) {
    float sign = isInside ? -1.0 : 1.0;
    float begin = part.from;
    if (!start.isKnown) {
        FieldSamples at = sampleField(part, origin, direction, vec4(begin));
        if (firstAcross(at, isInside) < 4) return begin;
        start = FieldStart(true, at.slope.x, at.field.x);
    }
    while (begin < part.to) {
        float share = min(castField.y, 0.25 * (part.to - begin));
        vec4 distances = begin + share * vec4(1.0, 2.0, 3.0, 4.0);
        FieldSamples at = sampleField(part, origin, direction, distances);
        for (int k = 0; k < 4; ++k) {
            if (isInside ? at.field[k] < castField.x : at.field[k] >= castField.x)
                return refinedCrossing(part, origin, direction, begin, distances[k], isInside);
            // Where the field turns back between two samples it may have been across: at the secant of its slopes.
            if (sign * start.slope > 0.0 && sign * at.slope[k] < 0.0) {
                float turn = (distances[k] - begin) * (start.slope / (start.slope - at.slope[k]));
                float extreme = start.field + 0.5 * start.slope * turn;
                if (isInside ? extreme < castField.x : extreme >= castField.x)
                    return refinedCrossing(part, origin, direction, begin, begin + turn, isInside);
            }
            begin = distances[k];
            start.slope = at.slope[k];
            start.field = at.field[k];
        }
        if (share < castField.y) break;
    }
    return kNoCrossing;
}

void addBall(inout FieldCrossing found, inout float kernels, int k, vec3 point) {
    vec4 ball = texelFetch(cellBalls, kBallTexels * k);
    vec3 off = point - ball.xyz;
    vec3 turned = formOf(k) * off;
    float root = ball.w - dot(off, turned);
    if (root <= 0.0) return;
    found.normal += root * turned;
    found.color += root * root * texelFetch(cellBalls, kBallTexels * k + 1).rgb;
    kernels += root * root;
#ifdef PARTICLE_SKY
    uvec4 words = texelFetch(cellSky, k);
    found.skyPlus += root * root * unpackSky(words.y);
    found.skyMinus += root * root * unpackSky(words.z);
#endif
}

FieldCrossing fieldSurfaceAt(RayPart part, vec3 point, vec3 direction, float distance) {
    FieldCrossing found = FieldCrossing(distance, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    float kernels = 0.0;
    for (int k = part.first; k < part.first + part.count; ++k) addBall(found, kernels, numberOf(k), point);
    if (part.count <= 0) {
        ivec3 low = max(part.cell - 1, ivec3(0));
        ivec3 high = min(part.cell + 1, ivec3(cellCount.xyz) - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int k = numberOf(kFirstBegin + ballCellIndex(low.x, y, z)),
                         end = numberOf(kFirstBegin + ballCellIndex(high.x, y, z) + 1);
                     k < end; ++k)
                    addBall(found, kernels, k, point);
    }
    float square = dot(found.normal, found.normal);
    found.normal = square > 0.0 ? found.normal * inversesqrt(square) : -direction;
    float inverse = kernels > 0.0 ? 1.0 / kernels : 0.0;
    found.color *= inverse;
    found.skyPlus *= inverse;
    found.skyMinus *= inverse;
    return found;
}

// A walk through the cells of a grid (Amanatides and Woo 1987).
struct GridWalk {
    ivec3 cell;
    vec3 next;     // distances at which the ray leaves the cell along each axis
    vec3 spacing;  // between such distances
    ivec3 steps;
    float from;    // distances at which the ray enters the cell and leaves the grid
    float last;
};

// @param inverse  1 / direction, finite
GridWalk gridWalk(vec3 low, float side, ivec3 count, vec3 origin, vec3 direction, vec3 inverse, float from, float to) {
    GridWalk walk;
    vec3 a = (low - origin) * inverse;
    vec3 b = a + side * vec3(count) * inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    walk.from = max(from, max(near.x, max(near.y, near.z)));
    walk.last = min(to, min(far.x, min(far.y, far.z)));
    walk.steps = ivec3(sign(inverse));
    walk.spacing = abs(side * inverse);
    walk.cell = clamp(ivec3((origin + walk.from * direction - low) / side), ivec3(0), count - 1);
    walk.next = a + vec3(walk.cell + max(walk.steps, 0)) * (side * inverse);
    return walk;
}

float endOfCell(GridWalk walk) {
    return max(min(walk.last, min(walk.next.x, min(walk.next.y, walk.next.z))), walk.from);
}

void goOn(inout GridWalk walk, ivec3 count) {
    float end = endOfCell(walk);
    int axis = walk.next.x <= walk.next.y ? (walk.next.x <= walk.next.z ? 0 : 2) : (walk.next.y <= walk.next.z ? 1 : 2);
    walk.cell[axis] += walk.steps[axis];
    walk.next[axis] += walk.spacing[axis];
    walk.from = walk.cell[axis] < 0 || walk.cell[axis] >= count[axis] ? walk.last : end;
}

// The distance at which a ray crosses the threshold in a block, the cell of a part. Sets the part to that in which it
// does.
float crossingInBlock(inout RayPart part, int block, vec3 origin, vec3 direction, vec3 inverse, bool isInside,
                      inout FieldStart start) {
    int along = numberOf(0);
    ivec3 count = ivec3(along);
    int subcells = numberOf(2) + 2 * block * along * along * along;
    float side = cellGrid.w / float(along);
    vec3 low = cellGrid.xyz + cellGrid.w * vec3(part.cell);
    GridWalk walk = gridWalk(low, side, count, origin, direction, inverse, part.from, part.to);
    for (; walk.from < walk.last; goOn(walk, count)) {
        int subcell = subcells + 2 * ((walk.cell.z * along + walk.cell.y) * along + walk.cell.x);
        part.count = numberOf(subcell + 1);
        part.from = walk.from;
        part.to = endOfCell(walk);
        if (part.count > 0) {
            part.first = numberOf(3) + numberOf(subcell);
            float distance = crossingInSubcell(part, origin, direction, isInside, start);
            if (distance < kNoCrossing) return distance;
        } else {
            if ((part.count == kAllInside) != isInside) return walk.from;
            start = FieldStart(true, 0.0, 0.0);
        }
    }
    return kNoCrossing;
}

// The first point of a part of a ray at which the field is on the other side of the threshold than the ray.
FieldCrossing findCrossing(vec3 origin, vec3 direction, float from, float to, bool isInside) {
    FieldCrossing none = FieldCrossing(kNoCrossing, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    if (cellCount.w == 0.0) return none;
    vec3 inverse = 1.0 / mix(max(direction, 1.0e-30), min(direction, -1.0e-30), lessThan(direction, vec3(0.0)));
    ivec3 count = ivec3(cellCount.xyz);
    int blocks = numberOf(1);
    FieldStart start = FieldStart(false, 0.0, 0.0);
    GridWalk walk = gridWalk(cellGrid.xyz, cellGrid.w, count, origin, direction, inverse, from, to);
    for (; walk.from < walk.last; goOn(walk, count)) {
        int block = numberOf(blocks + ballCellIndex(walk.cell.x, walk.cell.y, walk.cell.z));
        RayPart part = RayPart(walk.from, endOfCell(walk), walk.cell, 0, block);
        float distance = kNoCrossing;
        if (block >= 0) {
            distance = crossingInBlock(part, block, origin, direction, inverse, isInside, start);
        } else {
            if ((block == kAllInside) != isInside) distance = walk.from;
            start = FieldStart(true, 0.0, 0.0);
        }
        if (distance < kNoCrossing) return fieldSurfaceAt(part, origin + distance * direction, direction, distance);
    }
    // Outside of the grid is no ball: a ray that is inside leaves the metaballs where the grid ends.
    none.distance = isInside && walk.last < to ? max(walk.last, from) : kNoCrossing;
    none.normal = -direction;
    return none;
}
