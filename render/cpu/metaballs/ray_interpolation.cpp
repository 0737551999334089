// Interpolation between cast rays with Highway, one group of four pixels per lane; this file is compiled once per
// instruction set.
#include "render/cpu/metaballs/ray_interpolation.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/metaballs/ray_interpolation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

// Between hits whose normals differ by more than 11 degrees there may be an edge or a fold.
constexpr float kLeastCosine = 0.98F;
// Surfaces seen at a slant of less than this cosine change too fast from one pixel to the next.
constexpr float kLeastFacing = 0.15F;

/// Loads a vector of hits from an index of the coarse grid on: a part of a row of the tile or, with long vectors, two
/// rows.
V loadHits(const CoarseHits::Values& values, std::size_t at) {
    const D d;
#if HWY_TARGET != HWY_SCALAR
    if constexpr (hn::MaxLanes(D()) > kCoarseSide) {
        const hn::Half<D> half;
        return hn::Combine(d, hn::LoadU(half, &values[at + CoarseHits::kSide]), hn::LoadU(half, &values[at]));
    }
#endif
    return hn::LoadU(d, &values[at]);
}

Vec3 loadHits(const std::array<CoarseHits::Values, 3>& values, std::size_t at) {
    return {loadHits(values[0], at), loadHits(values[1], at), loadHits(values[2], at)};
}

/// The cast rays on one side of the interpolated pixels, and their hits.
struct Side {
    V depth;
    Vec3 normal;
    Ray ray;
};

/// Depth at which rays meet the tangent planes of hits.
V tangentDepth(const Ray& ray, const Side& side) {
    const Vec3 offset = pointOnRay(side.ray.origin, side.depth, side.ray.direction) - ray.origin;
    return dot(side.normal, offset) / dot(side.normal, ray.direction);
}

M isFacing(const Ray& ray, const Side& side) {
    const V toward = hn::Neg(dot(side.normal, ray.direction));
    const V least = splat(kLeastFacing * kLeastFacing) * dot(ray.direction, ray.direction);
    return hn::And(toward > splat(0.0F), toward * toward > least);
}

struct DepthBetween {
    V depth;
    M isSmooth;
};

DepthBetween depthBetween(const CameraFrame& frame, const Ray& ray, const Side& a, const Side& b, float limit) {
    const V zero = splat(0.0F);
    const V half = splat(0.5F);
    const V fromA = tangentDepth(ray, a);
    const V fromB = tangentDepth(ray, b);
    // In perspective the inverse of the depth is linear on the picture, in parallel projection the depth itself.
    const V sum = a.depth + b.depth;
    const V chord = frame.perspective ? splat(2.0F) * (a.depth * b.depth) / sum : half * sum;
    const V tangents = half * (fromA + fromB);
    const M areHits = hn::And(a.depth >= zero, b.depth >= zero);
    const M isEven = hn::And(hn::Abs(fromA - fromB) < splat(limit), hn::Abs(tangents - chord) < splat(limit));
    const M isStraight = dot(a.normal, b.normal) >= splat(kLeastCosine);
    return {half * (chord + tangents),
            hn::And(hn::And(areHits, isEven), hn::And(isStraight, hn::And(isFacing(ray, a), isFacing(ray, b))))};
}

/// The hits of a vector of rays.
struct HitVector {
    V depth;  ///< view depth, m; negative without a hit
    Vec3 normal, color, sky;
};

/// The mean of the hits at these indices, with normals of unit length and without a depth.
template <std::size_t kCount>
HitVector meanOf(const CoarseHits& coarse, const std::array<std::size_t, kCount>& indices, bool hasSky) {
    const auto sumOf = [&](const std::array<CoarseHits::Values, 3>& values) {
        Vec3 sum = loadHits(values, indices[0]);
        for (std::size_t i = 1; i < kCount; ++i) sum = sum + loadHits(values, indices[i]);
        return sum;
    };
    const V share = splat(1.0F / static_cast<float>(kCount));
    HitVector mean;
    mean.normal = sumOf(coarse.normal);
    mean.normal = mean.normal * (splat(1.0F) / hn::Sqrt(hn::Max(dot(mean.normal, mean.normal), splat(1e-30F))));
    mean.color = sumOf(coarse.color) * share;
    if (hasSky) mean.sky = sumOf(coarse.sky) * share;
    return mean;
}

/// Writes values of one pair of neighboring pixels per lane to the pixels of a tile.
/// @param first  index in the tile of the left pixel of the first pair
void storePairs(V left, V right, std::size_t first, std::array<float, kTilePixels>& values) {
    const D d;
    constexpr std::size_t kPairs =
        std::min(hn::MaxLanes(D()), kCoarseSide);  // number of pairs of pixels in a row of the tile
    alignas(64) std::array<float, 2 * kTileSize> both;
    hn::StoreInterleaved2(left, right, d, both.data());
    for (std::size_t pair = 0; pair < hn::Lanes(d); pair += kPairs)
        std::copy_n(&both[2 * pair], 2 * kPairs, &values[first + pair / kCoarseSide * 2 * kTileSize]);
}

