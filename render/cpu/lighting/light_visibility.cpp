// Shadows and ambient occlusion with Highway, one shading point per lane; this file is compiled once per instruction
// set.
//
// Spheres and boxes are tested exactly, so that there is neither noise nor shadow acne; the edge of their shadows is
// softened over at least one pixel's width. The shadows of metaballs and of meshes come from the depth maps that were
// drawn from the light.
#include "render/cpu/lighting/light_visibility.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/lighting/light_visibility.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/lighting/box_shadows-inl.h"
#include "render/cpu/lighting/glow_light-inl.h"
#include "render/cpu/lighting/receivers-inl.h"
#include "render/cpu/raster/simd_loads-inl.h"
#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/lighting/simd_occlusion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// How much one sphere covers of a strip around each ray to the light, as wide as a pixel or as the soft edge.
/// @param square  squared distance of the sphere's center from the ray, m^2
V sphereCoverage(float height, float radius, const Receivers& at, V square, float softness) {
    const V drop = hn::Max(splat(radius * radius) - square, splat(0.0F));
    const V top = splat(height) + hn::Sqrt(drop);
    // A point on the sphere itself lies at `top`. The tolerance of a hundredth of a radius (chosen) is far above the
    // rounding and cannot be seen.
    const M isAbove = top > at.height + splat(0.01F * radius);
    // The edge reaches at most a tenth of a radius beyond the sphere, for which lightGrid() leaves a margin.
    V edge = clamp(at.pixelWidth, 1.0e-4F * radius, 0.2F * radius);
    const V inside = splat(radius) - hn::Sqrt(square);
    if (softness <= 0.0F) return hn::IfThenElseZero(isAbove, sharpEdge(inside / edge));
    const V half = splat(0.5F) * (splat(height) - at.height);
    edge = hn::Max(edge, splat(softness) * clamp(half, 0.0F, radius));
    return hn::IfThenElseZero(isAbove, softEdge(inside / edge));
}

/// A bit for each of the grid's spheres first, first + 1, ..., set if it may cover receivers within these bounds.
std::uint32_t coveringSpheres(const LightSpheres& spheres, std::size_t first, const ReceiverBounds& bounds) {
    const D d;
    const V zero = splat(0.0F);
    const V u = hn::LoadU(d, &spheres.u[first]);
    const V v = hn::LoadU(d, &spheres.v[first]);
    const V height = hn::LoadU(d, &spheres.height[first]);
    const V radius = hn::LoadU(d, &spheres.radius[first]);
    const V offU = hn::Max(hn::Max(bounds.lowU - u, u - bounds.highU), zero);
    const V offV = hn::Max(hn::Max(bounds.lowV - v, v - bounds.highV), zero);
    // A sphere covers nothing farther away than its radius and half the width of the widest edge, which is a radius
    // wide; 0.001 more for the rounding.
    const V farthest = splat(1.501F) * radius;
    const M isNear = offU * offU + offV * offV < farthest * farthest;
    return maskBits(hn::And(isNear, height + radius >= bounds.bottom));
}

/// Coverage by the spheres of one cell of the grid, for the receivers in it. The coverages of spheres are added, not
/// multiplied, which closes the seam between two spheres that touch.
V cellCoverage(const LightGrid& grid, std::size_t cell, const Receivers& at, M where, float softness) {
    const D d;
    const LightSpheres& spheres = grid.spheres;
    const ReceiverBounds bounds(at, where);
    const float bottom = hn::GetLane(bounds.bottom);
    const std::size_t end = grid.begin[cell + 1];
    V coverage = splat(0.0F);
    for (std::size_t first = grid.begin[cell]; first < end; first += hn::Lanes(d)) {
        // Spheres are listed from the light on: none of the later ones reaches above the receivers.
        if (spheres.height[first] + spheres.radius[first] < bottom) break;
        const std::size_t count = std::min(end - first, hn::Lanes(d));
        for (std::uint32_t bits = coveringSpheres(spheres, first, bounds) & ((1U << count) - 1U); bits != 0;
             bits &= bits - 1) {
            const std::size_t k = first + static_cast<std::size_t>(std::countr_zero(bits));
            const V offU = at.u - splat(spheres.u[k]);
            const V offV = at.v - splat(spheres.v[k]);
            const V square = offU * offU + offV * offV;
            coverage = coverage + sphereCoverage(spheres.height[k], spheres.radius[k], at, square, softness);
            if (none(hn::And(where, coverage < splat(1.0F)))) return coverage;
        }
    }
    return coverage;
}

