// What rays through points of the picture meet first of the ground, boxes and spheres. REAL, INTEGER and BOOLEAN are
// the types of one value for each ray: scalars for a single ray, vectors for the four samples of a pixel. The
// intersections are those of render/cpu/raster/primary_hits.cpp.

struct HITS {
    REAL depth;
    INTEGER id;
};

void addHit(inout HITS hits, REAL depth, INTEGER id) {
    BOOLEAN isNearer = less(depth, hits.depth);
    hits.depth = choose(isNearer, depth, hits.depth);
    hits.id = choose(isNearer, id, hits.id);
}

#ifdef GROUND
void addGround(inout HITS hits, REAL x, REAL y) {
#ifdef PERSPECTIVE
    REAL origin = REAL(0.0);
    REAL slope = forward.y + right.y * x + up.y * y;
#else
    REAL origin = right.y * x + up.y * y;
    REAL slope = REAL(forward.y);
#endif
    REAL depth = (forward.w - origin) / slope;
    BOOLEAN isHit = both(less(REAL(0.0), depth), less(depth, REAL(kFarDepth)));
    addHit(hits, choose(isHit, depth, REAL(kFarDepth)), INTEGER(kHitGround));
}
#endif

#ifdef BOXES
// The depths at which a ray enters and leaves the slab between two faces of a box, and which face it enters by.
void meetSlab(REAL origin, REAL direction, float low, float high, int axis, inout REAL entry, inout REAL exit,
              inout INTEGER entered, inout REAL gap, inout INTEGER nearest) {
    REAL slope = choose(less(REAL(1.0e-20), abs(direction)), direction, REAL(1.0e-20));
    REAL first = (low - origin) / slope;
    REAL second = (high - origin) / slope;
    REAL near = min(first, second);
    INTEGER plus = INTEGER(2 * axis);
    INTEGER minus = INTEGER(2 * axis + 1);
    entered = choose(less(entry, near), choose(less(REAL(0.0), slope), minus, plus), entered);
    entry = max(entry, near);
    exit = min(exit, max(first, second));
    // A ray that starts inside the box sees the face that is nearest to its start.
    REAL toLow = origin - low;
    REAL toHigh = high - origin;
    REAL least = min(toLow, toHigh);
    nearest = choose(less(least, gap), choose(less(toLow, toHigh), minus, plus), nearest);
    gap = min(gap, least);
}

// The boxes of a tile, which are listed front to back, until all later ones are behind what was hit.
void addBoxes(inout HITS hits, REAL x, REAL y) {
    int end = numberOf(kBoxBegins, tile + 1);
    int first = placeOf(kTileBoxes);
    for (int k = numberOf(kBoxBegins, tile); k < end; ++k) {
        vec4 low = texelFetch(listedTexels, first + 2 * k);
        vec4 high = texelFetch(listedTexels, first + 2 * k + 1);
        if (high.w > largest(hits.depth)) break;
        REAL entry = REAL(-kFarDepth);
        REAL exit = REAL(kFarDepth);
        REAL gap = REAL(kFarDepth);
        INTEGER entered = INTEGER(0);
        INTEGER nearest = INTEGER(0);
        for (int axis = 0; axis < 3; ++axis) {
            REAL off = right[axis] * x + up[axis] * y;
#ifdef PERSPECTIVE
            meetSlab(REAL(0.0), forward[axis] + off, low[axis], high[axis], axis, entry, exit, entered, gap, nearest);
#else
            meetSlab(off, REAL(forward[axis]), low[axis], high[axis], axis, entry, exit, entered, gap, nearest);
#endif
        }
        BOOLEAN isHit = both(lessEqual(entry, exit), lessEqual(REAL(0.0), exit));
        INTEGER face = choose(lessEqual(REAL(0.0), entry), entered, nearest + INTEGER(8));
        REAL depth = choose(isHit, max(entry, REAL(0.0)), REAL(kFarDepth));
        INTEGER id = face + INTEGER(kHitBox + 16 * int(low.w));
        // Of two boxes at the same depth the one with the lesser index counts.
        BOOLEAN isNearer = either(less(depth, hits.depth), both(lessEqual(depth, hits.depth), less(id, hits.id)));
        hits.depth = choose(isNearer, depth, hits.depth);
        hits.id = choose(isNearer, id, hits.id);
    }
}
#endif

HITS flatHits(REAL x, REAL y) {
    HITS hits = HITS(REAL(kFarDepth), INTEGER(kHitBackground));
#ifdef GROUND
    addGround(hits, x, y);
#endif
#ifdef BOXES
    addBoxes(hits, x, y);
#endif
    return hits;
}

#if defined(SPHERES) && defined(SAMPLE_HITS)
// The spheres of a tile, which are listed front to back, until all later ones are behind what was hit.
void addSpheres(inout HITS hits, REAL x, REAL y) {
    int k = numberOf(kSphereBegins, tile);
    int end = numberOf(kSphereBegins, tile + 1);
    int first = placeOf(kTileSpheres);
#ifdef PERSPECTIVE
    REAL inverseSquare = 1.0 / (x * x + y * y + 1.0);
#endif
    INTEGER entry = INTEGER(-1);  // of the list, that is hit
    for (; k < end; ++k) {
        vec4 sphere = texelFetch(listedTexels, first + k);
        if (sphere.z - sphere.w > largest(hits.depth)) break;
        // The intersection is measured from the point of the ray that is closest to the center, so that nothing
        // cancels, however far away the sphere is.
#ifdef PERSPECTIVE
        REAL closest = (sphere.x * x + sphere.y * y + sphere.z) * inverseSquare;
        REAL offX = sphere.x - closest * x;
        REAL offY = sphere.y - closest * y;
        REAL offZ = sphere.z - closest;
        REAL inside = sphere.w * sphere.w - (offX * offX + offY * offY + offZ * offZ);
        REAL halfChord = sqrt(max(inside, REAL(0.0)) * inverseSquare);
#else
        REAL closest = REAL(sphere.z);
        REAL offX = sphere.x - x;
        REAL offY = sphere.y - y;
        REAL inside = sphere.w * sphere.w - (offX * offX + offY * offY);
        REAL halfChord = sqrt(max(inside, REAL(0.0)));
#endif
        BOOLEAN isHit = both(less(REAL(0.0), inside), lessEqual(REAL(0.0), closest + halfChord));
        REAL depth = choose(isHit, max(closest - halfChord, REAL(0.0)), REAL(kFarDepth));
        BOOLEAN isNearer = less(depth, hits.depth);
        hits.depth = choose(isNearer, depth, hits.depth);
        entry = choose(isNearer, INTEGER(k), entry);
    }
#if SAMPLES == 1
    hits.id = entry >= 0 ? numberOf(kSphereItems, max(entry, 0)) : hits.id;
#else
    for (int s = 0; s < SAMPLES; ++s)
        hits.id[s] = entry[s] >= 0 ? numberOf(kSphereItems, max(entry[s], 0)) : hits.id[s];
#endif
}
#endif
