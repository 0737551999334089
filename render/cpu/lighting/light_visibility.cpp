// Shadows and openness on lanes; this file is compiled once per instruction set.
//
// Spheres and boxes are tested exactly, so there is neither grain nor acne; their edge is softened over one pixel's
// width at least. Metaballs are looked up in the map that was cast from the light.
#include "render/cpu/lighting/light_visibility.h"

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/lighting/light_visibility.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_loads-inl.h"
#include "render/prepare/simd_occlusion-inl.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Points in the light's space.
struct LitPoints {
    V u, v, height;
    Vec3 position, normal;
    V pixelWidth;
    M facing;
};

V softened(V x) {
    const V t = clamp(hn::Add(x, splat(0.5F)), 0.0F, 1.0F);
    return hn::Mul(hn::Mul(t, t), hn::Sub(splat(3.0F), hn::Add(t, t)));
}

V sharp(V x) {
    return clamp(hn::Add(x, splat(0.5F)), 0.0F, 1.0F);
}

/// What one sphere covers of a strip one pixel wide around each ray to the light.
V coverOfSphere(float height, float radius, const LitPoints& at, V square, float softness) {
    const V drop = hn::Max(hn::Sub(splat(radius * radius), square), splat(0.0F));
    const V top = hn::Add(splat(height), hn::Sqrt(drop));
    // A point of this very sphere lies at `top`; one hundredth of a radius is far above the rounding and invisible.
    const M above = hn::Gt(top, hn::Add(at.height, splat(0.01F * radius)));
    // The light's grid leaves a tenth of a radius for the softened edge.
    V edge = clamp(at.pixelWidth, 1.0e-4F * radius, 0.2F * radius);
    const V depth = hn::Sub(splat(radius), hn::Sqrt(square));
    if (softness > 0.0F) {
        const V half = hn::Mul(splat(0.5F), hn::Sub(splat(height), at.height));
        edge = hn::Max(edge, hn::Mul(splat(softness), clamp(half, 0.0F, radius)));
        return hn::IfThenElseZero(above, softened(hn::Div(depth, edge)));
    }
    return hn::IfThenElseZero(above, sharp(hn::Div(depth, edge)));
}

/// What points on the light's plane lie within, and the lowest of them.
struct Spread {
    V lowU, highU, lowV, highV, bottom;

    Spread(const LitPoints& at, M here)
        : lowU(minOfLanes(at.u, here)),
          highU(hn::Neg(minOfLanes(hn::Neg(at.u), here))),
          lowV(minOfLanes(at.v, here)),
          highV(hn::Neg(minOfLanes(hn::Neg(at.v), here))),
          bottom(minOfLanes(at.height, here)) {}
};

/// Bits of those of a vector of spheres, from place k of the grid's on, that may cover points of this spread.
std::uint32_t coveringBits(const LightSpheres& spheres, std::size_t k, const Spread& spread) {
    const D d;
    const V zero = splat(0.0F);
    const V u = hn::LoadU(d, &spheres.u[k]);
    const V v = hn::LoadU(d, &spheres.v[k]);
    const V height = hn::LoadU(d, &spheres.height[k]);
    const V radius = hn::LoadU(d, &spheres.radius[k]);
    const V offU = hn::Max(hn::Max(hn::Sub(spread.lowU, u), hn::Sub(u, spread.highU)), zero);
    const V offV = hn::Max(hn::Max(hn::Sub(spread.lowV, v), hn::Sub(v, spread.highV)), zero);
    // Beyond half the widest edge nothing is covered; a little more than that for the rounding.
    const V farthest = hn::Mul(splat(1.501F), radius);
    const M near = hn::Lt(hn::Add(hn::Mul(offU, offU), hn::Mul(offV, offV)), hn::Mul(farthest, farthest));
    return maskBits(hn::And(near, hn::Ge(hn::Add(height, radius), spread.bottom)));
}

