// Triangles with Highway, one ray per lane; this file is compiled once per instruction set.
// The edge functions that it evaluates come from triangle_setup.cpp.
#include "render/cpu/raster/mesh_hits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/raster/mesh_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/raster/triangle_setup.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Side of a block of pixels. A small triangle touches fewer blocks than parts of rows.
constexpr int kBlockSide = 4;
constexpr int kBlocksInRow = kTileSize / kBlockSide;

/// The columns and rows of a tile's pixels, one block after another.
struct BlockPlaces {
    alignas(64) std::array<float, kTilePixels> column{}, row{};

    constexpr BlockPlaces() {
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const std::size_t block = k / (kBlockSide * kBlockSide);
            column[k] = static_cast<float>(block % kBlocksInRow * kBlockSide + k % kBlockSide);
            row[k] = static_cast<float>(block / kBlocksInRow * kBlockSide + k / kBlockSide % kBlockSide);
        }
    }
};

constexpr BlockPlaces kBlockPlaces;

/// The samples of a tile, one block of pixels after another.
struct BlockSamples {
    alignas(64) std::array<std::array<float, kTilePixels>, 4> depth;
    alignas(64) std::array<std::array<std::int32_t, kTilePixels>, 4> hitId;
    alignas(64) std::array<float, kTilePixels> farthest;  ///< the greatest depth of a pixel's samples so far
    std::size_t count;                                    ///< number of samples

    explicit BlockSamples(std::span<const TileRays> samples) : count(samples.size()) {
        forParts([&](std::size_t inBlocks, std::size_t inRows) {
            for (std::size_t s = 0; s < count; ++s) {
                std::copy_n(&samples[s].depth[inRows], kBlockSide, &depth[s][inBlocks]);
                std::copy_n(&samples[s].hitId[inRows], kBlockSide, &hitId[s][inBlocks]);
            }
        });
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            farthest[k] = depth[0][k];
            for (std::size_t s = 1; s < count; ++s) farthest[k] = std::max(farthest[k], depth[s][k]);
        }
    }

    void copyTo(std::span<TileRays> samples) const {
        forParts([&](std::size_t inBlocks, std::size_t inRows) {
            for (std::size_t s = 0; s < count; ++s) {
                std::copy_n(&depth[s][inBlocks], kBlockSide, &samples[s].depth[inRows]);
                std::copy_n(&hitId[s][inBlocks], kBlockSide, &samples[s].hitId[inRows]);
            }
        });
    }

    float farthestOfTile() const {
        const D d;
        V most = load(farthest.data());
        for (std::size_t first = hn::Lanes(d); first < kTilePixels; first += hn::Lanes(d))
            most = hn::Max(most, load(&farthest[first]));
        return hn::GetLane(hn::MaxOfLanes(d, most));
    }

 private:
    /// Calls visit(index in the blocks, index in the rows of the tile) for the first pixel of each row of each block.
    template <typename Visit>
    static void forParts(const Visit& visit) {
        for (std::size_t part = 0; part < kTilePixels / kBlockSide; ++part) {
            const std::size_t block = part / kBlockSide;
            const std::size_t row = block / kBlocksInRow * kBlockSide + part % kBlockSide;
            visit(kBlockSide * part, row * kTileSize + block % kBlocksInRow * kBlockSide);
        }
    }
};

/// The linear functions of a triangle at the samples of pixels: at column and row of a pixel, without the sample's
/// offset from the pixel's corner, which is in `offsets`.
struct SampledSetup {
    std::array<glm::vec2, 4> slopes;  ///< of the three edge functions and of the depth
    std::array<std::array<float, 4>, 4> offsets;

    SampledSetup(const TriangleSetup& setup, std::span<const glm::vec2> samples) {
        const std::array<glm::vec3, 4> functions{setup.edges[0], setup.edges[1], setup.edges[2], setup.depth};
        for (std::size_t f = 0; f < functions.size(); ++f) {
            slopes[f] = glm::vec2(functions[f]);
            for (std::size_t s = 0; s < samples.size(); ++s)
                offsets[s][f] = functions[f].x * samples[s].x + functions[f].y * samples[s].y + functions[f].z;
        }
    }
};

/// The view depth where a ray meets a triangle, and whether it meets it before the eye.
/// @param linear  the triangle's function of depth at the ray
template <bool kPerspective>
HWY_INLINE V depthOf(V linear, const TriangleSetup& setup, M& isHit) {
    V depth = linear;
    if constexpr (kPerspective) {
        // On the edge of a triangle that is seen at a grazing angle rounding may make the sum 0 or less: it is clamped.
        depth = splat(1.0F) / hn::Max(linear, splat(1.0e-37F));
    } else {
        isHit = hn::And(isHit, linear > splat(0.0F));
    }
    return hn::Min(hn::Max(depth, splat(setup.front)), splat(setup.back));
}

