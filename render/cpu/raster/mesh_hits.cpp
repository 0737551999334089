// Triangles with Highway, one ray per lane; this file is compiled once per instruction set.
// The edge functions that it evaluates come from triangle_setup.cpp.
#include "render/cpu/raster/mesh_hits.h"

#include <algorithm>
#include <array>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/raster/mesh_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/raster/block_samples-inl.h"
#include "render/cpu/raster/triangle_setup.h"
#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The view depth where a ray meets a triangle, and whether it meets it before the eye.
/// @param linear  the triangle's function of depth at the ray
template <bool kPerspective>
HWY_INLINE V depthOf(V linear, V front, V back, M& isHit) {
    V depth = linear;
    if constexpr (kPerspective) {
        // On the edge of a triangle that is seen at a grazing angle rounding may make the sum 0 or less: it is clamped.
        depth = splat(1.0F) / hn::Max(linear, splat(1.0e-37F));
    } else {
        isHit = hn::And(isHit, linear > splat(0.0F));
    }
    return hn::Min(hn::Max(depth, front), back);
}

HWY_INLINE void keepNearer(M isHit, V depth, std::int32_t id, float* depths, std::int32_t* hitIds) {
    const V old = load(depths);
    isHit = hn::And(isHit, depth < old);
    store(hn::IfThenElse(isHit, depth, old), depths);
    storeInt(hn::IfThenElse(hn::RebindMask(DI(), isHit), splatInt(id), loadInt(hitIds)), hitIds);
}

/// A triangle at the samples of blocks: its functions of a pixel's column and row, and of a sample's offset from its
/// pixel's corner.
template <int kSide>
struct BlockTriangle {
    std::array<glm::vec2, 4> slopes;  ///< of the three edge functions and of the depth
    alignas(64) std::array<BlockValues, 4> ofSample;
    float front, back;  ///< least and greatest view depth, m
    std::int32_t id;

    BlockTriangle(const TriangleGroup& group, std::size_t number, std::uint32_t index, const BlockPlaces<kSide>& places)
        : front(group.front[number]), back(group.back[number]), id(kHitTriangle + static_cast<std::int32_t>(index)) {
        for (std::size_t f = 0; f < 4; ++f) {
            const glm::vec3 function = (f < 3 ? group.edges[f] : group.depth)[number];
            slopes[f] = glm::vec2(function);
            for (std::size_t k = 0; k < kBlock; k += hn::Lanes(D())) {
                const V across = splat(function.x) * load(&places.offsetX[k]);
                const V down = splat(function.y) * load(&places.offsetY[k]);
                store(across + down + splat(function.z), &ofSample[f][k]);
            }
        }
    }
};

/// Adds triangles to the samples of a tile, each in two passes: over the samples around it, and over those that it
/// hits.
template <bool kPerspective, int kSide>
class BlockRaster {
 public:
    BlockRaster(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> rays)
        : geometry_(geometry),
          tile_(tile),
          corner_(tileCorner(*geometry.tiles, tile)),
          rays_(rays),
          places_(corner_, rays),
          samples_(rays) {}

    void addAll() {
        std::span<const std::uint32_t> left = geometry_.meshes->tiles.itemsOf(tile_);
        while (!left.empty()) {
            const std::size_t count = std::min(left.size(), TriangleGroup::kMost);
            if (!addGroup(left.first(count))) break;
            left = left.subspan(count);
        }
        samples_.copyTo(rays_);
    }

 private:
    static constexpr std::size_t kAll = BlockSamples<kSide>::kSamples * kTilePixels;  ///< samples of the tile

    /// @return whether later triangles may be before what has been hit
    bool addGroup(std::span<const std::uint32_t> indices) {
        const float farthest = samples_.farthest();
        const TriangleGroup group = triangleGroup(geometry_, indices, corner_);
        for (std::size_t k = 0; k < indices.size(); ++k) {
            // The triangles are listed front to back: all later ones are behind what has been hit.
            if (group.front[k] > farthest) return false;
            const Rect touched = withinTile(geometry_.meshes->bounds[indices[k]].pixels, static_cast<int>(corner_.x),
                                            static_cast<int>(corner_.y));
            if (touched.x1 < touched.x0 || touched.y1 < touched.y0) continue;
            add(BlockTriangle<kSide>(group, k, indices[k], places_), touched);
        }
        return true;
    }

    void add(const BlockTriangle<kSide>& triangle, const Rect& touched) {
        const Rect blocks{touched.x0 / kSide, touched.y0 / kSide, touched.x1 / kSide, touched.y1 / kSide};
        hitCount_ = 0;
        for (int row = blocks.y0; row <= blocks.y1; ++row)
            for (std::size_t pixels = 0; pixels < kSide * kSide; pixels += hn::Lanes(D()))
                findInRow(triangle, blocks, row, pixels);
        for (std::size_t k = 0; k < hitCount_; ++k) addHits(triangle, k);
    }

