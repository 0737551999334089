// The shadows of boxes: receivers are handled cell by cell of the light's grid of boxes, as for spheres. Included by
// light_visibility.cpp once per instruction set by Highway's rules, from which the guard below comes.
#if defined(RENDER_BOX_SHADOWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_BOX_SHADOWS_INL_H_
#undef RENDER_BOX_SHADOWS_INL_H_
#else
#define RENDER_BOX_SHADOWS_INL_H_
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/receivers-inl.h"
#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Distances along a ray to the light at which it enters and leaves the slab between two opposite faces of a box, m.
struct Slab {
    V near, far;
};

/// The gap between entering one pair of faces and leaving another, as a distance from the outline that the two share.
HWY_INLINE V outlineGap(const Slab& entered, const Slab& left, float scale) {
    return (left.far - entered.near) * splat(scale);
}

/// Coverage by a box, which seen from the light is a convex hexagon. Let p be the point, l the direction to the light,
/// and let the ray enter through the face at coordinate a_i on axis i and leave through the face at b_j on axis j. The
/// gap between entry and exit, (b_j - p_j)/l_j - (a_i - p_i)/l_i, falls linearly with the distance of p to a side of
/// the hexagon; its gradient in p is e_i/l_i - e_j/l_j, of length sqrt(1/l_i^2 + 1/l_j^2). The least gap over that
/// length is the signed distance to the outline.
HWY_INLINE V boxCoverage(const BoxObstacle& box, const Occluders& occluders, const Receivers& at) {
    const glm::vec3 inverse = occluders.lightBoxes->inverse;
    const glm::vec3 scale = occluders.lightBoxes->gapScale;
    const glm::vec3 low = box.minimum - occluders.eye;
    const glm::vec3 high = box.maximum - occluders.eye;
    const auto slab = [&](V position, int axis) {
        const V first = (splat(low[axis]) - position) * splat(inverse[axis]);
        const V second = (splat(high[axis]) - position) * splat(inverse[axis]);
        return Slab{hn::Min(first, second), hn::Max(first, second)};
    };
    const Slab x = slab(at.position.x, 0);
    const Slab y = slab(at.position.y, 1);
    const Slab z = slab(at.position.z, 2);
    V inside = outlineGap(x, y, scale.x);
    inside = hn::Min(inside, outlineGap(y, z, scale.y));
    inside = hn::Min(inside, outlineGap(z, x, scale.z));
    inside = hn::Min(inside, outlineGap(x, z, scale.z));
    inside = hn::Min(inside, outlineGap(y, x, scale.x));
    inside = hn::Min(inside, outlineGap(z, y, scale.y));
    const V exit = hn::Min(x.far, hn::Min(y.far, z.far));
    const float tolerance = 1.0e-4F * length(box.maximum - box.minimum);
    const bool isSoft = occluders.softness > 0.0F;
    V width = at.pixelWidth;
    if (isSoft) {
        const V limit = hn::Min(splat(occluders.meanRadius), splat(0.5F) * exit);
        width = hn::Max(width, splat(occluders.softness) * limit);
    }
    const V ratio = inside / hn::Max(width, splat(tolerance));
    return hn::IfThenElseZero(exit > splat(tolerance), isSoft ? softEdge(ratio) : sharpEdge(ratio));
}

/// Bits for the boxes first, first + 1, ... of the grid's lists, set if they may cover receivers within these bounds.
/// @param reachU, reachV  how far the edges of shadows reach beyond the boxes along u and v, m
HWY_INLINE std::uint32_t coveringBoxes(const LightBoxes& boxes, std::size_t first, const ReceiverBounds& bounds,
                                       V reachU, V reachV) {
    const D d;
    const auto at = [&](const std::vector<float>& values) { return hn::LoadU(d, &values[first]); };
    const M isNearU = hn::And(bounds.highU + reachU >= at(boxes.lowU), bounds.lowU - reachU <= at(boxes.highU));
    const M isNearV = hn::And(bounds.highV + reachV >= at(boxes.lowV), bounds.lowV - reachV <= at(boxes.highV));
    return maskBits(hn::And(hn::And(isNearU, isNearV), at(boxes.top) >= bounds.bottom));
}

/// What a box adds to the coverage: of one whose coverage is subtracted, less than 0.
HWY_INLINE V boxTerm(const Occluders& occluders, std::size_t index, const Receivers& at) {
    const V covered = boxCoverage(occluders.boxes[index], occluders, at);
    return index < occluders.subtractedBoxCount ? hn::Neg(covered) : covered;
}

/// Coverage of some receivers by the boxes of one list, in the order of their indices, until that is all of the light:
/// boxes whose coverage is subtracted come first.
HWY_INLINE V listedBoxesCoverage(const Occluders& occluders, std::size_t list, const Receivers& at, M where) {
    const D d;
    const LightBoxGrid& grid = *occluders.lightBoxes;
    const ReceiverBounds bounds(at, where);
    const V widestPixel = hn::Neg(minOfLanes(hn::Neg(at.pixelWidth), where));
    const V widest = hn::Max(widestPixel, splat(occluders.softness * occluders.meanRadius));
    const V reachU = splat(grid.edgeReach.x) * widest;
    const V reachV = splat(grid.edgeReach.y) * widest;
    V coverage = splat(0.0F);
    const std::size_t end = grid.begin[list + 1];
    for (std::size_t first = grid.begin[list]; first < end; first += hn::Lanes(d)) {
        const std::size_t count = std::min(end - first, hn::Lanes(d));
        for (std::uint32_t bits = coveringBoxes(grid.boxes, first, bounds, reachU, reachV) & ((1U << count) - 1U);
             bits != 0; bits &= bits - 1) {
            const std::size_t k = first + static_cast<std::size_t>(std::countr_zero(bits));
            coverage = coverage + boxTerm(occluders, grid.boxes.index[k], at);
            if (none(hn::And(where, coverage < splat(1.0F)))) return coverage;
        }
    }
    return coverage;
}

/// Coverage by all boxes.
HWY_INLINE V boxesCoverage(const Occluders& occluders, const Receivers& at) {
    const D d;
    V coverage = splat(0.0F);
    const LightBoxGrid& grid = *occluders.lightBoxes;
    if (grid.isFew()) {
        for (std::size_t k = 0; k < occluders.boxes.size(); ++k) coverage = coverage + boxTerm(occluders, k, at);
        return coverage;
    }
    const V inverse = splat(1.0F / grid.cellSize);
    const M isNarrow = at.pixelWidth <= splat(grid.widestPixel);
    const auto cellsAlong = [&](V coordinate, float origin, int count) {
        return hn::Floor(clamp((coordinate - splat(origin)) * inverse, 0.0F, static_cast<float>(count - 1)));
    };
    const VI cell = cellIndex(cellsAlong(at.u, grid.origin.x, grid.columns), cellsAlong(at.v, grid.origin.y, grid.rows),
                              grid.columns, isNarrow);
    const VI list =
        hn::IfThenElse(hn::RebindMask(DI(), isNarrow), cell, splatInt(static_cast<std::int32_t>(grid.listOfAll())));
    alignas(64) std::array<std::int32_t, kTileSize> lists;
    storeInt(list, lists.data());
    for (M left = at.isFacing; !none(left);) {
        const std::int32_t one = lists[static_cast<std::size_t>(hn::FindFirstTrue(d, left))];
        const M where = hn::And(left, floatMask(list == splatInt(one)));
        coverage =
            hn::IfThenElse(where, listedBoxesCoverage(occluders, static_cast<std::size_t>(one), at, where), coverage);
        left = hn::AndNot(where, left);
    }
    return coverage;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
