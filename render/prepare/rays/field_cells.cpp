// Blocks are divided into eight and those into eight again, as long as bounds of the field leave open on which side of
// the threshold it is. Each part tests the balls that reach the one it is a part of. This file is compiled once per
// instruction set.
//
// Bounds in a box of the half side h around p. At p + u the root of a ball's kernel is  w - 2 (F d)^T u - u^T F u,
// where w is the root at p. The kernel is the square of the positive part of its root, which is a convex function of
// it, hence nowhere below its tangent at w > 0, and nowhere below 0. As u^T F u <= h^2 sum |F_ij|, the sum over the
// balls with w > 0 is a lower bound of the field:
//   sum w^2 - 4 h |sum w F d|_1 - 2 h^2 sum w |F|.
// The gradients of the balls inside of a body nearly cancel each other in it. Outside they have the same direction, and
// the sum over the greatest values of the kernels in the box is an upper bound: of a round ball that at the point of
// the box next to it, of an ellipsoid (sqrt(d^T F d) - sqrt(h^2 |F|)) in place of the distance, by the triangle
// inequality.
#include "render/prepare/rays/field_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>

#include "render/picture/parallel_loops.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/rays/ball_set.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/rays/field_cells.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/rays/ball_set-inl.h"

#ifndef RENDER_FIELD_CELLS_TYPES
#define RENDER_FIELD_CELLS_TYPES
namespace render {

/// A cube in space.
struct Cube {
    glm::vec3 center{0.0F};  ///< m
    float half = 1.0F;       ///< half of a side, m
};

/// Largest number of subcells along a side of a block: eight times two are four divisions, for which there are sets.
constexpr int kMostSubcellsAlong = 16;

/// Bounds of the field in a cube.
struct FieldBounds {
    float low = 0.0F, high = 0.0F;
};

/// Blocks that one task has classified, one after another, with places in its own lists.
struct BlockList {
    std::vector<Subcell> subcells;
    std::vector<std::uint32_t> balls;
};

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The greatest value of u^T F u in a cube, for a vector of balls.
template <bool kIsAnisotropic>
V greatestDrop(const BallSet& balls, std::size_t first, V squaredHalf) {
    const auto form = [&](std::size_t k) { return hn::LoadU(D(), balls.column(kBallForm + k) + first); };
    if constexpr (kIsAnisotropic) {
        const V mixed = hn::Abs(form(3)) + hn::Abs(form(4)) + hn::Abs(form(5));
        return squaredHalf * (form(0) + form(1) + form(2) + mixed + mixed);
    }
    return squaredHalf * splat(3.0F) * form(0);
}

/// The greatest value of the root in a cube, for a vector of balls.
template <bool kIsAnisotropic>
V greatestRoot(const BallSet& balls, std::size_t first, const BallTerms<kIsAnisotropic>& at, V half, V drop) {
    const V zero = splat(0.0F);
    const V peak = hn::LoadU(D(), balls.column(kBallPeak) + first);
    if constexpr (kIsAnisotropic) {
        const V distance = hn::Sqrt(hn::Max(dot(at.off, at.turned), zero));
        const V nearest = hn::Max(distance - hn::Sqrt(drop), zero);
        return peak - nearest * nearest;
    }
    const Vec3 nearest{hn::Max(hn::Abs(at.off.x) - half, zero), hn::Max(hn::Abs(at.off.y) - half, zero),
                       hn::Max(hn::Abs(at.off.z) - half, zero)};
    return peak - dot(nearest, nearest) * hn::LoadU(D(), balls.column(kBallForm) + first);
}

/// Bounds the field in a cube.
/// @param balls     all that reach the cube
/// @param reaching  receives the places in the set of those that do; has room for as many as are in whole blocks
/// @param count     receives their number
template <bool kIsAnisotropic>
FieldBounds boundsIn(const BallSet& balls, const Cube& cube, std::vector<std::int32_t>& reaching, std::size_t& count) {
    const D d;
    const DI di;
    const V zero = splat(0.0F);
    // Wider than rounding moves the points of rays that pass through the cube.
    const float wide = 1.001F * cube.half;
    const V half = splat(wide);
    const Vec3 center = splat(cube.center);
    SetSum value, downX, downY, downZ, loss, high;
    count = 0;
    for (std::size_t block = 0; block < balls.size(); block += kBlock) {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) {
            const std::size_t k = block + v * hn::Lanes(d);
            const BallTerms<kIsAnisotropic> at(balls, k, center);
            const V drop = greatestDrop<kIsAnisotropic>(balls, k, half * half);
            const V root = hn::Max(at.root, zero);
            value.add(v, root * root);
            downX.add(v, root * at.turned.x);
            downY.add(v, root * at.turned.y);
            downZ.add(v, root * at.turned.z);
            loss.add(v, root * drop);
            const V greatest = hn::Max(greatestRoot<kIsAnisotropic>(balls, k, at, half, drop), zero);
            high.add(v, greatest * greatest);
            const M isReaching = greatest > zero;
            const VI place = hn::Iota(di, static_cast<std::int32_t>(k));
            hn::StoreU(hn::Compress(place, hn::RebindMask(di, isReaching)), di, &reaching[count]);
            count += hn::CountTrue(d, isReaching);
        }
    }
    // Some hundred terms are rounded by less than this in sum.
    constexpr float kRounding = 1e-4F;
    const float field = value.total();
    const float slope = std::abs(downX.total()) + std::abs(downY.total()) + std::abs(downZ.total());
    return {field - 4.0F * wide * slope - 2.0F * loss.total() - kRounding * field, high.total() * (1.0F + kRounding)};
}

