// A row of the coarse grid at a time, with Highway; this file is compiled once per instruction set.
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

using DB = hn::CappedTag<float, kCoarseSide>;
using VB = hn::Vec<DB>;
using MB = hn::Mask<DB>;

struct Three {
    VB x, y, z;
};

VB constant(float value) {
    return hn::Set(DB(), value);
}

VB scalarProduct(const Three& a, const Three& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

Three loaded(const std::array<CoarseHits::Values, 3>& values, std::size_t at) {
    const DB d;
    return {hn::LoadU(d, &values[0][at]), hn::LoadU(d, &values[1][at]), hn::LoadU(d, &values[2][at])};
}

/// View coordinates; the direction's z is 1.
struct ViewRays {
    Three origin, direction;
};

ViewRays viewRays(const CameraFrame& frame, VB x, VB y) {
    const VB one = constant(1.0F);
    const VB zero = constant(0.0F);
    const VB atX =
        hn::Mul(hn::Sub(hn::Mul(x, constant(2.0F / static_cast<float>(frame.width))), one), constant(frame.halfWidth));
    const VB atY = hn::Mul(hn::Sub(one, hn::Mul(y, constant(2.0F / static_cast<float>(frame.height)))),
                           constant(frame.halfHeight));
    if (frame.perspective) return {{zero, zero, zero}, {atX, atY, one}};
    return {{atX, atY, zero}, {zero, zero, one}};
}

/// The hits on one side of pixels between.
struct Side {
    VB depth;
    Three normal;
    ViewRays rays;
};

/// Depth at which rays meet the planes through hits across their normals.
VB tangentDepth(const ViewRays& rays, const Side& side) {
    const Three& o = side.rays.origin;
    const Three& v = side.rays.direction;
    const Three off{hn::Sub(hn::Add(o.x, hn::Mul(side.depth, v.x)), rays.origin.x),
                    hn::Sub(hn::Add(o.y, hn::Mul(side.depth, v.y)), rays.origin.y),
                    hn::Sub(hn::Add(o.z, hn::Mul(side.depth, v.z)), rays.origin.z)};
    return hn::Div(scalarProduct(side.normal, off), scalarProduct(side.normal, rays.direction));
}

MB faces(const ViewRays& rays, const Side& side) {
    const VB towards = hn::Neg(scalarProduct(side.normal, rays.direction));
    const VB least = hn::Mul(constant(kLeastFacing * kLeastFacing), scalarProduct(rays.direction, rays.direction));
    return hn::And(hn::Gt(towards, constant(0.0F)), hn::Gt(hn::Mul(towards, towards), least));
}

struct Between {
    VB depth;
    MB good;
};

Between depthBetween(const CameraFrame& frame, const ViewRays& rays, const Side& a, const Side& b, float most) {
    const VB zero = constant(0.0F);
    const VB half = constant(0.5F);
    const VB fromA = tangentDepth(rays, a);
    const VB fromB = tangentDepth(rays, b);
    // The inverse of depth is linear on the picture in perspective, depth itself in parallel projection.
    const VB sum = hn::Add(a.depth, b.depth);
    const VB chord =
        frame.perspective ? hn::Div(hn::Mul(constant(2.0F), hn::Mul(a.depth, b.depth)), sum) : hn::Mul(half, sum);
    const VB tangents = hn::Mul(half, hn::Add(fromA, fromB));
    const VB limit = constant(most);
    const MB isHit = hn::And(hn::Ge(a.depth, zero), hn::Ge(b.depth, zero));
    const MB isEven =
        hn::And(hn::Lt(hn::Abs(hn::Sub(fromA, fromB)), limit), hn::Lt(hn::Abs(hn::Sub(tangents, chord)), limit));
    const MB isStraight = hn::Ge(scalarProduct(a.normal, b.normal), constant(kLeastCosine));
    return {hn::Mul(half, hn::Add(chord, tangents)),
            hn::And(hn::And(isHit, isEven), hn::And(isStraight, hn::And(faces(rays, a), faces(rays, b))))};
}

/// The mean of the hits at these places, normals of unit length.
template <std::size_t kCount>
void putMean(const CoarseHits& coarse, const std::array<std::size_t, kCount>& places, bool openness, RayBlock& block,
             std::size_t k) {
    const DB d;
    const VB share = constant(1.0F / static_cast<float>(kCount));
    const auto sumOf = [&](const CoarseHits::Values& values) {
        VB sum = hn::LoadU(d, &values[places[0]]);
        for (std::size_t i = 1; i < kCount; ++i) sum = hn::Add(sum, hn::LoadU(d, &values[places[i]]));
        return sum;
    };
    const Three normal{sumOf(coarse.normal[0]), sumOf(coarse.normal[1]), sumOf(coarse.normal[2])};
    const VB square = hn::Max(scalarProduct(normal, normal), constant(1e-30F));
    const VB scale = hn::Div(constant(1.0F), hn::Sqrt(square));
    hn::StoreU(hn::Mul(normal.x, scale), d, &block.normal[0][k]);
    hn::StoreU(hn::Mul(normal.y, scale), d, &block.normal[1][k]);
    hn::StoreU(hn::Mul(normal.z, scale), d, &block.normal[2][k]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        hn::StoreU(hn::Mul(sumOf(coarse.color[axis]), share), d, &block.color[axis][k]);
        if (openness) hn::StoreU(hn::Mul(sumOf(coarse.open[axis]), share), d, &block.open[axis][k]);
    }
}

MB misses(const CoarseHits& coarse, std::size_t at, float most) {
    const DB d;
    return hn::And(hn::Lt(hn::LoadU(d, &coarse.depth[at]), constant(0.0F)),
                   hn::Lt(hn::LoadU(d, &coarse.most[at]), constant(most)));
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
        const MB allMissed =
            hn::And(hn::And(missed(first), missed(first + 1)), hn::And(missed(below), missed(below + 1)));
        finish(k, {hn::Mul(constant(0.5F), hn::Add(falling.depth, rising.depth)), hn::And(falling.good, rising.good)},
               allMissed);
    }

    const std::array<bool, kBetween>& good() const { return good_; }

 private:
    ViewRays raysAt(std::size_t k, glm::vec2 off) const {
        const DB d;
        return viewRays(cast_.frame, hn::Add(hn::LoadU(d, &block_.x[k]), constant(off.x)),
                        hn::Add(hn::LoadU(d, &block_.y[k]), constant(off.y)));
    }

    Side side(std::size_t k, std::size_t at, glm::vec2 off) const {
        return {hn::LoadU(DB(), &coarse_.depth[at]), loaded(coarse_.normal, at), raysAt(k, off)};
    }

    Between between(const ViewRays& rays, std::size_t k, std::size_t a, std::size_t b, glm::vec2 off) const {
        return depthBetween(cast_.frame, rays, side(k, a, off), side(k, b, -off), smoothness_.depth);
    }

    MB missed(std::size_t at) const { return misses(coarse_, at, smoothness_.most); }

    void finish(std::size_t k, const Between& found, MB missed) {
        const DB d;
        hn::StoreU(hn::IfThenElse(missed, constant(-1.0F), found.depth), d, &block_.depth[k]);
        alignas(64) std::array<float, kCoarseSide> isGood;
        hn::Store(hn::IfThenElseZero(hn::Or(missed, found.good), constant(1.0F)), d, isGood.data());
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
    for (std::size_t row = 0; row < kCoarseSide; ++row) {
        for (std::size_t column = 0; column < kCoarseSide; column += hn::Lanes(DB())) {
            const std::size_t at = row * CoarseHits::kSide + column;
            const std::size_t k = row * kCoarseSide + column;
            filling.pair(k, at, at + 1, {-1.0F, 0.0F});
            filling.pair(kKind + k, at, at + CoarseHits::kSide, {0.0F, -1.0F});
            filling.pairs(2 * kKind + k, at);
        }
    }
    return filling.good();
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

namespace {

constexpr std::array<std::uint8_t, kBetween> betweenPlaces() {
    std::array<std::uint8_t, kBetween> places{};
    std::size_t k = 0;
    for (const auto& [right, down] : {std::array{1, 0}, std::array{0, 1}, std::array{1, 1}})
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
constexpr std::array<std::uint8_t, kBetween> kBetweenPlaces = betweenPlaces();

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