void storePairs(const Vec3& left, const Vec3& right, std::size_t first, TileVec3& values) {
    storePairs(left.x, right.x, first, values[0]);
    storePairs(left.y, right.y, first, values[1]);
    storePairs(left.z, right.z, first, values[2]);
}

/// Interpolates the rays of one tile.
class Interpolation {
 public:
    Interpolation(const MetaballScene& scene, const CoarseHits& coarse, SmoothnessLimits limits, glm::vec2 corner)
        : scene_(scene), coarse_(coarse), limits_(limits), corner_(corner) {}

    /// Writes a vector of cast rays, which begins with ray k (row by row), and for each of them the interpolated rays
    /// to its right, below it, and diagonally below.
    void fill(std::size_t k, RayBlock& block, std::array<float, kTilePixels>& isSmooth) const {
        const std::size_t at = k / kCoarseSide * CoarseHits::kSide + k % kCoarseSide;
        const std::size_t below = at + CoarseHits::kSide;
        const HitVector own{loadHits(coarse_.depth, at), loadHits(coarse_.normal, at), loadHits(coarse_.color, at),
                            loadHits(coarse_.sky, at)};
        V isBesideSmooth, isBelowSmooth, isMiddleSmooth;
        const HitVector beside = betweenTwo(k, at, at + 1, {1.0F, 0.0F}, isBesideSmooth);
        const HitVector under = betweenTwo(k, at, below, {0.0F, 1.0F}, isBelowSmooth);
        const HitVector middle = betweenFour(k, at, isMiddleSmooth);
        const std::size_t first = k / kCoarseSide * 2 * kTileSize + k % kCoarseSide * 2;
        storeRow(own, beside, first, block);
        storeRow(under, middle, first + kTileSize, block);
        storePairs(splat(1.0F), isBesideSmooth, first, isSmooth);
        storePairs(isBelowSmooth, isMiddleSmooth, first + kTileSize, isSmooth);
    }

 private:
    /// Interpolates the rays between two cast rays each.
    /// @param a, b    indices of the hits on both sides of each ray
    /// @param offset  of each ray from its cast ray, pixels
    HitVector betweenTwo(std::size_t k, std::size_t a, std::size_t b, glm::vec2 offset, V& isSmooth) const {
        const DepthBetween found = depthBetween(scene_.frame, rayAt(k, offset), side(k, a, glm::vec2(0.0F)),
                                                side(k, b, 2.0F * offset), limits_.depth);
        HitVector mean = meanOf<2>(coarse_, {a, b}, scene_.hasSky);
        finish(found, hn::And(misses(a), misses(b)), mean, isSmooth);
        return mean;
    }

    /// Interpolates the rays in the middle of four cast rays each, by the mean of both diagonals.
    /// @param first  index of the first of the four hits
    HitVector betweenFour(std::size_t k, std::size_t first, V& isSmooth) const {
        const Ray ray = rayAt(k, glm::vec2(1.0F));
        const std::size_t below = first + CoarseHits::kSide;
        const auto between = [&](std::size_t a, glm::vec2 offsetA, std::size_t b, glm::vec2 offsetB) {
            return depthBetween(scene_.frame, ray, side(k, a, offsetA), side(k, b, offsetB), limits_.depth);
        };
        const DepthBetween falling = between(first, {0.0F, 0.0F}, below + 1, {2.0F, 2.0F});
        const DepthBetween rising = between(first + 1, {2.0F, 0.0F}, below, {0.0F, 2.0F});
        HitVector mean = meanOf<4>(coarse_, {first, first + 1, below, below + 1}, scene_.hasSky);
        const M allMiss = hn::And(hn::And(misses(first), misses(first + 1)), hn::And(misses(below), misses(below + 1)));
        finish({splat(0.5F) * (falling.depth + rising.depth), hn::And(falling.isSmooth, rising.isSmooth)}, allMiss,
               mean, isSmooth);
        return mean;
    }

    static void finish(const DepthBetween& found, M allMiss, HitVector& mean, V& isSmooth) {
        mean.depth = hn::IfThenElse(allMiss, splat(-1.0F), found.depth);
        isSmooth = hn::IfThenElseZero(hn::Or(allMiss, found.isSmooth), splat(1.0F));
    }

    void storeRow(const HitVector& left, const HitVector& right, std::size_t first, RayBlock& block) const {
        storePairs(left.depth, right.depth, first, block.depth);
        storePairs(left.normal, right.normal, first, block.normal);
        storePairs(left.color, right.color, first, block.color);
        if (scene_.hasSky) storePairs(left.sky, right.sky, first, block.sky);
    }