/// Classifies the subcells of one block after another.
template <bool kIsAnisotropic>
class BlockDivision {
 public:
    /// @param along  number of subcells along a side of a block
    BlockDivision(const BallCells& cells, float threshold, int along)
        : cells_(cells), threshold_(threshold), along_(along) {}

    /// Appends a block to a list. @return its number there, or on which side all of it is
    std::int32_t divide(glm::ivec3 cell, BlockList& list) {
        BallSet& candidates = sets_[0];
        candidates.assignAround(cells_, cell);
        if (candidates.size() == 0) return kAllOutside;
        const Cube block{cells_.low + cells_.side * (glm::vec3(cell) + 0.5F), 0.5F * cells_.side};
        const std::int32_t side = sideOf(candidates, block);
        if (side != kMixed) return side;
        const auto blockSize = static_cast<std::size_t>(along_ * along_ * along_);
        const std::size_t first = list.subcells.size();
        list.subcells.resize(first + blockSize);
        subcells_ = std::span(list.subcells).subspan(first);
        balls_ = &list.balls;
        divideMixed(block, {glm::ivec3(0), along_}, 1);
        const auto isLike = [&](const Subcell& subcell) { return subcell.count == subcells_[0].count; };
        if (subcells_[0].count > 0 || !std::ranges::all_of(subcells_, isLike))
            return static_cast<std::int32_t>(first / blockSize);
        const std::int32_t all = subcells_[0].count;
        list.subcells.resize(first);
        return all;
    }

 private:
    static constexpr std::int32_t kMixed = 0;

    /// The subcells of a cube: the first along each axis, and how many.
    struct Part {
        glm::ivec3 first;
        int count;
    };

    /// On which side of the threshold all of a cube is, or kMixed. Finds the balls that reach the cube.
    std::int32_t sideOf(const BallSet& balls, const Cube& cube) {
        found_.resize(std::max(found_.size(), balls.size() + 2 * kBlock));
        const FieldBounds bounds = boundsIn<kIsAnisotropic>(balls, cube, found_, foundCount_);
        return bounds.high < threshold_ ? kAllOutside : bounds.low >= threshold_ ? kAllInside : kMixed;
    }

    /// Index in BallCells of one of the balls that sideOf() has found in a set.
    std::int32_t foundBall(const BallSet& set, std::size_t k) const {
        return set.index(static_cast<std::size_t>(found_[k]));
    }

    /// Divides a cube that sideOf() has found to be mixed.
    /// @param level  number of divisions above this one, and one: of sets_, the one before is that of the cube above
    void divideMixed(const Cube& cube, const Part& part, std::size_t level) {
        const BallSet& above = sets_[level - 1];
        if (part.count == 1) {
            Subcell& subcell = at(part.first);
            subcell = {static_cast<std::uint32_t>(balls_->size()), static_cast<std::int32_t>(foundCount_)};
            for (std::size_t k = 0; k < foundCount_; ++k)
                balls_->push_back(static_cast<std::uint32_t>(foundBall(above, k)));
            return;
        }
        BallSet& set = sets_[level];
        set.assign(cells_, foundCount_, [&](std::size_t k) { return foundBall(above, k); });
        const int count = part.count / 2;
        for (int octant = 0; octant < 8; ++octant) {
            const glm::ivec3 place(octant & 1, octant >> 1 & 1, octant >> 2);
            const Part half{part.first + count * place, count};
            const Cube inner{cube.center + cube.half * (glm::vec3(place) - 0.5F), 0.5F * cube.half};
            const std::int32_t side = sideOf(set, inner);
            if (side == kMixed)
                divideMixed(inner, half, level + 1);
            else
                fill(half, side);
        }
    }

    void fill(const Part& part, std::int32_t side) {
        for (int z = 0; z < part.count; ++z)
            for (int y = 0; y < part.count; ++y)
                for (int x = 0; x < part.count; ++x) at(part.first + glm::ivec3(x, y, z)).count = side;
    }

