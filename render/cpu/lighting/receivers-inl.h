// Points that receive light, one per lane, and what the shadows of spheres, boxes and metaballs share: the edges, and
// the cells of a grid that points lie in. Included once per instruction set by Highway's rules, from which the guard
// below comes.
#if defined(RENDER_RECEIVERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_RECEIVERS_INL_H_
#undef RENDER_RECEIVERS_INL_H_
#else
#define RENDER_RECEIVERS_INL_H_
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// A vector of points that receive light.
struct Receivers {
    V u, v, height;  // position in light space, m
    Vec3 position, normal;
    V pixelWidth;  // width of a pixel at the point's depth, m
    M isFacing;    // whether the surface is turned to the light
};

/// Coverage by a sharp edge that is smoothed over the width of a pixel. @param x  distance inside the edge, pixels
HWY_INLINE V sharpEdge(V x) {
    return clamp(x + splat(0.5F), 0.0F, 1.0F);
}

/// The transition across the edge of a shadow from 0 to 1: edge(x) of shading_model.h.
HWY_INLINE V softEdge(V x) {
    const V t = sharpEdge(x);
    return t * t * (splat(3.0F) - (t + t));
}

/// Bounds of some receivers on the light's plane, and the lowest of their heights.
struct ReceiverBounds {
    V lowU, highU, lowV, highV, bottom;

    ReceiverBounds(const Receivers& at, M where)
        : lowU(minOfLanes(at.u, where)),
          highU(hn::Neg(minOfLanes(hn::Neg(at.u), where))),
          lowV(minOfLanes(at.v, where)),
          highV(hn::Neg(minOfLanes(hn::Neg(at.v), where))),
          bottom(minOfLanes(at.height, where)) {}
};

/// Mask of the points whose column lies in [low, columns) and whose row lies in [low, rows).
HWY_INLINE M isWithin(V column, V row, float low, int columns, int rows) {
    const V least = splat(low);
    return hn::And(hn::And(column >= least, column < splat(static_cast<float>(columns))),
                   hn::And(row >= least, row < splat(static_cast<float>(rows))));
}

/// Index column + row * columns of a cell where the mask is set, 0 elsewhere.
HWY_INLINE VI cellIndex(V column, V row, int columns, M where) {
    const auto toInt = [&](V v) { return hn::ConvertTo(DI(), hn::IfThenElseZero(where, v)); };
    return toInt(column) + toInt(row) * splatInt(columns);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
