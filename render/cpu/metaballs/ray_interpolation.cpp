// As many pixels at a time as the machine has lanes, with Highway; this file is compiled once per instruction set.
#include "render/cpu/metaballs/ray_interpolation.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/metaballs/ray_interpolation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/raster/simd_colors-inl.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

// Normals that differ by more than 11 degrees have an edge between them, or a fold.
constexpr float kLeastCosine = 0.98F;
// Surfaces seen at a slant of less than this cosine run away from a pixel to the next.
constexpr float kLeastFacing = 0.15F;

/// Of the hits from this place of the coarse grid on: a part of a row of the tile, or two rows of it.
V hitsFrom(const CoarseHits::Values& values, std::size_t at) {
    const D d;
#if HWY_TARGET != HWY_SCALAR
    if constexpr (hn::MaxLanes(D()) > kCoarseSide) {
        const hn::Half<D> half;
        return hn::Combine(d, hn::LoadU(half, &values[at + CoarseHits::kSide]), hn::LoadU(half, &values[at]));
    }
#endif
    return hn::LoadU(d, &values[at]);
}

Vec3 hitsFrom(const std::array<CoarseHits::Values, 3>& values, std::size_t at) {
    return {hitsFrom(values[0], at), hitsFrom(values[1], at), hitsFrom(values[2], at)};
}

/// View coordinates; the direction's z is 1.
struct ViewRays {
    Vec3 origin, direction;
};

ViewRays viewRays(const CameraFrame& frame, V x, V y) {
    const V one = splat(1.0F);
    const V zero = splat(0.0F);
    const V atX =
        hn::Mul(hn::Sub(hn::Mul(x, splat(2.0F / static_cast<float>(frame.width))), one), splat(frame.halfWidth));
    const V atY =
        hn::Mul(hn::Sub(one, hn::Mul(y, splat(2.0F / static_cast<float>(frame.height)))), splat(frame.halfHeight));
    if (frame.perspective) return {{zero, zero, zero}, {atX, atY, one}};
    return {{atX, atY, zero}, {zero, zero, one}};
}

/// The hits on one side of pixels between.
struct Side {
    V depth;
    Vec3 normal;
    ViewRays rays;
};

/// Depth at which rays meet the planes through hits across their normals.
V tangentDepth(const ViewRays& rays, const Side& side) {
    const Vec3& o = side.rays.origin;
    const Vec3& v = side.rays.direction;
    const Vec3 off{hn::Sub(hn::Add(o.x, hn::Mul(side.depth, v.x)), rays.origin.x),
                   hn::Sub(hn::Add(o.y, hn::Mul(side.depth, v.y)), rays.origin.y),
                   hn::Sub(hn::Add(o.z, hn::Mul(side.depth, v.z)), rays.origin.z)};
    return hn::Div(dot(side.normal, off), dot(side.normal, rays.direction));
}

M faces(const ViewRays& rays, const Side& side) {
    const V toward = hn::Neg(dot(side.normal, rays.direction));
    const V least = hn::Mul(splat(kLeastFacing * kLeastFacing), dot(rays.direction, rays.direction));
    return hn::And(hn::Gt(toward, splat(0.0F)), hn::Gt(hn::Mul(toward, toward), least));
}

struct Between {
    V depth;
    M good;
};

Between depthBetween(const CameraFrame& frame, const ViewRays& rays, const Side& a, const Side& b, float most) {
    const V zero = splat(0.0F);
    const V half = splat(0.5F);
    const V fromA = tangentDepth(rays, a);
    const V fromB = tangentDepth(rays, b);
    // The inverse of depth is linear on the picture in perspective, depth itself in parallel projection.
    const V sum = hn::Add(a.depth, b.depth);
    const V chord =
        frame.perspective ? hn::Div(hn::Mul(splat(2.0F), hn::Mul(a.depth, b.depth)), sum) : hn::Mul(half, sum);
    const V tangents = hn::Mul(half, hn::Add(fromA, fromB));
    const V limit = splat(most);
    const M isHit = hn::And(hn::Ge(a.depth, zero), hn::Ge(b.depth, zero));
    const M isEven =
        hn::And(hn::Lt(hn::Abs(hn::Sub(fromA, fromB)), limit), hn::Lt(hn::Abs(hn::Sub(tangents, chord)), limit));
    const M isStraight = hn::Ge(dot(a.normal, b.normal), splat(kLeastCosine));
    return {hn::Mul(half, hn::Add(chord, tangents)),
            hn::And(hn::And(isHit, isEven), hn::And(isStraight, hn::And(faces(rays, a), faces(rays, b))))};
}

/// What rays of one kind show: cast ones, those beside them, below them, or in the middle of four.
struct Surface {
    V depth;  ///< negative: nothing
    Vec3 normal, color, open;
};