V spheresCoverage(const LightGrid& grid, const Receivers& at, float softness) {
    const D d;
    const V inverse = splat(1.0F / grid.cellSize);
    const V column = hn::Floor((at.u - splat(grid.origin.x)) * inverse);
    const V row = hn::Floor((at.v - splat(grid.origin.y)) * inverse);
    const M inGrid = hn::And(at.isFacing, isWithin(column, row, 0.0F, grid.columns, grid.rows));
    const VI cell = cellIndex(column, row, grid.columns, inGrid);
    alignas(64) std::array<std::int32_t, kTileSize> cells;
    storeInt(cell, cells.data());
    V coverage = splat(0.0F);
    // Points are handled cell by cell, because neighboring points mostly lie in the same cell.
    for (M left = inGrid; !none(left);) {
        const std::int32_t one = cells[static_cast<std::size_t>(hn::FindFirstTrue(d, left))];
        const M where = hn::And(left, floatMask(cell == splatInt(one)));
        const V found = cellCoverage(grid, static_cast<std::size_t>(one), at, where, softness);
        coverage = hn::IfThenElse(where, found, coverage);
        left = hn::AndNot(where, left);
    }
    return coverage;
}

/// Weights of six heights in a row of the depth map, half a texel apart: a quadratic B-spline, three texels wide,
/// around a point between the third and the fourth height.
/// @param behind  distance of the point from the third height, in half texels, 0 to 1
struct HeightWeights {
    std::array<V, 6> of;

    explicit HeightWeights(V behind) {
        const V half = splat(0.5F);
        const V off = half * behind;
        // Value of the spline at a distance of 1.5 - rest texels from its center, and at a distance below half a texel.
        const auto outer = [&](V rest) { return splat(0.25F) * (rest * rest); };
        const auto inner = [&](V distance) { return splat(0.375F) - half * (distance * distance); };
        of[0] = outer(half - off);
        of[1] = outer(splat(1.0F) - off);
        of[2] = inner(off);
        of[3] = inner(half - off);
        of[4] = outer(half + off);
        of[5] = outer(off);
    }
};

/// Sum of the weights of those heights of the depth map that lie above a point.
/// @param start   index of the first of the heights around each point
/// @param height  height of each point, in steps of the map
V weightAbove(const DepthMap& map, VI start, const HeightWeights& across, const HeightWeights& down, VI height) {
    V coverage = splat(0.0F);
    for (const V& weight : down.of) {
        const std::array<VI, 6> heights = gather6(map.heights.data(), start);
        V sum = splat(0.0F);
        for (std::size_t k = 0; k < heights.size(); ++k)
            sum = sum + hn::IfThenElseZero(floatMask(heights[k] > height), across.of[k]);
        coverage = coverage + weight * sum;
        start = start + splatInt(2 * map.columns);
    }
    return coverage;
}

/// Percentage-closer filtering of the depth map, with weights that change continuously with the point.
/// @param isMesh  whether the map is that of meshes: then it has no surface that light reaches
V mapCoverage(const DepthMap& map, const Occluders& occluders, const Receivers& at, bool isMesh) {
    const D d;
    const LightBasis& light = occluders.light;
    // The point is raised off the surface by as much as the filter reaches sideways, so that a slope does not shade
    // itself. Above the surfaces of meshes that light does not reach it need not be farther than a plane rises
    // sideways.
    V lift = splat(1.5F * map.texelSize);
    if (isMesh) {
        const V cosine = dot(at.normal, splat(light.toLight));
        lift = lift * hn::Sqrt(hn::Max(splat(1.0F) - cosine * cosine, splat(0.0F)));
    }
    const float above = isMesh ? 0.0F : 0.5F * map.texelSize;
    const Vec3 raised = pointOnRay(at.position, lift, at.normal);
    const V inverse = splat(1.0F / map.texelSize);
    const V u = (dot(raised, splat(light.u)) - splat(map.origin.x)) * inverse;
    const V v = (dot(raised, splat(light.v)) - splat(map.origin.y)) * inverse;
    const V height = dot(raised, splat(light.toLight)) + splat(above - map.bottom);
    // The map's height 0, which stands for no surface, is above no point.
    const V steps = hn::Max(height / splat(map.step) + splat(1.0F), splat(0.0F));
    const V column = hn::Floor(u);
    const V row = hn::Floor(v);
    const M inMap = isWithin(column, row, 2.0F, map.columns - 2, map.rows - 2);
    const VI texel = cellIndex(column, row, map.columns, inMap);
    const M isBelowSome = hn::And(inMap, steps < hn::GatherIndex(d, map.highest.data(), texel));
    if (none(isBelowSome)) return splat(0.0F);
    const M isBetween = hn::And(isBelowSome, steps >= hn::GatherIndex(d, map.lowest.data(), texel));
    const V coverage = hn::IfThenElseZero(isBelowSome, splat(1.0F));
    if (none(isBetween)) return coverage;
    // Positions in half texels from the first height of a row or column.
    const V fineU = u + u - splat(0.5F);
    const V fineV = v + v - splat(0.5F);
    const V fineColumn = hn::Floor(fineU);
    const V fineRow = hn::Floor(fineV);
    const VI start = cellIndex(fineColumn - splat(2.0F), fineRow - splat(2.0F), 2 * map.columns, inMap);
    // A height between the map's lowest and highest one, in steps, fits into an integer.
    const VI wholeSteps = hn::ConvertTo(DI(), hn::Floor(hn::IfThenElseZero(isBetween, steps)));
    const V found =
        weightAbove(map, start, HeightWeights(fineU - fineColumn), HeightWeights(fineV - fineRow), wholeSteps);
    return hn::IfThenElse(isBetween, found, coverage);
}