/// Of the spheres of one cell, for the points in it. The sum (not the product) closes the seam between two spheres that
/// touch.
V coverInCell(const LightGrid& grid, std::size_t cell, const LitPoints& at, M here, float softness) {
    const D d;
    const LightSpheres& spheres = grid.spheres;
    const Spread spread(at, here);
    const float bottom = hn::GetLane(spread.bottom);
    const auto end = static_cast<std::size_t>(grid.cells[cell].end);
    V cover = splat(0.0F);
    for (auto first = static_cast<std::size_t>(grid.cells[cell].begin); first < end; first += hn::Lanes(d)) {
        // Front to back: nothing further on the list reaches above the points.
        if (spheres.height[first] + spheres.radius[first] < bottom) break;
        const std::size_t left = std::min(end - first, hn::Lanes(d));
        for (std::uint32_t bits = coveringBits(spheres, first, spread) & ((1U << left) - 1U); bits != 0;
             bits &= bits - 1) {
            const std::size_t k = first + static_cast<std::size_t>(std::countr_zero(bits));
            const V offU = hn::Sub(at.u, splat(spheres.u[k]));
            const V offV = hn::Sub(at.v, splat(spheres.v[k]));
            const V square = hn::Add(hn::Mul(offU, offU), hn::Mul(offV, offV));
            cover = hn::Add(cover, coverOfSphere(spheres.height[k], spheres.radius[k], at, square, softness));
            if (hn::AllFalse(d, hn::And(here, hn::Lt(cover, splat(1.0F))))) return cover;
        }
    }
    return cover;
}

V coverOfSpheres(const LightGrid& grid, const LitPoints& at, float softness) {
    const D d;
    const DI di;
    const V inverse = splat(1.0F / grid.cellSize);
    const V column = hn::Floor(hn::Mul(hn::Sub(at.u, splat(grid.origin.x)), inverse));
    const V row = hn::Floor(hn::Mul(hn::Sub(at.v, splat(grid.origin.y)), inverse));
    const V zero = splat(0.0F);
    const M inGrid = hn::And(
        at.facing, hn::And(hn::And(hn::Ge(column, zero), hn::Lt(column, splat(static_cast<float>(grid.columns)))),
                           hn::And(hn::Ge(row, zero), hn::Lt(row, splat(static_cast<float>(grid.rows))))));
    const VI cell = hn::Add(hn::Mul(hn::ConvertTo(di, hn::IfThenElseZero(inGrid, row)), splatInt(grid.columns)),
                            hn::ConvertTo(di, hn::IfThenElseZero(inGrid, column)));
    alignas(64) std::array<std::int32_t, kTileSize> cells;
    hn::Store(cell, di, cells.data());
    V cover = zero;
    // Neighboring points mostly lie in one cell.
    for (M left = inGrid; !hn::AllFalse(d, left);) {
        const std::int32_t one = cells[static_cast<std::size_t>(hn::FindFirstTrue(d, left))];
        const M here = hn::And(left, floatMask(hn::Eq(cell, splatInt(one))));
        const V found = coverInCell(grid, static_cast<std::size_t>(one), at, here, softness);
        cover = hn::IfThenElse(here, found, cover);
        left = hn::AndNot(here, left);
    }
    return cover;
}

struct Slabs {
    V near, far;
};

/// The gap between entering one pair of faces and leaving another as a distance from the outline that they share.
V outlineGap(const Slabs& entered, const Slabs& left, float inverseA, float inverseB) {
    return hn::Mul(hn::Sub(left.far, entered.near), splat(1.0F / std::sqrt(inverseA * inverseA + inverseB * inverseB)));
}