    Subcell& at(glm::ivec3 place) { return subcells_[cellIndex(glm::ivec3(along_), place.x, place.y, place.z)]; }

    const BallCells& cells_;
    float threshold_;
    int along_;
    std::array<BallSet, 5> sets_;  // of a cube and those around it, one in the other
    std::span<Subcell> subcells_;  // of the block
    std::vector<std::uint32_t>* balls_ = nullptr;
    std::vector<std::int32_t> found_;  // places in the last set of balls that reach the last cube
    std::size_t foundCount_ = 0;
};

/// Classifies the blocks from `first` on.
/// @param along  as of BlockDivision
void divideCells(const BallCells& cells, float threshold, int along, std::size_t first, std::span<std::int32_t> blocks,
                 BlockList& list) {
    const auto divideAll = [&](auto division) {
        const auto columns = static_cast<std::size_t>(cells.count.x);
        const auto rows = static_cast<std::size_t>(cells.count.y);
        for (std::size_t k = 0; k < blocks.size(); ++k) {
            const std::size_t index = first + k;
            blocks[k] = division.divide({index % columns, index / columns % rows, index / columns / rows}, list);
        }
    };
    if (cells.isAnisotropic())
        divideAll(BlockDivision<true>(cells, threshold, along));
    else
        divideAll(BlockDivision<false>(cells, threshold, along));
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(divideCells);

namespace {

/// How many cells one task divides. Chosen: a task takes some tenths of a millisecond where all of them are mixed.
constexpr std::size_t kCellsPart = 64;

/// The number of subcells along a side of a block. Measured on the study's dam break: with half as many pictures take
/// twice as long, with twice as many those of a smooth skin as long, of an anisotropic one longer. Few balls that reach
/// much farther than most make blocks larger, but not their subcells.
int subcellsAlong(const BallCells& cells) {
    constexpr float kShareOfReach = 0.3F;
    double sum = 0.0;
    for (std::size_t k = 0; k < cells.particle.size(); ++k) {
        const float squaredSlope = cells.isAnisotropic()
                                       ? (cells.form[0][k] + cells.form[1][k] + cells.form[2][k]) / 3.0F
                                       : cells.squaredSlope[k];
        sum += double(std::sqrt(cells.peak[k] / squaredSlope));
    }
    const float side = kShareOfReach * static_cast<float>(sum / static_cast<double>(cells.particle.size()));
    int along = 2;
    while (along < kMostSubcellsAlong && cells.side > side * static_cast<float>(along)) along *= 2;
    return along;
}

/// Appends the lists of all tasks to each other.
void joinLists(std::span<const BlockList> lists, FieldCells& to) {
    std::vector<std::size_t> firstSubcell(lists.size() + 1), firstBall(lists.size() + 1);
    for (std::size_t part = 0; part < lists.size(); ++part) {
        firstSubcell[part + 1] = firstSubcell[part] + lists[part].subcells.size();
        firstBall[part + 1] = firstBall[part] + lists[part].balls.size();
    }
    to.subcells.resize(firstSubcell.back());
    to.balls.resize(firstBall.back());
    forParts(to.blocks.size(), kCellsPart, [&](std::size_t part, std::size_t first, std::size_t end) {
        const auto blocksBefore = static_cast<std::int32_t>(firstSubcell[part] / to.subcellsOfBlock());
        for (std::size_t k = first; k < end; ++k)
            if (to.blocks[k] >= 0) to.blocks[k] += blocksBefore;
        for (std::size_t k = 0; k < lists[part].subcells.size(); ++k) {
            Subcell subcell = lists[part].subcells[k];
            subcell.first += static_cast<std::uint32_t>(firstBall[part]);
            to.subcells[firstSubcell[part] + k] = subcell;
        }
        std::ranges::copy(lists[part].balls, to.balls.begin() + static_cast<std::ptrdiff_t>(firstBall[part]));
    });
}

}  // namespace

FieldCells fieldCells(const BallCells& cells, float threshold) {
    static std::atomic<std::uint64_t> fieldCount = 0;
    FieldCells found;
    found.id = ++fieldCount;
    if (cells.empty()) return found;
    found.blocks.resize(cellIndex(cells.count, 0, 0, cells.count.z));
    found.along = subcellsAlong(cells);
    std::vector<BlockList> lists((found.blocks.size() + kCellsPart - 1) / kCellsPart);
    forParts(found.blocks.size(), kCellsPart, [&](std::size_t part, std::size_t first, std::size_t end) {
        HWY_DYNAMIC_DISPATCH(divideCells)
        (cells, threshold, found.along, first, std::span(found.blocks).subspan(first, end - first), lists[part]);
    });
    joinLists(lists, found);
    return found;
}

}  // namespace render

#endif