HWY_INLINE void keepNearer(M isHit, V depth, std::int32_t id, float* depths, std::int32_t* hitIds) {
    const V old = load(depths);
    isHit = hn::And(isHit, depth < old);
    store(hn::IfThenElse(isHit, depth, old), depths);
    storeInt(hn::IfThenElse(hn::RebindMask(DI(), isHit), splatInt(id), loadInt(hitIds)), hitIds);
}

/// Adds one triangle to all samples of a vector of pixels.
template <bool kPerspective>
HWY_INLINE void addTriangle(const TriangleSetup& setup, const SampledSetup& sampled, std::int32_t id, std::size_t first,
                            BlockSamples& samples) {
    const V column = load(&kBlockPlaces.column[first]);
    const V row = load(&kBlockPlaces.row[first]);
    const auto atPixel = [&](std::size_t f) {
        return splat(sampled.slopes[f].x) * column + splat(sampled.slopes[f].y) * row;
    };
    const V edge0 = atPixel(0);
    const V edge1 = atPixel(1);
    const V edge2 = atPixel(2);
    bool isAnyHit = false;
    for (std::size_t s = 0; s < samples.count; ++s) {
        const std::array<float, 4>& offset = sampled.offsets[s];
        const V least = hn::Min(edge0 + splat(offset[0]), hn::Min(edge1 + splat(offset[1]), edge2 + splat(offset[2])));
        M isHit = least >= splat(0.0F);
        if (none(isHit)) continue;
        isAnyHit = true;
        const V depth = depthOf<kPerspective>(atPixel(3) + splat(offset[3]), setup, isHit);
        keepNearer(isHit, depth, id, &samples.depth[s][first], &samples.hitId[s][first]);
    }
    if (!isAnyHit) return;
    V most = load(&samples.depth[0][first]);
    for (std::size_t s = 1; s < samples.count; ++s) most = hn::Max(most, load(&samples.depth[s][first]));
    store(most, &samples.farthest[first]);
}

/// Adds one triangle to the pixels of a tile that it touches.
template <bool kPerspective>
void addToPixels(const SolidGeometry& geometry, std::uint32_t index, const Rect& touched, glm::vec2 corner,
                 std::span<const glm::vec2> offsets, BlockSamples& samples) {
    const D d;
    const TriangleSetup setup = triangleSetup(geometry, index, corner);
    const SampledSetup sampled(setup, offsets);
    const std::int32_t id = kHitTriangle + static_cast<std::int32_t>(index);
    constexpr std::size_t kBlockPixels = kBlockSide * kBlockSide;
    for (int down = touched.y0 / kBlockSide; down <= touched.y1 / kBlockSide; ++down) {
        for (int across = touched.x0 / kBlockSide; across <= touched.x1 / kBlockSide; ++across) {
            const std::size_t block = static_cast<std::size_t>(down * kBlocksInRow + across) * kBlockPixels;
            for (std::size_t first = block; first < block + kBlockPixels; first += hn::Lanes(d))
                if (!hn::AllTrue(d, load(&samples.farthest[first]) < splat(setup.front)))
                    addTriangle<kPerspective>(setup, sampled, id, first, samples);
        }
    }
}

template <bool kPerspective>
void addTriangles(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> rays) {
    const MeshTiles& meshes = *geometry.meshes;
    const glm::vec2 corner = tileCorner(*geometry.tiles, tile);
    std::array<glm::vec2, 4> offsets{};
    for (std::size_t s = 0; s < rays.size(); ++s) offsets[s] = glm::vec2(rays[s].x[0], rays[s].y[0]) - corner;
    BlockSamples samples(rays);
    float farthest = samples.farthestOfTile();
    int added = 0;
    for (const std::uint32_t index : meshes.tiles.itemsOf(tile)) {
        const TriangleBounds& bounds = meshes.bounds[index];
        const Rect touched = withinTile(bounds.pixels, static_cast<int>(corner.x), static_cast<int>(corner.y));
        if (touched.x1 < touched.x0 || touched.y1 < touched.y0) continue;
        // The triangles are listed front to back: all later ones are behind what has been hit.
        if (bounds.front > farthest) break;
        addToPixels<kPerspective>(geometry, index, touched, corner, std::span(offsets).first(rays.size()), samples);
        constexpr int kEvery = 16;  // chosen: finding the farthest takes about as long as adding a triangle
        if (++added % kEvery == 0) farthest = samples.farthestOfTile();
    }
    samples.copyTo(rays);
}

