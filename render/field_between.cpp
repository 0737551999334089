// As many pixels at a time as the machine has lanes, with Highway; this file is compiled once per instruction set.
#include "render/field_between.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/field_between.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/lane_rays-inl.h"

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
    const V one = all(1.0F);
    const V zero = all(0.0F);
    const V atX = hn::Mul(hn::Sub(hn::Mul(x, all(2.0F / static_cast<float>(frame.width))), one), all(frame.halfWidth));
    const V atY =
        hn::Mul(hn::Sub(one, hn::Mul(y, all(2.0F / static_cast<float>(frame.height)))), all(frame.halfHeight));
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
    return hn::Div(dotted(side.normal, off), dotted(side.normal, rays.direction));
}

M faces(const ViewRays& rays, const Side& side) {
    const V towards = hn::Neg(dotted(side.normal, rays.direction));
    const V least = hn::Mul(all(kLeastFacing * kLeastFacing), dotted(rays.direction, rays.direction));
    return hn::And(hn::Gt(towards, all(0.0F)), hn::Gt(hn::Mul(towards, towards), least));
}

struct Between {
    V depth;
    M good;
};

Between depthBetween(const CameraFrame& frame, const ViewRays& rays, const Side& a, const Side& b, float most) {
    const V zero = all(0.0F);
    const V half = all(0.5F);
    const V fromA = tangentDepth(rays, a);
    const V fromB = tangentDepth(rays, b);
    // The inverse of depth is linear on the picture in perspective, depth itself in parallel projection.
    const V sum = hn::Add(a.depth, b.depth);
    const V chord =
        frame.perspective ? hn::Div(hn::Mul(all(2.0F), hn::Mul(a.depth, b.depth)), sum) : hn::Mul(half, sum);
    const V tangents = hn::Mul(half, hn::Add(fromA, fromB));
    const V limit = all(most);
    const M isHit = hn::And(hn::Ge(a.depth, zero), hn::Ge(b.depth, zero));
    const M isEven =
        hn::And(hn::Lt(hn::Abs(hn::Sub(fromA, fromB)), limit), hn::Lt(hn::Abs(hn::Sub(tangents, chord)), limit));
    const M isStraight = hn::Ge(dotted(a.normal, b.normal), all(kLeastCosine));
    return {hn::Mul(half, hn::Add(chord, tangents)),
            hn::And(hn::And(isHit, isEven), hn::And(isStraight, hn::And(faces(rays, a), faces(rays, b))))};
}

/// The mean of the hits at these places, normals of unit length.
template <std::size_t kCount>
void putMean(const CoarseHits& coarse, const std::array<std::size_t, kCount>& places, bool openness, RayBlock& block,
             std::size_t k) {
    const D d;
    const V share = all(1.0F / static_cast<float>(kCount));
    const auto sumOf = [&](const CoarseHits::Values& values) {
        V sum = hitsFrom(values, places[0]);
        for (std::size_t i = 1; i < kCount; ++i) sum = hn::Add(sum, hitsFrom(values, places[i]));
        return sum;
    };
    const Vec3 normal{sumOf(coarse.normal[0]), sumOf(coarse.normal[1]), sumOf(coarse.normal[2])};
    const V square = hn::Max(dotted(normal, normal), all(1e-30F));
    const V scale = hn::Div(all(1.0F), hn::Sqrt(square));
    hn::StoreU(hn::Mul(normal.x, scale), d, &block.normal[0][k]);
    hn::StoreU(hn::Mul(normal.y, scale), d, &block.normal[1][k]);
    hn::StoreU(hn::Mul(normal.z, scale), d, &block.normal[2][k]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        hn::StoreU(hn::Mul(sumOf(coarse.color[axis]), share), d, &block.color[axis][k]);
        if (openness) hn::StoreU(hn::Mul(sumOf(coarse.open[axis]), share), d, &block.open[axis][k]);
    }
}

M misses(const CoarseHits& coarse, std::size_t at, float most) {
    return hn::And(hn::Lt(hitsFrom(coarse.depth, at), all(0.0F)), hn::Lt(hitsFrom(coarse.most, at), all(most)));
}

/// One tile on its way.
class Filling {
 public:
    Filling(const FieldCast& cast, const CoarseHits& coarse, Smoothness smoothness, RayBlock& block)
        : cast_(cast), coarse_(coarse), smoothness_(smoothness), block_(block) {}

    /// Pixels from place k of the block on; the hits on both sides of each begin at these places of the coarse grid, so
    /// many pixels away from it.
    void pair(std::size_t k, std::size_t a, std::size_t b, glm::vec2 off) {
        const ViewRays rays = raysAt(k, glm::vec2(0.0F));
        const Between found = between(rays, k, a, b, off);
        putMean<2>(coarse_, {a, b}, cast_.openness, block_, k);
        finish(k, found, hn::And(missed(a), missed(b)));
    }

