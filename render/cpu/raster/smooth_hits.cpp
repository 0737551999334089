// Merging with Highway, one pixel per lane; this file is compiled once per instruction set. Branches on what single
// pixels hit would be mispredicted too often.
#include "render/cpu/raster/smooth_hits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/raster/smooth_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/raster/simd_loads-inl.h"
#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

// Two triangles may belong to one smooth surface if the cosine between their normals is at least this. Chosen: a fold
// by as much, 18 degrees, cannot be told from a bend within one pixel.
constexpr float kSmooth = 0.95F;

M isTriangle(VI hitId) {
    return floatMask(hn::And(hitId > splatInt(kHitTriangle - 1), hitId < splatInt(kHitBox)));
}

/// What one sample of each pixel hits.
struct SampleHits {
    VI hitId;
    V depth;
    Words triangle;  // DrawnTriangle; of no meaning where something else is hit

    SampleHits(const DrawnMeshes& meshes, const TileRays& rays, std::size_t first)
        : hitId(loadInt(&rays.hitId[first])),
          depth(load(&rays.depth[first])),
          triangle(loadRecords(std::span(meshes.triangles), indexOf(hitId))) {}

    /// The index of the triangle that is hit; 0 where something else is hit.
    static VI indexOf(VI hitId) {
        return hn::IfThenElseZero(hn::RebindMask(DI(), isTriangle(hitId)), hitId - splatInt(kHitTriangle));
    }

    void replace(M where, const SampleHits& other) {
        const auto mask = hn::RebindMask(DI(), where);
        const auto take = [&](VI to, VI& from) { from = hn::IfThenElse(mask, to, from); };
        take(other.hitId, hitId);
        take(other.triangle.x, triangle.x);
        take(other.triangle.y, triangle.y);
        take(other.triangle.z, triangle.z);
        take(other.triangle.w, triangle.w);
    }
};

M haveSharedCorner(const Words& a, const Words& b) {
    const auto isOf = [&](VI corner) { return hn::Or(corner == b.x, hn::Or(corner == b.y, corner == b.z)); };
    return floatMask(hn::Or(isOf(a.x), hn::Or(isOf(a.y), isOf(a.z))));
}

/// The vectors of a list at the lanes' indices, for the lanes of a mask.
Vec3 gather(const std::vector<glm::vec3>& list, VI index, M where) {
    const VI first = hn::IfThenElseZero(hn::RebindMask(DI(), where), index + index + index);
    const auto component = [&](int axis) { return hn::GatherIndex(D(), &list.front().x + axis, first); };
    return {component(0), component(1), component(2)};
}

/// The sums of the normals at the corners of triangles, scaled to unit length.
/// @param where  lanes with triangles
Vec3 normalsOf(const DrawnMeshes& meshes, const Words& triangle, M where) {
    const Vec3 sum = gather(meshes.normals, triangle.x, where) + gather(meshes.normals, triangle.y, where) +
                     gather(meshes.normals, triangle.z, where);
    const V square = dot(sum, sum);
    const V length = hn::Sqrt(square);
    const Vec3 unit{sum.x / length, sum.y / length, sum.z / length};
    return select(square > splat(0.0F), unit, splat(glm::vec3(0.0F)));
}

/// Whether triangles have nearly the same normal and are hit at nearly the same depth.
/// @param where  pixels that are asked about
M isNearlyFlat(const SolidGeometry& geometry, const SampleHits& a, const SampleHits& b, M where) {
    const CameraFrame& frame = geometry.frame;
    const DrawnMeshes& meshes = *geometry.meshes->meshes;
    const Vec3 normal = normalsOf(meshes, a.triangle, where);
    const M isParallel = dot(normal, normalsOf(meshes, b.triangle, where)) >= splat(kSmooth);
    const V scale = frame.perspective ? hn::Min(a.depth, b.depth) : splat(1.0F);
    const V pixel = splat(frame.pixelWidth()) * scale;
    // Within a pixel a surface at this angle to the view gets deeper by pixel / cosine; twice that for its bend.
    const V cosine = hn::Max(hn::Abs(dot(normal, splat(frame.forward))), splat(0.05F));
    return hn::And(isParallel, hn::Abs(a.depth - b.depth) <= splat(2.0F) * pixel / cosine);
}

/// Whether two samples hit the same smooth surface: triangles that share a corner, where normals and positions are the
/// same, or triangles of one mesh with nearly the same normal at nearly the same depth.
/// @param where  pixels of which both samples hit triangles
M isSmooth(const SolidGeometry& geometry, const SampleHits& a, const SampleHits& b, M where) {
    const M ofOneMesh = hn::And(where, floatMask(a.triangle.w == b.triangle.w));
    const M isShared = hn::And(ofOneMesh, haveSharedCorner(a.triangle, b.triangle));
    const M isLeft = hn::AndNot(isShared, ofOneMesh);
    if (none(isLeft)) return isShared;
    return hn::Or(isShared, hn::And(isLeft, isNearlyFlat(geometry, a, b, isLeft)));
}

/// Merges the hits of the pixels that a vector takes.
void mergeVector(const SolidGeometry& geometry, std::span<TileRays> samples, std::size_t first) {
    const auto hitsOf = [&](std::size_t s) { return SampleHits(*geometry.meshes->meshes, samples[s], first); };
    std::array<SampleHits, 4> hits{hitsOf(0), hitsOf(1), hitsOf(2), hitsOf(3)};
    for (std::size_t s = 1; s < hits.size(); ++s) {
        M isOpen = isTriangle(hits[s].hitId);
        for (std::size_t earlier = 0; earlier < s && !none(isOpen); ++earlier) {
            const SampleHits& other = hits[earlier];
            isOpen = hn::AndNot(floatMask(other.hitId == hits[s].hitId), isOpen);
            const M isMerged = isSmooth(geometry, other, hits[s], hn::And(isOpen, isTriangle(other.hitId)));
            hits[s].replace(isMerged, other);
            isOpen = hn::AndNot(isMerged, isOpen);
        }
        storeInt(hits[s].hitId, &samples[s].hitId[first]);
    }
}

/// Whether all samples of the pixels that a vector takes hit the same.
bool areEqual(std::span<const TileRays> samples, std::size_t first) {
    const VI one = loadInt(&samples[0].hitId[first]);
    VI differences = splatInt(0);
    for (std::size_t s = 1; s < samples.size(); ++s)
        differences = hn::Or(differences, hn::Xor(one, loadInt(&samples[s].hitId[first])));
    return hn::AllTrue(DI(), differences == splatInt(0));
}

void mergeHits(const SolidGeometry& geometry, std::span<TileRays> samples) {
    for (std::size_t first = 0; first < kTilePixels; first += hn::Lanes(D()))
        if (!areEqual(samples, first)) mergeVector(geometry, samples, first);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(mergeHits);

void mergeSmoothHits(const SolidGeometry& geometry, std::span<TileRays> samples) {
    HWY_DYNAMIC_DISPATCH(mergeHits)(geometry, samples);
}

}  // namespace render

#endif