template <bool kPerspective>
void addTrianglesAnywhere(const SolidGeometry& geometry, std::size_t tile, TileRays& rays) {
    const D d;
    const MeshTiles& meshes = *geometry.meshes;
    const glm::vec2 corner = tileCorner(*geometry.tiles, tile);
    for (const std::uint32_t index : meshes.tiles.itemsOf(tile)) {
        const TriangleSetup setup = triangleSetup(geometry, index, corner);
        const std::int32_t id = kHitTriangle + static_cast<std::int32_t>(index);
        for (std::size_t first = 0; first < kTilePixels; first += hn::Lanes(d)) {
            const V x = load(&rays.x[first]) - splat(corner.x);
            const V y = load(&rays.y[first]) - splat(corner.y);
            const auto valueOf = [&](glm::vec3 f) { return splat(f.x) * x + splat(f.y) * y + splat(f.z); };
            M isHit = hn::Min(valueOf(setup.edges[0]), hn::Min(valueOf(setup.edges[1]), valueOf(setup.edges[2]))) >=
                      splat(0.0F);
            if (none(isHit)) continue;
            const V depth = depthOf<kPerspective>(valueOf(setup.depth), setup, isHit);
            keepNearer(isHit, depth, id, &rays.depth[first], &rays.hitId[first]);
        }
    }
}

void findTileHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    geometry.frame.perspective ? addTriangles<true>(geometry, tile, samples)
                               : addTriangles<false>(geometry, tile, samples);
}

void findHitsAnywhere(const SolidGeometry& geometry, std::size_t tile, TileRays& rays) {
    geometry.frame.perspective ? addTrianglesAnywhere<true>(geometry, tile, rays)
                               : addTrianglesAnywhere<false>(geometry, tile, rays);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

namespace {

HWY_EXPORT(findTileHits);
HWY_EXPORT(findHitsAnywhere);

// Two triangles may belong to one smooth surface if the cosine between their normals is at least this. Chosen: a fold
// by as much, 18 degrees, cannot be told from a bend within one pixel.
constexpr float kSmooth = 0.95F;

bool isTriangle(std::int32_t hitId) {
    return hitId >= kHitTriangle && hitId < kHitBox;
}

bool haveSharedCorner(const DrawnTriangle& a, const DrawnTriangle& b) {
    return std::ranges::any_of(a.corners, [&](std::uint32_t corner) {
        return corner == b.corners[0] || corner == b.corners[1] || corner == b.corners[2];
    });
}

/// Whether two samples of a pixel hit the same smooth surface: triangles that share a corner, where normals and
/// positions are the same, or triangles of one mesh with nearly the same normal at nearly the same depth.
bool isSmooth(const SolidGeometry& geometry, std::int32_t a, std::int32_t b, float depthA, float depthB) {
    const MeshTiles& meshes = *geometry.meshes;
    const auto first = static_cast<std::size_t>(a - kHitTriangle);
    const auto second = static_cast<std::size_t>(b - kHitTriangle);
    const DrawnTriangle& one = meshes.meshes->triangles[first];
    const DrawnTriangle& other = meshes.meshes->triangles[second];
    if (one.mesh != other.mesh) return false;
    if (haveSharedCorner(one, other)) return true;
    const glm::vec3 normal = meshes.bounds[first].normal;
    if (dot(normal, meshes.bounds[second].normal) < kSmooth) return false;
    const CameraFrame& frame = geometry.frame;
    const float pixel = frame.pixelWidth() * (frame.perspective ? std::min(depthA, depthB) : 1.0F);
    // Within a pixel a surface at this angle to the view gets deeper by pixel / cosine; twice that for its bend.
    const float cosine = std::max(std::abs(dot(normal, frame.forward)), 0.05F);
    return std::abs(depthA - depthB) <= 2.0F * pixel / cosine;
}

}  // namespace

void findMeshHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples) {
    HWY_DYNAMIC_DISPATCH(findTileHits)(geometry, tile, samples);
}

void findMeshHitsAnywhere(const SolidGeometry& geometry, std::size_t tile, TileRays& rays) {
    HWY_DYNAMIC_DISPATCH(findHitsAnywhere)(geometry, tile, rays);
}

void mergeSmoothHits(const SolidGeometry& geometry, std::span<TileRays> samples) {
    std::array<std::int32_t, kTilePixels> differences{};
    for (std::size_t s = 1; s < samples.size(); ++s)
        for (std::size_t k = 0; k < kTilePixels; ++k) differences[k] |= samples[s].hitId[k] ^ samples[0].hitId[k];
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        if (differences[k] == 0) continue;
        for (std::size_t s = 1; s < samples.size(); ++s) {
            const std::int32_t id = samples[s].hitId[k];
            if (id == samples[0].hitId[k] || !isTriangle(id)) continue;
            for (std::size_t earlier = 0; earlier < s; ++earlier) {
                const std::int32_t other = samples[earlier].hitId[k];
                if (other == id) break;
                if (!isTriangle(other) ||
                    !isSmooth(geometry, other, id, samples[earlier].depth[k], samples[s].depth[k]))
                    continue;
                samples[s].hitId[k] = other;
                break;
            }
        }
    }
}

}  // namespace render

#endif
