// The way of a ray through transparent bodies to what is seen behind them: section 6 of shading_model.h, as in
// render/cpu/transparency/light_path.cpp.
#include "field_crossing.glsl"
#include "solid_hits.glsl"

// The inside of a body.
struct Medium {
    float transparency;
    float index;
    float attenuation;  // 1/m
};

const Medium kAir = Medium(0.0, 1.0, 0.0);
const float kDarkestMedium = 0.001;
const float kFaintest = 0.001;
const int kMostSurfaces = 12;
const int kGlassGloss = 10;
const float kLongestLayer = 20.0;
const int kInAir = -1;
const int kInMetaballs = -2;  // other places are numbers of meshes

Medium mediumOfMetaballs() {
    return Medium(metaballMedium.x, metaballMedium.y, metaballMedium.z);
}

Medium mediumOfMesh(int mesh) {
    vec4 second = texelFetch(meshMedia, 2 * mesh + 1);
    return Medium(texelFetch(meshMedia, 2 * mesh).w, second.x, second.y);
}

Medium mediumAt(int place) {
    if (place == kInMetaballs) return mediumOfMetaballs();
    if (place == kInAir) return kAir;
    return mediumOfMesh(place);
}

// The share of light that a surface between two media mirrors, by Schlick's approximation.
float mirroredShare(float from, float to, float cosine) {
    float root = (from - to) / (from + to);
    float headOn = root * root;
    float ratio = from / to;
    float thinner = from > to ? sqrt(max(0.0, 1.0 - ratio * ratio * (1.0 - cosine * cosine))) : cosine;
    float away = 1.0 - thinner;
    float square = away * away;
    return from == to ? 0.0 : headOn + (1.0 - headOn) * (square * square * away);
}

vec3 surroundingsToward(float up) {
    return up > 0.0 ? mix(surroundingsHorizon.rgb, surroundingsTop.rgb, up * (2.0 - up))
                    : mix(surroundingsHorizon.rgb, surroundingsBottom.rgb, min(1.0, -4.0 * up));
}

// A ray and where it is.
struct Walk {
    vec3 origin;
    vec3 direction;
    vec3 weight;
    vec3 mirrored;    // light that later surfaces mirror
    float way;        // length of the way so far
    int place;        // kInAir, kInMetaballs or a mesh
    vec3 color;       // of the medium
    float searchFrom; // distance from which metaballs are searched for
};

// A surface that the ray comes to.
struct NextSurface {
    float distance;
    int id;      // kHitBackground if there is none
    vec3 normal; // on the side of the ray
    vec3 color;
    int mesh;    // -1 if it is none
    bool isInner;
};

// Goes through a surface, or is mirrored by it where it cannot be refracted.
// @param layer  length of way through a thin layer behind the surface that counts as metaballs
void pass(inout Walk walk, vec3 normal, int place, vec3 color, float layer) {
    float from = mediumAt(walk.place).index;
    float to = mediumAt(place).index;
    float cosine = clamp(-dot(normal, walk.direction), 0.0, 1.0);
    float ratio = from / to;
    float squaredSine = ratio * ratio * (1.0 - cosine * cosine);
    if (squaredSine >= 1.0) {
        walk.direction = normalize(walk.direction + 2.0 * cosine * normal);
        walk.searchFrom = castField.z;
        return;
    }
    walk.weight *= 1.0 - mirroredShare(from, to, cosine);
    walk.direction = normalize(ratio * walk.direction + (ratio * cosine - sqrt(1.0 - squaredSine)) * normal);
    walk.place = place;
    walk.color = color;
    walk.searchFrom = max(castField.z, layer);
}

bool isTransparentSurface(int id, int mesh) {
    if (id >= kHitMetaballs) return metaballMedium.x > 0.0;
    return mesh >= 0 && mediumOfMesh(mesh).transparency > 0.0;
}