    /// The same in the middle of four.
    void pairs(std::size_t k, std::size_t first) {
        const ViewRays rays = raysAt(k, glm::vec2(0.0F));
        const std::size_t below = first + CoarseHits::kSide;
        const Between falling = between(rays, k, first, below + 1, {-1.0F, -1.0F});
        const Between rising = between(rays, k, first + 1, below, {1.0F, -1.0F});
        putMean<4>(coarse_, {first, first + 1, below, below + 1}, cast_.openness, block_, k);
        const M allMissed =
            hn::And(hn::And(missed(first), missed(first + 1)), hn::And(missed(below), missed(below + 1)));
        finish(k, {hn::Mul(all(0.5F), hn::Add(falling.depth, rising.depth)), hn::And(falling.good, rising.good)},
               allMissed);
    }

    const std::array<bool, kBetween>& good() const { return good_; }

 private:
    ViewRays raysAt(std::size_t k, glm::vec2 off) const {
        const D d;
        return viewRays(cast_.frame, hn::Add(hn::LoadU(d, &block_.x[k]), all(off.x)),
                        hn::Add(hn::LoadU(d, &block_.y[k]), all(off.y)));
    }

    Side side(std::size_t k, std::size_t at, glm::vec2 off) const {
        return {hitsFrom(coarse_.depth, at), hitsFrom(coarse_.normal, at), raysAt(k, off)};
    }

    Between between(const ViewRays& rays, std::size_t k, std::size_t a, std::size_t b, glm::vec2 off) const {
        return depthBetween(cast_.frame, rays, side(k, a, off), side(k, b, -off), smoothness_.depth);
    }

    M missed(std::size_t at) const { return misses(coarse_, at, smoothness_.most); }

    void finish(std::size_t k, const Between& found, M missed) {
        const D d;
        hn::StoreU(hn::IfThenElse(missed, all(-1.0F), found.depth), d, &block_.depth[k]);
        alignas(64) std::array<float, kTileSize> isGood;
        hn::Store(hn::IfThenElseZero(hn::Or(missed, found.good), all(1.0F)), d, isGood.data());
        for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) good_[k + lane] = isGood[lane] != 0.0F;
    }

    const FieldCast& cast_;
    const CoarseHits& coarse_;
    Smoothness smoothness_;
    RayBlock& block_;
    std::array<bool, kBetween> good_{};
};

std::array<bool, kBetween> fillBetween(const FieldCast& cast, const CoarseHits& coarse, Smoothness smoothness,
                                       RayBlock& block) {
    constexpr std::size_t kKind = kBetween / 3;
    Filling filling(cast, coarse, smoothness, block);
    for (std::size_t k = 0; k < kKind; k += hn::Lanes(D())) {
        const std::size_t at = k / kCoarseSide * CoarseHits::kSide + k % kCoarseSide;
        filling.pair(k, at, at + 1, {-1.0F, 0.0F});
        filling.pair(kKind + k, at, at + CoarseHits::kSide, {0.0F, -1.0F});
        filling.pairs(2 * kKind + k, at);
    }
    return filling.good();
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

namespace {

constexpr std::array<std::uint8_t, kBlockRays> sparsePlaces() {
    std::array<std::uint8_t, kBlockRays> places{};
    std::size_t k = 0;
    for (const auto& [right, down] : {std::array{1, 0}, std::array{0, 1}, std::array{1, 1}, std::array{0, 0}})
        for (int row = down; row < kTileSize; row += 2)
            for (int column = right; column < kTileSize; column += 2)
                places[k++] = static_cast<std::uint8_t>(row * kTileSize + column);
    return places;
}

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
constexpr std::array<std::uint8_t, kBlockRays> kSparsePlaces = sparsePlaces();

void CoarseHits::put(const RayBlock& block, bool openness) {
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
            if (openness) take(block.open[axis], open[axis]);
        }
    }
}

void CoarseHits::addTo(RayBlock& block, bool openness) const {
    for (std::size_t row = 0; row < kCoarseSide; ++row, block.count += kCoarseSide) {
        const auto add = [&](const Values& from, std::array<float, kBlockRays>& to) {
            std::copy_n(&from[row * kSide], kCoarseSide, &to[block.count]);
        };
        add(depth, block.depth);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            add(normal[axis], block.normal[axis]);
            add(color[axis], block.color[axis]);
            if (openness) add(open[axis], block.open[axis]);
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

std::array<bool, kBetween> fillBetween(const FieldCast& cast, const CoarseHits& coarse, Smoothness smoothness,
                                       RayBlock& block) {
    return HWY_DYNAMIC_DISPATCH(fillBetween)(cast, coarse, smoothness, block);
}

}  // namespace render

#endif