// Seen from the light a box is a convex hexagon. For faces i (entered) and j (left) the gap between entry and exit,
// (b_j - p_j)/l_j - (a_i - p_i)/l_i, falls linearly with the distance to the hexagon's side; its gradient in p is
// e_i/l_i - e_j/l_j, of length sqrt(1/l_i^2 + 1/l_j^2). The least gap over that length is the signed distance to the
// outline.
V coverOfBox(const BoxObstacle& box, const Obstruction& obstruction, const LitPoints& at) {
    const glm::vec3 toLight = obstruction.light.toLight;
    glm::vec3 inverse;
    for (int axis = 0; axis < 3; ++axis)
        inverse[axis] = 1.0F / (std::abs(toLight[axis]) > 1.0e-6F ? toLight[axis] : 1.0e-6F);
    const glm::vec3 low = box.minimum - obstruction.eye;
    const glm::vec3 high = box.maximum - obstruction.eye;
    const auto slabs = [&](V position, int axis) {
        const V first = hn::Mul(hn::Sub(splat(low[axis]), position), splat(inverse[axis]));
        const V second = hn::Mul(hn::Sub(splat(high[axis]), position), splat(inverse[axis]));
        return Slabs{hn::Min(first, second), hn::Max(first, second)};
    };
    const Slabs x = slabs(at.position.x, 0);
    const Slabs y = slabs(at.position.y, 1);
    const Slabs z = slabs(at.position.z, 2);
    V inside = outlineGap(x, y, inverse.x, inverse.y);
    inside = hn::Min(inside, outlineGap(y, z, inverse.y, inverse.z));
    inside = hn::Min(inside, outlineGap(z, x, inverse.z, inverse.x));
    inside = hn::Min(inside, outlineGap(x, z, inverse.x, inverse.z));
    inside = hn::Min(inside, outlineGap(y, x, inverse.y, inverse.x));
    inside = hn::Min(inside, outlineGap(z, y, inverse.z, inverse.y));
    const V exit = hn::Min(x.far, hn::Min(y.far, z.far));
    const float tolerance = 1.0e-4F * length(box.maximum - box.minimum);
    V width = at.pixelWidth;
    V cover;
    if (obstruction.softness > 0.0F) {
        const V most = hn::Min(splat(obstruction.meanRadius), hn::Mul(splat(0.5F), exit));
        width = hn::Max(width, hn::Mul(splat(obstruction.softness), most));
        cover = softened(hn::Div(inside, hn::Max(width, splat(tolerance))));
    } else {
        cover = sharp(hn::Div(inside, hn::Max(width, splat(tolerance))));
    }
    return hn::IfThenElseZero(hn::Gt(exit, splat(tolerance)), cover);
}

/// Weights of six heights in a row, which stand half a texel apart, around a place that lies `behind` the third, 0 to 1
/// of these steps: a quadratic B-spline three texels wide.
struct HeightWeights {
    static constexpr std::size_t kCount = 6;
    V of[kCount];

    explicit HeightWeights(V behind) {
        const V half = splat(0.5F);
        const V off = hn::Mul(half, behind);
        // At 1.5 texels less this much from the place, and at places nearer to it.
        const auto side = [&](V rest) { return hn::Mul(splat(0.25F), hn::Mul(rest, rest)); };
        const auto middle = [&](V at) { return hn::Sub(splat(0.375F), hn::Mul(half, hn::Mul(at, at))); };
        of[0] = side(hn::Sub(half, off));
        of[1] = side(hn::Sub(splat(1.0F), off));
        of[2] = middle(off);
        of[3] = middle(hn::Sub(half, off));
        of[4] = side(hn::Add(half, off));
        of[5] = side(off);
    }
};

/// What is higher than points, in steps; start: of each point's first height.
V coverOfHeights(const DepthMap& map, VI start, const HeightWeights& across, const HeightWeights& down, VI steps) {
    V cover = splat(0.0F);
    for (const V& weight : down.of) {
        const Int6 heights = gather6(map.heights.data(), start);
        V sum = splat(0.0F);
        for (std::size_t k = 0; k < HeightWeights::kCount; ++k)
            sum = hn::Add(sum, hn::IfThenElseZero(floatMask(hn::Gt(heights.of[k], steps)), across.of[k]));
        cover = hn::Add(cover, hn::Mul(weight, sum));
        start = hn::Add(start, splatInt(2 * map.columns));
    }
    return cover;
}

