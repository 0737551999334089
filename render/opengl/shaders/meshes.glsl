// What the samples of a pixel show of mesh obstacles, which mesh.frag has written for each of them.

uniform usampler2D meshHits0;  // view depth (0 without a mesh), normal, color, number of the mesh
#if SAMPLES != 1
uniform usampler2D meshHits1;
uniform usampler2D meshHits2;
uniform usampler2D meshHits3;
#endif

struct MeshSample {
    float depth;
    vec3 normal;
    uint color;
    uint mesh;
};

MeshSample meshSample(uvec4 words) {
    return MeshSample(uintBitsToFloat(words.x), unpackNormal(words.y), words.z, words.w);
}

#if SAMPLES == 1
MeshSample meshHit;

void addMeshes(inout SampleHits hits) {
    meshHit = meshSample(texelFetch(meshHits0, place, 0));
    addHit(hits, meshHit.depth > 0.0 ? meshHit.depth : kFarDepth, kHitMesh);
}

void setMesh(int index, inout Point at) {
    at.depth = meshHit.depth;
    at.normal = meshHit.normal;
    at.albedo = unpackColor(meshHit.color);
#ifdef TRANSPARENCY
    at.mesh = int(meshHit.mesh);
#endif
}

// The sample of a pixel that is nearest to a point of the picture, and where it lies.
uvec4 nearestMeshHit(ivec2 pixel, vec2 point, out vec2 at) {
    at = vec2(pixel) + 0.5 + sampleOffset.xy;
    return texelFetch(meshHits0, pixel, 0);
}
#else
MeshSample meshHitsOfPixel[4];
ivec4 meshSurfaces;  // for each sample the first sample that shows the same smooth surface

// Two samples show one smooth surface where the cosine between their normals is at least 0.95 and their depths differ
// by no more than twice what a surface at this angle to the view gets deeper within a pixel, as in
// render/cpu/raster/mesh_hits.cpp.
bool isSmooth(MeshSample a, MeshSample b) {
    float slope = 2.0 / max(abs(dot(a.normal, forward.xyz)), 0.05);
    return a.mesh == b.mesh && dot(a.normal, b.normal) >= 0.95 &&
           abs(a.depth - b.depth) <= slope * pixelWidthAt(min(a.depth, b.depth));
}

void addMeshes(inout SampleHits hits) {
    uvec4 first = texelFetch(meshHits0, place, 0);
    uvec4 second = texelFetch(meshHits1, place, 0);
    uvec4 third = texelFetch(meshHits2, place, 0);
    uvec4 fourth = texelFetch(meshHits3, place, 0);
    meshSurfaces = ivec4(0);
    if ((first.x | second.x | third.x | fourth.x) == 0u) return;
    MeshSample a = meshSample(first);
    MeshSample b = meshSample(second);
    MeshSample c = meshSample(third);
    MeshSample d = meshSample(fourth);
    meshHitsOfPixel = MeshSample[4](a, b, c, d);
    meshSurfaces.y = isSmooth(a, b) ? 0 : 1;
    meshSurfaces.z = isSmooth(a, c) ? 0 : isSmooth(b, c) ? meshSurfaces.y : 2;
    meshSurfaces.w = isSmooth(a, d) ? 0 : isSmooth(b, d) ? meshSurfaces.y : isSmooth(c, d) ? meshSurfaces.z : 3;
    vec4 depth = vec4(a.depth, b.depth, c.depth, d.depth);
    addHit(hits, mix(vec4(kFarDepth), depth, greaterThan(depth, vec4(0.0))), ivec4(kHitMesh) + meshSurfaces);
}

// The mean of the samples that show the same surface.
void setMesh(int index, inout Point at) {
    vec3 normal = vec3(0.0);
    float depth = 0.0;
    float count = 0.0;
    for (int s = 0; s < 4; ++s) {
        MeshSample one = meshHitsOfPixel[s];
        float weight = meshSurfaces[s] == index && one.depth > 0.0 ? 1.0 : 0.0;
        normal += weight * one.normal;
        depth += weight * one.depth;
        count += weight;
        at.albedo = s == index ? unpackColor(one.color) : at.albedo;
    }
    at.depth = depth / max(count, 1.0);
    at.normal = normalize(normal);
#ifdef TRANSPARENCY
    at.mesh = int(meshHitsOfPixel[index].mesh);
#endif
}

uvec4 nearestMeshHit(ivec2 pixel, vec2 point, out vec2 at) {
    vec2 off = point - vec2(pixel) - 0.5;
    vec4 away = (off.x - kOffsetX) * (off.x - kOffsetX) + (off.y - kOffsetY) * (off.y - kOffsetY);
    float least = min(min(away.x, away.y), min(away.z, away.w));
    int s = away.x == least ? 0 : away.y == least ? 1 : away.z == least ? 2 : 3;
    at = vec2(pixel) + 0.5 + vec2(kOffsetX[s], kOffsetY[s]);
    return s == 0   ? texelFetch(meshHits0, pixel, 0)
           : s == 1 ? texelFetch(meshHits1, pixel, 0)
           : s == 2 ? texelFetch(meshHits2, pixel, 0)
                    : texelFetch(meshHits3, pixel, 0);
}
#endif

#ifdef LINES
// View depth of the meshes at a point of the picture: of the plane through what the nearest sample shows.
float meshDepthAt(vec2 point) {
    ivec2 last = ivec2(round(2.0 / image.xy)) - 1;
    vec2 sampled;
    MeshSample found = meshSample(nearestMeshHit(clamp(ivec2(floor(point)), ivec2(0), last), point, sampled));
    Ray through = worldRay(imagePoint(sampled));
    Ray ray = worldRay(imagePoint(point));
    float slope = dot(ray.direction, found.normal);
    float steep = abs(slope) > 0.01 * length(ray.direction) ? slope : 1.0e30;
    vec3 off = through.origin + through.direction * found.depth - ray.origin - ray.direction * found.depth;
    return found.depth > 0.0 ? found.depth + dot(off, found.normal) / steep : kFarDepth;
}
#endif