// Whether the layer before a solid is so thin that the bodies on both sides are in contact.
bool isThin(Walk walk, float from, SolidHit solid) {
    vec3 normal = solidSurface(solid, walk.origin, walk.direction).normal;
    float length = solid.distance - from;
    return length * abs(dot(normal, walk.direction)) < lightU.w && length < kLongestLayer * lightU.w;
}

// The opaque solid or ground that the mesh stands on where the ray leaves it, or else the mesh's own surface.
SolidHit beyondContact(Walk walk, SolidHit own) {
    SolidSurface surface = solidSurface(own, walk.origin, walk.direction);
    if (!isTransparentSurface(own.id, surface.mesh)) return own;
    SolidHit next = nearestSolid(walk.origin, walk.direction, own.distance, own.distance + kLongestLayer * lightU.w);
    if (next.id == kHitBackground) return own;
    int mesh = solidSurface(next, walk.origin, walk.direction).mesh;
    return !isTransparentSurface(next.id, mesh) && isThin(walk, own.distance, next) ? next : own;
}

NextSurface nextSurface(Walk walk, out FieldCrossing crossing) {
    SolidHit solid = nearestSolid(walk.origin, walk.direction, 1.0e-5 * length(walk.origin), 1.0e30);
    bool isInMesh = walk.place >= 0;
    crossing.distance = kNoCrossing;
    if (!isInMesh) {
        bool isInside = walk.place == kInMetaballs;
        crossing = findCrossing(walk.origin, walk.direction, walk.searchFrom, solid.distance, isInside);
        bool isContact =
            isInside && solid.id != kHitBackground && crossing.distance < solid.distance &&
            isThin(walk, crossing.distance, solid);
        if (crossing.distance < solid.distance && !isContact)
            return NextSurface(crossing.distance, kHitMetaballs, isInside ? -crossing.normal : crossing.normal,
                               crossing.color, -1, false);
    } else if (solid.id != kHitBackground) {
        solid = beyondContact(walk, solid);
    }
    if (solid.id == kHitBackground) return NextSurface(0.0, kHitBackground, vec3(0.0), vec3(0.0), -1, false);
    SolidSurface surface = solidSurface(solid, walk.origin, walk.direction);
    return NextSurface(solid.distance, solid.id, surface.normal, surface.color, surface.mesh, surface.isInner);
}

// Goes on to what is behind a transparent surface.
void passInto(inout Walk walk, NextSurface next) {
    int place = next.mesh;
    vec3 color = next.color;
    float layer = 0.0;
    if (next.id >= kHitMetaballs) {
        place = walk.place == kInMetaballs ? kInAir : kInMetaballs;
    } else if (next.isInner) {
        place = kInAir;
        if (metaballMedium.x > 0.0) {
            float cosine = max(-dot(next.normal, walk.direction), 1.0 / kLongestLayer);
            FieldCrossing found = findCrossing(walk.origin, walk.direction, 0.0, lightU.w / cosine, false);
            if (found.distance < kNoCrossing) {
                place = kInMetaballs;
                color = found.color;
                layer = found.distance + castField.z;
            }
        }
    }
    if (mediumAt(walk.place).index == kAir.index) {
        float cosine = -dot(next.normal, walk.direction);
        float share = mirroredShare(kAir.index, mediumAt(place).index, clamp(cosine, 0.0, 1.0));
        walk.mirrored += walk.weight * share * surroundingsToward(walk.direction.y + 2.0 * cosine * next.normal.y);
    }
    pass(walk, next.normal, place, color, layer);
}