    /// Finds the vectors of samples in a row of blocks that hit a triangle. There is no branch on whether they do,
    /// which would be mispredicted too often.
    /// @param pixels  the first of each block's pixels that a vector takes
    HWY_INLINE void findInRow(const BlockTriangle<kSide>& triangle, const Rect& blocks, int row, std::size_t pixels) {
        const V y = load(&places_.row[pixels]) + splat(static_cast<float>(row * kSide));
        const auto slopeOf = [&](std::size_t f) { return splat(triangle.slopes[f].x); };
        const auto ofRow = [&](std::size_t f) { return splat(triangle.slopes[f].y) * y; };
        const std::array<V, 4> slope{slopeOf(0), slopeOf(1), slopeOf(2), slopeOf(3)};
        const std::array<V, 4> start{ofRow(0), ofRow(1), ofRow(2), ofRow(3)};
        for (int across = blocks.x0; across <= blocks.x1; ++across) {
            const V x = load(&places_.column[pixels]) + splat(static_cast<float>(across * kSide));
            const auto atPixels = [&](std::size_t f) { return slope[f] * x + start[f]; };
            const std::array<V, 4> values{atPixels(0), atPixels(1), atPixels(2), atPixels(3)};
            const std::size_t block = samples_.blockAt(across, row);
            for (std::size_t k = pixels; k < kBlock; k += std::max<std::size_t>(hn::Lanes(D()), kSide * kSide)) {
                const auto at = [&](std::size_t f) { return values[f] + load(&triangle.ofSample[f][k]); };
                const V inside = hn::Min(at(0), hn::Min(at(1), at(2)));
                const M isHit =
                    hn::And(inside >= splat(0.0F), load(&samples_.depth[block + k]) > splat(triangle.front));
                store(inside, &inside_[hitCount_ * hn::Lanes(D())]);
                store(at(3), &linear_[hitCount_ * hn::Lanes(D())]);
                firstHits_[hitCount_] = static_cast<std::uint16_t>(block + k);
                hitCount_ += none(isHit) ? 0U : 1U;
            }
        }
    }

    HWY_INLINE void addHits(const BlockTriangle<kSide>& triangle, std::size_t k) {
        M isHit = load(&inside_[k * hn::Lanes(D())]) >= splat(0.0F);
        const V linear = load(&linear_[k * hn::Lanes(D())]);
        const V depth = depthOf<kPerspective>(linear, splat(triangle.front), splat(triangle.back), isHit);
        const std::size_t first = firstHits_[k];
        keepNearer(isHit, depth, triangle.id, &samples_.depth[first], &samples_.hitId[first]);
    }

    const SolidGeometry& geometry_;
    std::size_t tile_;
    glm::vec2 corner_;
    std::span<TileRays> rays_;
    BlockPlaces<kSide> places_;
    BlockSamples<kSide> samples_;
    // Vectors of samples that hit a triangle.
    std::size_t hitCount_ = 0;
    std::array<std::uint16_t, kAll + 1> firstHits_;                 // index of the first sample of each
    alignas(64) std::array<float, kAll + kBlock> inside_, linear_;  // least edge function and function of depth
};

/// Adds one triangle of a group to all rays of a tile.
template <bool kPerspective>
void addAnywhere(const TriangleGroup& group, std::size_t number, std::int32_t id, glm::vec2 corner, TileRays& rays) {
    const V front = splat(group.front[number]);
    const V back = splat(group.back[number]);
    for (std::size_t first = 0; first < kTilePixels; first += hn::Lanes(D())) {
        const V x = load(&rays.x[first]) - splat(corner.x);
        const V y = load(&rays.y[first]) - splat(corner.y);
        const auto valueOf = [&](glm::vec3 f) { return splat(f.x) * x + splat(f.y) * y + splat(f.z); };
        const auto edge = [&](std::size_t k) { return valueOf(group.edges[k][number]); };
        M isHit = hn::Min(edge(0), hn::Min(edge(1), edge(2))) >= splat(0.0F);
        if (none(isHit)) continue;
        const V depth = depthOf<kPerspective>(valueOf(group.depth[number]), front, back, isHit);
        keepNearer(isHit, depth, id, &rays.depth[first], &rays.hitId[first]);
    }
}

void findTileHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    const bool isPerspective = geometry.frame.perspective;
    if (samples.size() == 1) {
        isPerspective ? BlockRaster<true, 4>(geometry, tile, samples).addAll()
                      : BlockRaster<false, 4>(geometry, tile, samples).addAll();
    } else {
        isPerspective ? BlockRaster<true, 2>(geometry, tile, samples).addAll()
                      : BlockRaster<false, 2>(geometry, tile, samples).addAll();
    }
}

void findHitsAnywhere(const SolidGeometry& geometry, std::size_t tile, TileRays& rays) {
    const glm::vec2 corner = tileCorner(*geometry.tiles, tile);
    for (const std::uint32_t& index : geometry.meshes->tiles.itemsOf(tile)) {
        const TriangleGroup group = triangleGroup(geometry, {&index, 1}, corner);
        const std::int32_t id = kHitTriangle + static_cast<std::int32_t>(index);
        geometry.frame.perspective ? addAnywhere<true>(group, 0, id, corner, rays)
                                   : addAnywhere<false>(group, 0, id, corner, rays);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(findTileHits);
HWY_EXPORT(findHitsAnywhere);

void findMeshHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    HWY_DYNAMIC_DISPATCH(findTileHits)(geometry, tile, samples);
}

void findMeshHitsAnywhere(const SolidGeometry& geometry, std::size_t tile, TileRays& rays) {
    HWY_DYNAMIC_DISPATCH(findHitsAnywhere)(geometry, tile, rays);
}

}  // namespace render

#endif
