// What a ray sees, as a point to be shaded. Which thing it is was found on the CPU; the numbers are those of first_hits.h.
uniform samplerBuffer spheres;          // center and radius
uniform samplerBuffer boxes;            // minimum, maximum, color per box
uniform usamplerBuffer sphereLooks;     // colour, openness along +x, +y, +z, along -x, -y, -z, 1 for particles and 0 for obstacles
uniform usamplerBuffer fieldSamples;    // view depth bits (0: no hit), octahedral normal, colour, openness along the normal,
                                        // against it and along the mirrored ray

const int kBackground = -1;
const int kGround = -2;
const int kBoxes = 1 << 28;
const int kField = 1 << 29;

// Whether all pixels show things of one kind, so that none is asked for its own.
#ifdef SINGLE
const bool kSingle = true;
#else
const bool kSingle = false;
#endif

vec3 octahedralNormal(uint bits) {
    vec2 folded = vec2(float(bits & 0xffffu), float(bits >> 16)) * (1.0 / 32767.5) - 1.0;
    vec3 normal = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
    float under = max(-normal.z, 0.0);
    normal.xy -= under * vec2(normal.x >= 0.0 ? 1.0 : -1.0, normal.y >= 0.0 ? 1.0 : -1.0);
    return normalize(normal);
}

// Square roots of the colour in 11, 11 and 10 bits: finer than an 8-bit sRGB step everywhere.
vec3 unpackColor(uint bits) {
    vec3 root = vec3(float(bits & 0x7ffu), float((bits >> 11) & 0x7ffu), float(bits >> 22)) * (1.0 / vec3(2047.0, 2047.0, 1023.0));
    return root * root;
}

vec3 unpackOpen(uint bits) {
    return vec3(float(bits & 0x3ffu), float((bits >> 10) & 0x3ffu), float((bits >> 20) & 0x3ffu)) * (1.0 / 1023.0);
}

float openAlong(vec3 direction, vec3 plus, vec3 minus) {
    return dot(direction * direction, mix(minus, plus, greaterThan(direction, vec3(0.0))));
}

// Of a sphere's six values.
vec3 openOfSphere(uvec4 look, vec3 normal, vec3 mirrored) {
    vec3 plus = unpackOpen(look.y);
    vec3 minus = unpackOpen(look.z);
    return vec3(openAlong(normal, plus, minus), openAlong(-normal, plus, minus), openAlong(mirrored, plus, minus));
}

// What id shows along this ray; the ray may miss it by the rounding at an outline, which clamps to the outline.
Point pointOn(int id, Ray ray) {
    Point point;
    float depth = 0.0;
    // Away from the light, so that the background looks for no shadow.
    point.normal = -frame.toLight.xyz;
    point.albedo = frame.groundColor.xyz;
    point.particle = 0.0;
    point.open = vec3(1.0);
#ifdef GROUND
    bool isGround = kSingle || id == kGround;
    depth = isGround ? (frame.groundColor.w - ray.origin.y) / ray.direction.y : depth;
    point.normal = isGround ? vec3(0.0, 1.0, 0.0) : point.normal;
#endif
#ifdef SPHERES
    bool isSphereId = id >= 0 && id < kBoxes;
    bool isSphere = kSingle || isSphereId;
    int place = isSphereId ? id : 0;
    vec4 sphere = texelFetch(spheres, place);
    uvec4 look = texelFetch(sphereLooks, place);
    vec3 toCenter = sphere.xyz - ray.origin;
    float closest = dot(toCenter, ray.direction) * ray.inverseSquare;
    vec3 off = closest * ray.direction - toCenter;
    float halfChord = sqrt(max(sphere.w * sphere.w - dot(off, off), 0.0) * ray.inverseSquare);
    float sphereDepth = max(closest - halfChord, 0.0);
    depth = isSphere ? sphereDepth : depth;
    point.normal = isSphere ? normalize(off + (sphereDepth - closest) * ray.direction) : point.normal;
    point.albedo = isSphere ? unpackColor(look.x) : point.albedo;
#ifdef OBSTACLES
    float particle = float(look.w);
#else
    const float particle = 1.0;
#endif
    point.particle = isSphere ? particle : point.particle;
#endif
#ifdef BOXES
    bool isBox = id >= kBoxes && id < kField;
    int box = isBox ? (id - kBoxes) >> 4 : 0;
    int side = id & 7;
    vec3 axis = vec3(equal(ivec3(side >> 1), ivec3(0, 1, 2)));
    vec3 face = (side & 1) == 0 ? axis : -axis;
    vec3 bound = texelFetch(boxes, 3 * box + ((side & 1) == 0 ? 1 : 0)).xyz;
    // The ray of an outline's middle may run along the face.
    float slope = dot(ray.direction, axis);
    float faceDepth = dot(bound - ray.origin, axis) / (abs(slope) > 1.0e-20 ? slope : 1.0e-20);
    depth = isBox ? ((id & 8) == 0 ? clamp(faceDepth, 0.0, 1.0e30) : 0.0) : depth;
    point.normal = isBox ? face : point.normal;
    point.albedo = isBox ? texelFetch(boxes, 3 * box + 2).xyz : point.albedo;
#endif
#ifdef FIELD
    bool isField = kSingle || id >= kField;
    uvec4 texel = texelFetch(fieldSamples, max(id - kField, 0));
    depth = isField ? uintBitsToFloat(texel.x) : depth;
    point.normal = isField ? octahedralNormal(texel.y) : point.normal;
    point.albedo = isField ? unpackColor(texel.z) : point.albedo;
    point.particle = isField ? 1.0 : point.particle;
#endif
    point.position = ray.origin + depth * ray.direction;
    point.depth = id == kBackground ? -1.0 : depth;
#ifdef OPEN
    vec3 mirrored = reflect(ray.direction * sqrt(ray.inverseSquare), point.normal);
#ifdef SPHERES
    point.open = isSphere && particle > 0.0 ? openOfSphere(look, point.normal, mirrored) : point.open;
#endif
#ifdef FIELD
    point.open = isField ? unpackOpen(texel.w) : point.open;
#endif
#endif
    return point;
}

// reach: what light and sky reach it, as picture_samples.h has it; at: pixels from the top left corner of the picture.
vec3 colorOf(int id, int reach, vec2 at) {
    vec3 behind = background(at.y);
#if defined(GROUND) || defined(SPHERES) || defined(BOXES) || defined(FIELD)
    Ray ray = rayThrough(at);
    Point point = pointOn(id, ray);
    point.lit = float((reach >> 4) & 0x3fff) * (1.0 / 16383.0);
#ifdef OCCLUSION
    point.open.x = point.particle > 0.0 ? point.open.x : float((reach >> 18) & 0x3fff) * (1.0 / 16383.0);
#endif
    vec3 color = shade(point, -ray.direction * sqrt(ray.inverseSquare));
#ifdef GROUND
    color = kSingle || id == kGround ? mix(color, behind, groundFade(point.position)) : color;
#endif
    color = !kSingle && id == kBackground ? behind : color;
    return clamp(color, 0.0, 1.0);
#else
    return clamp(behind, 0.0, 1.0);
#endif
}

#ifdef LINES
uniform samplerBuffer lines;    // what line_cover.h lays over the pixels of a tile

vec3 underLines(vec3 color, int place) {
    vec4 over = texelFetch(lines, place);
    return color * (1.0 - over.w) + over.xyz;
}
#endif