// Weights change continuously with the point.
V coverOfField(const DepthMap& map, const Obstruction& obstruction, const LitPoints& at) {
    const D d;
    const DI di;
    const LightBasis& light = obstruction.light;
    // Off the surface by as much as the filter reaches sideways, so that a slope does not shade itself.
    const Vec3 raised = pointOnRay(at.position, splat(1.5F * map.texelSize), at.normal);
    const V inverse = splat(1.0F / map.texelSize);
    const V u = hn::Mul(hn::Sub(dot(raised, splat(light.u)), splat(map.origin.x)), inverse);
    const V v = hn::Mul(hn::Sub(dot(raised, splat(light.v)), splat(map.origin.y)), inverse);
    const V height = hn::Add(dot(raised, splat(light.toLight)), splat(0.5F * map.texelSize - map.bottom));
    // Nothing, at 0, is higher than no point.
    const V steps = hn::Max(hn::Add(hn::Div(height, splat(map.step)), splat(1.0F)), splat(0.0F));
    const V column = hn::Floor(u);
    const V row = hn::Floor(v);
    const V two = splat(2.0F);
    const M inMap = hn::And(hn::And(hn::Ge(column, two), hn::Lt(column, splat(static_cast<float>(map.columns - 2)))),
                            hn::And(hn::Ge(row, two), hn::Lt(row, splat(static_cast<float>(map.rows - 2)))));
    const auto placeOf = [&](V atColumn, V atRow, int columns) {
        const auto whole = [&](V place) { return hn::ConvertTo(di, hn::IfThenElseZero(inMap, place)); };
        return hn::Add(whole(atColumn), hn::Mul(whole(atRow), splatInt(columns)));
    };
    const VI texel = placeOf(column, row, map.columns);
    const M below = hn::And(inMap, hn::Lt(steps, hn::GatherIndex(d, map.highest.data(), texel)));
    if (hn::AllFalse(d, below)) return splat(0.0F);
    const M within = hn::And(below, hn::Ge(steps, hn::GatherIndex(d, map.lowest.data(), texel)));
    V cover = hn::IfThenElseZero(below, splat(1.0F));
    if (hn::AllFalse(d, within)) return cover;
    // From the first height, in their steps.
    const V half = splat(0.5F);
    const V fineU = hn::Sub(hn::Add(u, u), half);
    const V fineV = hn::Sub(hn::Add(v, v), half);
    const V fineColumn = hn::Floor(fineU);
    const V fineRow = hn::Floor(fineV);
    const VI start = placeOf(hn::Sub(fineColumn, two), hn::Sub(fineRow, two), 2 * map.columns);
    // Within the map's bounds, and so within those of its heights.
    const VI wholeSteps = hn::ConvertTo(di, hn::Floor(hn::IfThenElseZero(within, steps)));
    const V found = coverOfHeights(map, start, HeightWeights(hn::Sub(fineU, fineColumn)),
                                   HeightWeights(hn::Sub(fineV, fineRow)), wholeSteps);
    return hn::IfThenElse(within, found, cover);
}

V visibility(const Obstruction& obstruction, const LitPoints& at) {
    V cover = splat(0.0F);
    if (obstruction.spheres != nullptr)
        cover = hn::Add(cover, coverOfSpheres(*obstruction.spheres, at, obstruction.softness));
    for (const BoxObstacle& box : obstruction.boxes) cover = hn::Add(cover, coverOfBox(box, obstruction, at));
    if (obstruction.field != nullptr) cover = hn::Add(cover, coverOfField(*obstruction.field, obstruction, at));
    return hn::IfThenElseZero(at.facing, hn::Max(hn::Sub(splat(1.0F), cover), splat(0.0F)));
}

V openOfGround(const SkyVisibilityMap& map, glm::vec3 eye, const Vec3& position) {
    const D d;
    const DI di;
    const V inverse = splat(1.0F / map.side);
    const V x = hn::Mul(hn::Sub(position.x, splat(map.origin.x - eye.x)), inverse);
    const V z = hn::Mul(hn::Sub(position.z, splat(map.origin.y - eye.z)), inverse);
    const V column = hn::Floor(x);
    const V row = hn::Floor(z);
    const V zero = splat(0.0F);
    const M inMap = hn::And(hn::And(hn::Ge(column, zero), hn::Lt(column, splat(static_cast<float>(map.columns - 1)))),
                            hn::And(hn::Ge(row, zero), hn::Lt(row, splat(static_cast<float>(map.rows - 1)))));
    if (hn::AllFalse(d, inMap)) return splat(1.0F);
    const VI place = hn::Add(hn::ConvertTo(di, hn::IfThenElseZero(inMap, column)),
                             hn::Mul(hn::ConvertTo(di, hn::IfThenElseZero(inMap, row)), splatInt(map.columns)));
    const auto at = [&](int off) { return hn::GatherIndex(d, map.values.data(), hn::Add(place, splatInt(off))); };
    const V partX = hn::Sub(x, column);
    const V open = lerp(lerp(at(0), at(1), partX), lerp(at(map.columns), at(map.columns + 1), partX), hn::Sub(z, row));
    return hn::IfThenElse(inMap, open, splat(1.0F));
}