    /// Rays at an offset from the cast rays k, k + 1, ..., in pixels.
    Ray rayAt(std::size_t k, glm::vec2 offset) const {
        const V lane = hn::Iota(D(), static_cast<float>(k % kCoarseSide));
        const V wraps = hn::IfThenElseZero(lane >= splat(static_cast<float>(kCoarseSide)), splat(1.0F));
        const V column = lane - wraps * splat(static_cast<float>(kCoarseSide));
        const V row = wraps + splat(static_cast<float>(k / kCoarseSide));
        const auto pixel = [](V index, float first, float off) {
            return splat(2.0F) * index + splat(off) + splat(first);
        };
        return viewRay(scene_.frame,
                       imagePointAt(scene_.frame, pixel(column, corner_.x, offset.x), pixel(row, corner_.y, offset.y)));
    }

    Side side(std::size_t k, std::size_t at, glm::vec2 offset) const {
        return {loadHits(coarse_.depth, at), loadHits(coarse_.normal, at), rayAt(k, offset)};
    }

    /// Whether cast rays miss the surface by so much that it cannot lie beside them.
    M misses(std::size_t at) const {
        return hn::And(loadHits(coarse_.depth, at) < splat(0.0F),
                       loadHits(coarse_.maxField, at) < splat(limits_.maxField));
    }

    const MetaballScene& scene_;
    const CoarseHits& coarse_;
    SmoothnessLimits limits_;
    glm::vec2 corner_;
};

void interpolateRays(const MetaballScene& scene, const CoarseHits& coarse, SmoothnessLimits limits, glm::vec2 corner,
                     RayBlock& block, std::array<bool, kTilePixels>& isRough) {
    const Interpolation interpolation(scene, coarse, limits, corner);
    alignas(64) std::array<float, kTilePixels> isSmooth;
    for (std::size_t k = 0; k < kCoarseSide * kCoarseSide; k += hn::Lanes(D())) interpolation.fill(k, block, isSmooth);
    for (std::size_t k = 0; k < kTilePixels; ++k) isRough[k] = isSmooth[k] == 0.0F;
    block.count = kTilePixels;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

namespace {

constexpr std::array<std::uint8_t, kCoarseSide * kCoarseSide> coarsePixels() {
    std::array<std::uint8_t, kCoarseSide * kCoarseSide> pixels{};
    std::size_t k = 0;
    for (const int top : {0, kTileSize / 2})
        for (const int left : {0, kTileSize / 2})
            for (int row = top; row < top + kTileSize / 2; row += 2)
                for (int column = left; column < left + kTileSize / 2; column += 2)
                    pixels[k++] = static_cast<std::uint8_t>(row * kTileSize + column);
    return pixels;
}

}  // namespace

constexpr std::array<std::uint8_t, kCoarseSide* kCoarseSide> kCoarsePixels = coarsePixels();

void CoarseHits::set(const RayBlock& block, bool hasSky) {
    constexpr std::size_t kRow = kCoarseSide / 2;  // rays of a quarter's row, which are side by side in the block
    for (std::size_t k = 0; k < kCoarsePixels.size(); k += kRow) {
        const std::size_t pixel = kCoarsePixels[k];
        const std::size_t at = pixel / kTileSize / 2 * kSide + pixel % kTileSize / 2;
        const auto copyRow = [&](const std::array<float, kTilePixels>& from, Values& to) {
            std::copy_n(&from[k], kRow, &to[at]);
        };
        copyRow(block.depth, depth);
        copyRow(block.maxField, maxField);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            copyRow(block.normal[axis], normal[axis]);
            copyRow(block.color[axis], color[axis]);
            if (hasSky) copyRow(block.sky[axis], sky[axis]);
        }
    }
}

void CoarseHits::clearBorder() {
    for (std::size_t k = 0; k < kSide; ++k)
        for (const std::size_t at : {kCoarseSide * kSide + k, k * kSide + kCoarseSide}) {
            depth[at] = -1.0F;
            maxField[at] = 0.0F;
        }
}

void CoarseHits::setBorder(std::size_t column, std::size_t row, const CoarseHits& other, std::size_t otherColumn,
                           std::size_t otherRow) {
    const std::size_t at = row * kSide + column;
    const std::size_t from = otherRow * kSide + otherColumn;
    depth[at] = other.depth[from];
    maxField[at] = other.maxField[from];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        normal[axis][at] = other.normal[axis][from];
        color[axis][at] = other.color[axis][from];
        sky[axis][at] = other.sky[axis][from];
    }
}

HWY_EXPORT(interpolateRays);

void interpolateRays(const MetaballScene& scene, const CoarseHits& coarse, SmoothnessLimits limits, glm::vec2 corner,
                     RayBlock& block, std::array<bool, kTilePixels>& isRough) {
    HWY_DYNAMIC_DISPATCH(interpolateRays)(scene, coarse, limits, corner, block, isRough);
}

}  // namespace render

#endif