/// Light that reaches points.
struct ReachingLight {
    V share;    // greatest share of a channel
    Vec3 tint;  // share of each channel, over that
};

/// 2 to the power of -depth, by the polynomial of exp2Of() in portable_exponentials.h. @pre depth >= 0
HWY_INLINE V transmission(V depth) {
    const V power = hn::Max(hn::Neg(depth), splat(-100.0F));
    const V whole = hn::Floor(power);
    const V y = (power - whole - splat(0.5F)) * splat(0.69314718F);
    V series = splat(1.0F / 720.0F);
    for (const float coefficient : {1.0F / 120.0F, 1.0F / 24.0F, 1.0F / 6.0F, 0.5F, 1.0F, 1.0F})
        series = splat(coefficient) + y * series;
    const VI exponent = hn::ShiftLeft<23>(hn::ConvertTo(DI(), whole) + splatInt(127));
    return splat(1.41421356F) * series * hn::BitCast(D(), exponent);
}

/// The share of light of each color that the columns of metaballs along the light let through.
Vec3 transmissionAt(const OpticalDepthMap& map, const Receivers& at) {
    const V inverse = splat(1.0F / map.texelSize);
    const V u = (at.u - splat(map.origin.x)) * inverse;
    const V v = (at.v - splat(map.origin.y)) * inverse;
    const V column = hn::Floor(u);
    const V row = hn::Floor(v);
    const M inMap = isWithin(column, row, 0.0F, map.columns - 1, map.rows - 1);
    const VI first = cellIndex(column, row, map.columns, inMap) * splatInt(3);
    const auto channel = [&](int offset) {
        const auto texel = [&](int index) {
            return hn::GatherIndex(D(), map.depths.data(), first + splatInt(3 * index + offset));
        };
        const V above = lerp(texel(0), texel(1), u - column);
        const V below = lerp(texel(map.columns), texel(map.columns + 1), u - column);
        return transmission(hn::IfThenElseZero(inMap, lerp(above, below, v - row)));
    };
    return {channel(0), channel(1), channel(2)};
}

/// Splits the light of each channel into a common share and a tint.
ReachingLight splitLight(const Vec3& light) {
    const V share = hn::Max(hn::Max(light.x, light.y), hn::Max(light.z, splat(0.0F)));
    const V inverse = hn::IfThenElseZero(share > splat(0.0F), splat(1.0F) / hn::Max(share, splat(1e-30F)));
    const auto tint = [&](V channel) { return hn::Max(channel, splat(0.0F)) * inverse; };
    return {share, {tint(light.x), tint(light.y), tint(light.z)}};
}

ReachingLight lightAt(const Occluders& occluders, const Receivers& at) {
    const V one = splat(1.0F);
    const Vec3 white{one, one, one};
    V coverage = splat(0.0F);
    if (occluders.spheres != nullptr) coverage = coverage + spheresCoverage(*occluders.spheres, at, occluders.softness);
    if (occluders.lightBoxes != nullptr) coverage = coverage + boxesCoverage(occluders, at);
    if (occluders.opticalDepth != nullptr) {
        if (occluders.meshes != nullptr) coverage = coverage + mapCoverage(*occluders.meshes, occluders, at, true);
        const V metaballs = mapCoverage(*occluders.metaballs, occluders, at, false);
        const Vec3 through = transmissionAt(*occluders.opticalDepth, at) * splat(occluders.transparency);
        ReachingLight light = splitLight(white * (one - coverage) - (white - through) * metaballs);
        light.share = hn::IfThenElseZero(at.isFacing, light.share);
        return light;
    }
    if (occluders.metaballs != nullptr) coverage = coverage + mapCoverage(*occluders.metaballs, occluders, at, false);
    if (occluders.meshes != nullptr) coverage = coverage + mapCoverage(*occluders.meshes, occluders, at, true);
    return {hn::IfThenElseZero(at.isFacing, hn::Max(one - coverage, splat(0.0F))), white};
}