/// Sum over the axes of the squared component of the normal times the openness on its side.
V openOfObstacle(const SkyVisibilityGrid& grid, glm::vec3 eye, const Vec3& position, const Vec3& normal) {
    const D d;
    const Vec3 at = gridPosition(grid, eye, position);
    const std::array<V, 3> components = {normal.x, normal.y, normal.z};
    V open = splat(0.0F);
    for (std::size_t side = 0; side < 6; ++side) {
        const V component = components[side / 2];
        const bool isPlus = side % 2 == 0;
        const M toward = isPlus ? hn::Gt(component, splat(0.0F)) : hn::Lt(component, splat(0.0F));
        if (hn::AllFalse(d, toward)) continue;
        const V value = skyVisibilityInGrid(grid, side, at);
        open = hn::Add(open, hn::IfThenElseZero(toward, hn::Mul(hn::Mul(component, component), value)));
    }
    return open;
}

V skyVisibility(const Obstruction& obstruction, const Surfaces& surfaces, VI seen, const Vec3& position,
                const Vec3& normal) {
    const D d;
    V open = splat(1.0F);
    const M isGround = floatMask(hn::Eq(seen, splatInt(kSeesGround)));
    if (!hn::AllFalse(d, isGround))
        open = hn::IfThenElse(isGround, openOfGround(*obstruction.ground, obstruction.eye, position), open);
    const M isObstacle =
        floatMask(hn::And(hn::Gt(seen, splatInt(surfaces.firstObstacle - 1)), hn::Lt(seen, splatInt(kSeesField))));
    if (!hn::AllFalse(d, isObstacle))
        open = hn::IfThenElse(isObstacle, openOfObstacle(*obstruction.open, obstruction.eye, position, normal), open);
    return open;
}

void reach(const Obstruction& obstruction, const Surfaces& surfaces, const SurfacePoints& points, LightReach& found) {
    const D d;
    const DI di;
    const LightBasis& light = obstruction.light;
    for (std::size_t place = 0; place < points.count; place += hn::Lanes(d)) {
        const auto of = [place](const std::array<std::array<float, kTilePixels>, 3>& v) {
            return Vec3{hn::Load(D(), &v[0][place]), hn::Load(D(), &v[1][place]), hn::Load(D(), &v[2][place])};
        };
        const Vec3 position = of(points.position);
        const Vec3 normal = of(points.normal);
        const V width = splat(surfaces.frame.pixelWidth());
        const V pixelWidth = surfaces.frame.perspective ? hn::Mul(width, hn::Load(d, &points.depth[place])) : width;
        const M facing = hn::Gt(dot(normal, splat(light.toLight)), splat(0.0F));
        V lit = splat(0.0F);
        if (!hn::AllFalse(d, facing))
            lit = visibility(obstruction, {dot(position, splat(light.u)), dot(position, splat(light.v)),
                                           dot(position, splat(light.toLight)), position, normal, pixelWidth, facing});
        const VI seen = hn::Load(di, &points.seen[place]);
        const bool asks = obstruction.open != nullptr;
        const V sky = asks ? skyVisibility(obstruction, surfaces, seen, position, normal) : splat(1.0F);
        hn::Store(lit, d, &found.light[place]);
        hn::Store(sky, d, &found.sky[place]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(reach);

void reach(const Obstruction& obstruction, const Surfaces& surfaces, const SurfacePoints& points, LightReach& found) {
    HWY_DYNAMIC_DISPATCH(reach)(obstruction, surfaces, points, found);
}

}  // namespace render

#endif