// The end of a ray as a point to be shaded.
// @param crossing  the last of metaballs
Point endOf(Walk walk, NextSurface next, FieldCrossing crossing, float depth) {
    Point at;
    at.position = walk.origin;
    at.normal = next.normal;
    at.albedo = next.color;
    at.toEye = -walk.direction;
    at.depth = depth + walk.way;
    bool isSphere = next.id >= 0 && next.id < int(counts.x);
    at.isParticle = next.id >= kHitMetaballs || isSphere ? 1.0 : 0.0;
    at.light = 1.0;
    at.sky = vec3(1.0);
    at.glow = vec3(0.0);
    at.mesh = next.mesh;
#ifdef LIGHT_TINT
    at.tint = vec3(1.0);
#endif
    at.bodyShare = 1.0;
    at.added = vec3(0.0);
#ifdef PARTICLE_SKY
    vec3 plus = crossing.skyPlus;
    vec3 minus = crossing.skyMinus;
#ifdef SPHERES
    if (isSphere) {
        uvec4 attributes = texelFetch(sphereAttributes, next.id);
        plus = unpackSky(attributes.y);
        minus = unpackSky(attributes.z);
    }
#endif
    vec3 reflected = reflect(walk.direction, at.normal);
    vec3 visible = vec3(skyVisibilityToward(at.normal, plus, minus), skyVisibilityToward(at.normal, minus, plus),
                        skyVisibilityToward(reflected, plus, minus));
    at.sky = at.isParticle > 0.0 ? visible : at.sky;
#endif
    return at;
}

// Follows a ray from its first transparent surface on.
// @param first  that surface
// @param id     receives what the ray hits at its end
// @param end    receives the point there
Walk followRay(Point first, int firstId, out int id, out Point end) {
    Walk walk = Walk(first.position, -first.toEye, vec3(1.0), vec3(0.0), 0.0, kInAir, vec3(1.0), 0.0);
    pass(walk, first.normal, firstId >= kHitMetaballs ? kInMetaballs : first.mesh, first.albedo, 0.0);
    id = kHitBackground;
    for (int passed = 1; passed < kMostSurfaces; ++passed) {
        if (max(walk.weight.x, max(walk.weight.y, walk.weight.z)) < kFaintest) break;
        FieldCrossing crossing;
        NextSurface next = nextSurface(walk, crossing);
        if (next.id == kHitBackground) break;
        vec3 color = clamp(walk.color, kDarkestMedium, 1.0);
        walk.weight *= exp2(log2(color) * (next.distance * mediumAt(walk.place).attenuation));
        walk.origin += next.distance * walk.direction;
        walk.way += next.distance;
        if (!isTransparentSurface(next.id, next.mesh)) {
            // Samples of meshes and triangles have the same numbers.
            id = next.id;
            end = endOf(walk, next, crossing, first.depth);
            break;
        }
        passInto(walk, next);
    }
    return walk;
}

// What a transparent mesh mirrors of the light and its surroundings.
vec3 mirroredByMesh(Point at) {
    float index = mediumOfMesh(at.mesh).index;
    float cosine = dot(at.normal, at.toEye);
    float up = 2.0 * cosine * at.normal.y - at.toEye.y;
    vec3 color = mirroredShare(kAir.index, index, clamp(cosine, 0.0, 1.0)) * surroundingsToward(up);
    if (dot(at.normal, toLight.xyz) <= 0.0) return color;
    vec3 halfway = normalize(toLight.xyz + at.toEye);
    float peak = max(dot(at.normal, halfway), 0.0);
    for (int squaring = 0; squaring < kGlassGloss; ++squaring) peak *= peak;
    float norm = (exp2(float(kGlassGloss)) + 8.0) / 8.0;
    float share = mirroredShare(kAir.index, index, clamp(dot(at.toEye, halfway), 0.0, 1.0));
    return color + lightColor.rgb * (at.light * share * norm * peak);
}

// The row in which the eye sees a direction. @param own  that of the ray from the eye
float backgroundRow(vec3 direction, float own) {
#ifdef PERSPECTIVE
    float height = 2.0 / image.y;
    float ahead = dot(direction, forward.xyz);
    float upward = dot(direction, up.xyz);
    if (ahead <= 0.0) return upward > 0.0 ? 0.0 : height;
    return clamp(0.5 * (1.0 - (upward - ahead * imageMiddle().y) / (ahead * image.w)), 0.0, 1.0) * height;
#else
    return own;
#endif
}