/// The mean of the hits at these places, normals of unit length; without a depth.
template <std::size_t kCount>
Surface meanOf(const CoarseHits& coarse, const std::array<std::size_t, kCount>& places, bool skyVisibility) {
    const auto sumOf = [&](const std::array<CoarseHits::Values, 3>& values) {
        Vec3 sum = hitsFrom(values, places[0]);
        for (std::size_t i = 1; i < kCount; ++i) sum = plus(sum, hitsFrom(values, places[i]));
        return sum;
    };
    const V share = splat(1.0F / static_cast<float>(kCount));
    Surface mean;
    mean.normal = sumOf(coarse.normal);
    mean.normal =
        times(mean.normal, hn::Div(splat(1.0F), hn::Sqrt(hn::Max(dot(mean.normal, mean.normal), splat(1e-30F)))));
    mean.color = times(sumOf(coarse.color), share);
    if (skyVisibility) mean.open = times(sumOf(coarse.open), share);
    return mean;
}

M misses(const CoarseHits& coarse, std::size_t at, float most) {
    return hn::And(hn::Lt(hitsFrom(coarse.depth, at), splat(0.0F)), hn::Lt(hitsFrom(coarse.most, at), splat(most)));
}

/// Writes what two rays beside each other have, of as many pairs as there are lanes, to their rows of the tile.
/// first: place of the first pair.
void putPairs(V left, V right, std::size_t first, std::array<float, kBlockRays>& values) {
    const D d;
    constexpr std::size_t kPairs = std::min(hn::MaxLanes(D()), kCoarseSide);  // in a row
    alignas(64) std::array<float, 2 * kTileSize> both;
    hn::StoreInterleaved2(left, right, d, both.data());
    for (std::size_t pair = 0; pair < hn::Lanes(d); pair += kPairs)
        std::copy_n(&both[2 * pair], 2 * kPairs, &values[first + pair / kCoarseSide * 2 * kTileSize]);
}

/// One tile on its way.
class Filling {
 public:
    Filling(const FieldCast& cast, const CoarseHits& coarse, Smoothness smoothness, glm::vec2 corner)
        : cast_(cast), coarse_(coarse), smoothness_(smoothness), corner_(corner) {}

    /// The rays that belong to cast ones from this one on, row by row.
    void fill(std::size_t k, RayBlock& block, std::array<float, kBlockRays>& good) const {
        const std::size_t at = k / kCoarseSide * CoarseHits::kSide + k % kCoarseSide;
        const std::size_t below = at + CoarseHits::kSide;
        const Surface own{hitsFrom(coarse_.depth, at), hitsFrom(coarse_.normal, at), hitsFrom(coarse_.color, at),
                          hitsFrom(coarse_.open, at)};
        V isBeside, isBelow, isMiddle;
        const Surface beside = pair(k, at, at + 1, {1.0F, 0.0F}, isBeside);
        const Surface under = pair(k, at, below, {0.0F, 1.0F}, isBelow);
        const Surface middle = pairs(k, at, isMiddle);
        const std::size_t first = k / kCoarseSide * 2 * kTileSize + k % kCoarseSide * 2;
        putRow(own, beside, first, block);
        putRow(under, middle, first + kTileSize, block);
        putPairs(splat(1.0F), isBeside, first, good);
        putPairs(isBelow, isMiddle, first + kTileSize, good);
    }

 private:
    /// The hits on both sides of each ray begin at these places of the coarse grid; off: from the first of them.
    Surface pair(std::size_t k, std::size_t a, std::size_t b, glm::vec2 off, V& good) const {
        const ViewRays rays = raysAt(k, off);
        const Between found =
            depthBetween(cast_.frame, rays, side(k, a, glm::vec2(0.0F)), side(k, b, 2.0F * off), smoothness_.depth);
        Surface mean = meanOf<2>(coarse_, {a, b}, cast_.skyVisibility);
        finish(found, hn::And(missed(a), missed(b)), mean, good);
        return mean;
    }

    /// The same in the middle of four.
    Surface pairs(std::size_t k, std::size_t first, V& good) const {
        const ViewRays rays = raysAt(k, glm::vec2(1.0F));
        const std::size_t below = first + CoarseHits::kSide;
        const auto between = [&](std::size_t a, glm::vec2 offA, std::size_t b, glm::vec2 offB) {
            return depthBetween(cast_.frame, rays, side(k, a, offA), side(k, b, offB), smoothness_.depth);
        };
        const Between falling = between(first, {0.0F, 0.0F}, below + 1, {2.0F, 2.0F});
        const Between rising = between(first + 1, {2.0F, 0.0F}, below, {0.0F, 2.0F});
        Surface mean = meanOf<4>(coarse_, {first, first + 1, below, below + 1}, cast_.skyVisibility);
        const M allMissed =
            hn::And(hn::And(missed(first), missed(first + 1)), hn::And(missed(below), missed(below + 1)));
        finish({hn::Mul(splat(0.5F), hn::Add(falling.depth, rising.depth)), hn::And(falling.good, rising.good)},
               allMissed, mean, good);
        return mean;
    }

    static void finish(const Between& found, M missed, Surface& mean, V& good) {
        mean.depth = hn::IfThenElse(missed, splat(-1.0F), found.depth);
        good = hn::IfThenElseZero(hn::Or(missed, found.good), splat(1.0F));
    }

