// One tile of the picture: what each sample of a pixel sees first (exact rays against the tile's spheres, the boxes, the ground and
// the samples that the CPU cast of the metaballs), then one shading for every surface that a pixel shows, at the middle of the
// samples that show it. SAMPLES is 1 or 4; the other names are defined for what the view contains.
uniform samplerBuffer tileSpheres;      // center and radius, tile after tile, front to back
uniform isamplerBuffer tileSphereIds;   // index into sphereColors, likewise
uniform samplerBuffer sphereColors;     // colour, specular
uniform usamplerBuffer fieldSamples;    // view depth bits (0: no hit), octahedral normal, colour, first of the extra samples or 0

flat in ivec4 tile;
flat in ivec4 tileExtra;
out vec4 pixel;

const int kBackground = -1;
const int kGround = -2;
const int kBoxes = 1 << 28;     // ids from here on are boxes,
const int kField = 1 << 29;     // and from here on samples of the metaballs' surface; below, places in tileSpheres

// A rotated grid: four different rows and columns, so edges near the horizontal and the vertical get four steps, not two.
const vec2 kOffsets[4] = vec2[4](vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375));

vec2 offsetOf(int s) { return SAMPLES == 1 ? picture.zw : kOffsets[s]; }

float depths[SAMPLES];
int ids[SAMPLES];

void lookAtSpheres(Ray rays[SAMPLES]) {
    float farthest = 0.0;
    for (int s = 0; s < SAMPLES; ++s) farthest = max(farthest, depths[s]);
    for (int k = tile.z; k < tile.w; ++k) {
        vec4 sphere = texelFetch(tileSpheres, k);
        // Front to back: what comes later on the list is behind what is already seen.
        if (dot(sphere.xyz, forward.xyz) - sphere.w > farthest) break;
        farthest = 0.0;
        for (int s = 0; s < SAMPLES; ++s) {
            float depth = hitSphere(rays[s], sphere);
            ids[s] = depth < depths[s] ? k : ids[s];
            depths[s] = min(depth, depths[s]);
            farthest = max(farthest, depths[s]);
        }
    }
}

void lookAtBoxes(Ray rays[SAMPLES]) {
    for (int box = 0; box < counts.x; ++box) {
        vec3 minimum = texelFetch(boxes, 3 * box).xyz;
        vec3 maximum = texelFetch(boxes, 3 * box + 1).xyz;
        for (int s = 0; s < SAMPLES; ++s) {
            vec3 normal;
            float depth = hitBox(rays[s], minimum, maximum, normal);
            ids[s] = depth < depths[s] ? kBoxes + box : ids[s];
            depths[s] = min(depth, depths[s]);
        }
    }
}

void lookAtGround(Ray rays[SAMPLES]) {
    for (int s = 0; s < SAMPLES; ++s) {
        float depth = hitGround(rays[s]);
        ids[s] = depth < depths[s] ? kGround : ids[s];
        depths[s] = min(depth, depths[s]);
    }
}

void lookAtField() {
    ivec2 local = ivec2(gl_FragCoord.xy) - 16 * tile.xy;
    int middle = tileExtra.x * 256 + local.y * 16 + local.x;
    int extra = int(texelFetch(fieldSamples, middle).w);
    for (int s = 0; s < SAMPLES; ++s) {
        int place = SAMPLES == 1 || extra == 0 ? middle : extra + s;
        float depth = uintBitsToFloat(texelFetch(fieldSamples, place).x);
        bool nearer = depth > 0.0 && depth < depths[s];
        ids[s] = nearer ? kField + place : ids[s];
        depths[s] = nearer ? depth : depths[s];
    }
}

vec3 octahedralNormal(uint bits) {
    vec2 folded = vec2(float(bits & 0xffffu), float(bits >> 16)) / 32767.5 - 1.0;
    vec3 normal = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
    float under = max(-normal.z, 0.0);
    normal.xy -= under * vec2(normal.x >= 0.0 ? 1.0 : -1.0, normal.y >= 0.0 ? 1.0 : -1.0);
    return normalize(normal);
}

// Square roots of the colour in 11, 11 and 10 bits: finer than an 8-bit sRGB step everywhere.
vec3 unpackColor(uint bits) {
    vec3 root = vec3(float(bits & 0x7ffu), float((bits >> 11) & 0x7ffu), float(bits >> 22)) / vec3(2047.0, 2047.0, 1023.0);
    return root * root;
}