V groundSkyVisibility(const SkyVisibilityMap& map, glm::vec3 eye, const Vec3& position) {
    const D d;
    const V inverse = splat(1.0F / map.side);
    const V x = (position.x - splat(map.origin.x - eye.x)) * inverse;
    const V z = (position.z - splat(map.origin.y - eye.z)) * inverse;
    const V column = hn::Floor(x);
    const V row = hn::Floor(z);
    const M inMap = isWithin(column, row, 0.0F, map.columns - 1, map.rows - 1);
    if (none(inMap)) return splat(1.0F);
    const VI first = cellIndex(column, row, map.columns, inMap);
    const auto at = [&](int offset) { return hn::GatherIndex(d, map.values.data(), first + splatInt(offset)); };
    const V partX = x - column;
    const V open = lerp(lerp(at(0), at(1), partX), lerp(at(map.columns), at(map.columns + 1), partX), z - row);
    return hn::IfThenElse(inMap, open, splat(1.0F));
}

V obstacleSkyVisibility(const SkyVisibilityGrid& grid, glm::vec3 eye, const Vec3& position, const Vec3& normal) {
    const V zero = splat(0.0F);
    const Vec3 at = gridPosition(grid, eye, position);
    // Only the sides of the cubes that some normal points to are looked up.
    const auto visibility = [&](std::size_t side, M isToward) {
        return none(isToward) ? zero : skyVisibilityInGrid(grid, side, at);
    };
    const Vec3 plus{visibility(0, normal.x > zero), visibility(2, normal.y > zero), visibility(4, normal.z > zero)};
    const Vec3 minus{visibility(1, normal.x < zero), visibility(3, normal.y < zero), visibility(5, normal.z < zero)};
    return skyVisibilityToward(normal, plus, minus);
}

V skyVisibilityAt(const Occluders& occluders, const ShadingGeometry& geometry, VI hitId, const Vec3& position,
                  const Vec3& normal) {
    V sky = splat(1.0F);
    const M isGround = floatMask(hitId == splatInt(kHitGround));
    if (!none(isGround))
        sky = hn::IfThenElse(isGround, groundSkyVisibility(*occluders.groundSky, occluders.eye, position), sky);
    const M isObstacle =
        floatMask(hn::And(hitId > splatInt(geometry.firstObstacle - 1), hitId < splatInt(kHitMetaballs)));
    if (!none(isObstacle))
        sky = hn::IfThenElse(isObstacle, obstacleSkyVisibility(*occluders.sky, occluders.eye, position, normal), sky);
    if (occluders.transparency == 0.0F) return sky;
    return splat(1.0F) - splat(1.0F - occluders.transparency) * (splat(1.0F) - sky);
}

void computeLightVisibility(const Occluders& occluders, const ShadingGeometry& geometry, const ShadingPoints& points,
                            LightVisibility& visibility) {
    const D d;
    const LightBasis& light = occluders.light;
    const V width = splat(geometry.frame.pixelWidth());
    visibility.hasGlow = occluders.glow != nullptr;
    for (std::size_t first = 0; first < points.count; first += hn::Lanes(d)) {
        const Vec3 position = loadVec3(points.position, first);
        const Vec3 normal = loadVec3(points.normal, first);
        const V pixelWidth = geometry.frame.perspective ? width * load(&points.depth[first]) : width;
        const M isFacing = dot(normal, splat(light.toLight)) > splat(0.0F);
        ReachingLight lit{splat(0.0F), splat(glm::vec3(1.0F))};
        if (!none(isFacing))
            lit = lightAt(occluders, {dot(position, splat(light.u)), dot(position, splat(light.v)),
                                      dot(position, splat(light.toLight)), position, normal, pixelWidth, isFacing});
        const VI hitId = loadInt(&points.hitId[first]);
        const V sky =
            occluders.sky != nullptr ? skyVisibilityAt(occluders, geometry, hitId, position, normal) : splat(1.0F);
        store(lit.share, &visibility.light[first]);
        if (occluders.opticalDepth != nullptr) storeVec3(lit.tint, visibility.tint, first);
        store(sky, &visibility.sky[first]);
        if (visibility.hasGlow)
            storeVec3(glowLightAt(*occluders.glow, occluders.eye, position, normal), visibility.glow, first);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(computeLightVisibility);

void computeLightVisibility(const Occluders& occluders, const ShadingGeometry& geometry, const ShadingPoints& points,
                            LightVisibility& visibility) {
    HWY_DYNAMIC_DISPATCH(computeLightVisibility)(occluders, geometry, points, visibility);
}

}  // namespace render

#endif