    void putRow(const Surface& left, const Surface& right, std::size_t first, RayBlock& block) const {
        putPairs(left.depth, right.depth, first, block.depth);
        const auto put = [&](const Vec3& a, const Vec3& b, std::array<std::array<float, kBlockRays>, 3>& values) {
            putPairs(a.x, b.x, first, values[0]);
            putPairs(a.y, b.y, first, values[1]);
            putPairs(a.z, b.z, first, values[2]);
        };
        put(left.normal, right.normal, block.normal);
        put(left.color, right.color, block.color);
        if (cast_.skyVisibility) put(left.open, right.open, block.open);
    }

    /// Rays so many pixels from the cast ones.
    ViewRays raysAt(std::size_t k, glm::vec2 off) const {
        const V lane = hn::Iota(D(), static_cast<float>(k % kCoarseSide));
        const V wraps = hn::IfThenElseZero(hn::Ge(lane, splat(static_cast<float>(kCoarseSide))), splat(1.0F));
        const V column = hn::Sub(lane, hn::Mul(wraps, splat(static_cast<float>(kCoarseSide))));
        const V row = hn::Add(wraps, splat(static_cast<float>(k / kCoarseSide)));
        const auto pixel = [](V place, float first, float offPixel) {
            return hn::Add(hn::Add(hn::Mul(splat(2.0F), place), splat(offPixel)), splat(first));
        };
        return viewRays(cast_.frame, pixel(column, corner_.x, off.x), pixel(row, corner_.y, off.y));
    }

    Side side(std::size_t k, std::size_t at, glm::vec2 off) const {
        return {hitsFrom(coarse_.depth, at), hitsFrom(coarse_.normal, at), raysAt(k, off)};
    }

    M missed(std::size_t at) const { return misses(coarse_, at, smoothness_.most); }

    const FieldCast& cast_;
    const CoarseHits& coarse_;
    Smoothness smoothness_;
    glm::vec2 corner_;
};

void fillBetween(const FieldCast& cast, const CoarseHits& coarse, Smoothness smoothness, glm::vec2 corner,
                 RayBlock& block, std::array<bool, kBlockRays>& isRough) {
    const Filling filling(cast, coarse, smoothness, corner);
    alignas(64) std::array<float, kBlockRays> good;
    for (std::size_t k = 0; k < kCoarseSide * kCoarseSide; k += hn::Lanes(D())) filling.fill(k, block, good);
    for (std::size_t k = 0; k < kBlockRays; ++k) isRough[k] = good[k] == 0.0F;
    block.count = kBlockRays;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

namespace {

constexpr std::array<std::uint8_t, kCoarseSide * kCoarseSide> coarsePlaces() {
    std::array<std::uint8_t, kCoarseSide * kCoarseSide> places{};
    std::size_t k = 0;
    for (const int top : {0, kTileSize / 2})
        for (const int left : {0, kTileSize / 2})
            for (int row = top; row < top + kTileSize / 2; row += 2)
                for (int column = left; column < left + kTileSize / 2; column += 2)
                    places[k++] = static_cast<std::uint8_t>(row * kTileSize + column);
    return places;
}

}  // namespace

constexpr std::array<std::uint8_t, kCoarseSide* kCoarseSide> kCoarsePlaces = coarsePlaces();

void CoarseHits::put(const RayBlock& block, bool skyVisibility) {
    constexpr std::size_t kHalf = kCoarseSide / 2;
    for (std::size_t k = 0; k < kCoarsePlaces.size(); k += kHalf) {
        const std::size_t place = kCoarsePlaces[k];
        const std::size_t at = place / kTileSize / 2 * kSide + place % kTileSize / 2;
        const auto take = [&](const std::array<float, kBlockRays>& from, Values& to) {
            std::copy_n(&from[k], kHalf, &to[at]);
        };
        take(block.depth, depth);
        take(block.most, most);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            take(block.normal[axis], normal[axis]);
            take(block.color[axis], color[axis]);
            if (skyVisibility) take(block.open[axis], open[axis]);
        }
    }
}

void CoarseHits::clearBorder() {
    for (std::size_t k = 0; k < kSide; ++k)
        for (const std::size_t at : {kCoarseSide * kSide + k, k * kSide + kCoarseSide}) {
            depth[at] = -1.0F;
            most[at] = 0.0F;
        }
}

void CoarseHits::putBorder(std::size_t column, std::size_t row, const CoarseHits& other, std::size_t otherColumn,
                           std::size_t otherRow) {
    const std::size_t at = row * kSide + column;
    const std::size_t from = otherRow * kSide + otherColumn;
    depth[at] = other.depth[from];
    most[at] = other.most[from];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        normal[axis][at] = other.normal[axis][from];
        color[axis][at] = other.color[axis][from];
        open[axis][at] = other.open[axis][from];
    }
}

HWY_EXPORT(fillBetween);

void fillBetween(const FieldCast& cast, const CoarseHits& coarse, Smoothness smoothness, glm::vec2 corner,
                 RayBlock& block, std::array<bool, kBlockRays>& isRough) {
    HWY_DYNAMIC_DISPATCH(fillBetween)(cast, coarse, smoothness, corner, block, isRough);
}

}  // namespace render

#endif