// What id shows along this ray; the ray may miss it by the rounding at an outline, which clamps to the outline.
Point pointOn(int id, Ray ray) {
    Point point;
    float depth = 0.0;
    // Away from the light, so that the background looks for no shadow.
    point.normal = -toLight.xyz;
    point.albedo = groundColor.xyz;
    point.particle = 0.0;
    point.open = vec3(1.0);
#ifdef GROUND
    depth = id == kGround ? (groundColor.w - ray.origin.y) / ray.direction.y : depth;
    point.normal = id == kGround ? vec3(0.0, 1.0, 0.0) : point.normal;
#endif
#ifdef SPHERES
    bool isSphere = id >= 0 && id < kBoxes;
    int place = isSphere ? id : 0;
    vec4 sphere = texelFetch(tileSpheres, place);
    int sphereId = texelFetch(tileSphereIds, place).x;
    vec4 look = texelFetch(sphereColors, sphereId);
    vec3 toCenter = sphere.xyz - ray.origin;
    float closest = dot(toCenter, ray.direction) * ray.inverseSquare;
    vec3 off = closest * ray.direction - toCenter;
    float halfChord = sqrt(max(sphere.w * sphere.w - dot(off, off), 0.0) * ray.inverseSquare);
    float sphereDepth = max(closest - halfChord, 0.0);
    depth = isSphere ? sphereDepth : depth;
    point.normal = isSphere ? normalize(off + (sphereDepth - closest) * ray.direction) : point.normal;
    point.albedo = isSphere ? look.xyz : point.albedo;
    point.particle = isSphere ? look.w : point.particle;
#endif
#ifdef BOXES
    bool isBox = id >= kBoxes && id < kField;
    int box = isBox ? id - kBoxes : 0;
    vec3 face;
    float boxDepth = hitBox(ray, texelFetch(boxes, 3 * box).xyz, texelFetch(boxes, 3 * box + 1).xyz, face);
    depth = isBox ? min(boxDepth, 1.0e30) : depth;
    point.normal = isBox ? face : point.normal;
    point.albedo = isBox ? texelFetch(boxes, 3 * box + 2).xyz : point.albedo;
#endif
#ifdef FIELD
    bool isField = id >= kField;
    uvec4 texel = texelFetch(fieldSamples, isField ? id - kField : 0);
    depth = isField ? uintBitsToFloat(texel.x) : depth;
    point.normal = isField ? octahedralNormal(texel.y) : point.normal;
    point.albedo = isField ? unpackColor(texel.z) : point.albedo;
    point.particle = isField ? 1.0 : point.particle;
#endif
    point.position = ray.origin + depth * ray.direction;
    point.pixelWidth = forward.w * (right.w > 0.5 ? depth : 1.0);
#ifdef OPEN
    vec3 mirrored = reflect(ray.direction * sqrt(ray.inverseSquare), point.normal);
#if defined(GROUND) && defined(OCCLUSION)
    point.open.x = id == kGround ? openOfGround(point.position) : point.open.x;
#endif
#ifdef OPEN_OBSTACLES
    bool isObstacle = point.particle == 0.0 && id >= 0;
    point.open.x = isObstacle ? openOfObstacle(point.position, point.normal) : point.open.x;
#endif
#ifdef SPHERES
    bool isParticle = isSphere && look.w > 0.0;
    point.open = isParticle ? openOfSphere(sphereId, point.normal, mirrored) : point.open;
#endif
#ifdef FIELD
    point.open = isField ? openOfSample(isField ? id - kField : 0) : point.open;
#endif
#endif
    return point;
}

vec3 colorOf(int id, vec2 at) {
    vec3 behind = background(at.y);
#if defined(GROUND) || defined(SPHERES) || defined(BOXES) || defined(FIELD)
    Ray ray = rayThrough(at);
    Point point = pointOn(id, ray);
    vec3 color = shade(point, -ray.direction * sqrt(ray.inverseSquare));
#ifdef GROUND
    color = id == kGround ? mix(color, behind, groundFade(point.position)) : color;
#endif
    color = id == kBackground ? behind : color;
    return clamp(color, 0.0, 1.0);
#else
    return clamp(behind, 0.0, 1.0);
#endif
}

#ifdef LINES
vec3 drawLines(vec3 color, vec2 at) {
    for (int k = tileExtra.y; k < tileExtra.z; ++k) {
        int line = texelFetch(lineLists, k).x;
        LinePoint point = nearestOnLine(line, at);
        bool hidden = point.cover > 0.0 && hiddenByFlat(point);
        float shown = 0.0;
        for (int s = 0; s < SAMPLES; ++s) {
            bool flat_ = ids[s] < 0 || (ids[s] >= kBoxes && ids[s] < kField);
            shown += hidden || (!flat_ && depths[s] < point.depth * 0.999) ? 0.0 : 1.0 / float(SAMPLES);
        }
        color = mix(color, texelFetch(lines, 3 * line + 2).xyz, point.cover * shown);
    }
    return color;
}
#endif

vec3 colorOfPixel(vec2 corner) {
#if SAMPLES == 1
    return colorOf(ids[0], corner + offsetOf(0));
#else
    bool left[SAMPLES];
    for (int s = 0; s < SAMPLES; ++s) left[s] = true;
    vec3 sum = vec3(0.0);
    int shaded = 0;
    while (shaded < SAMPLES) {
        int id = 0;
        for (int s = SAMPLES - 1; s >= 0; --s) id = left[s] ? ids[s] : id;
        vec2 middle = vec2(0.0);
        int same = 0;
        for (int s = 0; s < SAMPLES; ++s) {
            bool taken = left[s] && ids[s] == id;
            middle += taken ? offsetOf(s) : vec2(0.0);
            same += taken ? 1 : 0;
            left[s] = left[s] && !taken;
        }
        sum += float(same) * colorOf(id, corner + middle / float(same));
        shaded += same;
    }
    return sum / float(SAMPLES);
#endif
}

void main() {
    vec2 corner = floor(gl_FragCoord.xy) + 0.5;
    Ray rays[SAMPLES];
    for (int s = 0; s < SAMPLES; ++s) {
        rays[s] = rayThrough(corner + offsetOf(s));
        depths[s] = kFar;
        ids[s] = kBackground;
    }
#ifdef GROUND
    lookAtGround(rays);
#endif
#ifdef BOXES
    lookAtBoxes(rays);
#endif
#ifdef FIELD
    lookAtField();
#endif
#ifdef SPHERES
    lookAtSpheres(rays);
#endif
#ifdef SURFACE
    pixel = vec4(pointOn(ids[0], rays[0]).normal, ids[0] == kBackground ? -1.0 : depths[0]);
    return;
#endif
    vec3 color = colorOfPixel(corner);
#ifdef LINES
    color = drawLines(color, corner + (SAMPLES == 1 ? picture.zw : vec2(0.0)));
#endif
#ifdef ENCODE
    pixel = vec4(encodeBytes(color), 1.0);
#else
    pixel = vec4(clamp(color, 0.0, 1.0), 1.0);
#endif
}
