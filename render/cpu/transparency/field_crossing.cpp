// A ray walks through the grid cell by cell. In each, the balls that it meets there are collected from the cells
// around, and their kernels along the ray are added up at samples, 16 balls at a time. This file is compiled once per
// instruction set.
//
// At the distance t the square root of a ball's kernel is  w - u^2  with  u = t s - c,  where s is the ball's slope,
// c/s the distance at which the ray comes closest to its center, and w = peak - (closest distance)^2 s^2. The root of
// an ellipsoid is peak - d^T F d, d being the vector from its center and F its form. For a ray in the direction e it
// has the same terms, with s^2 = e^T F e, c/s = (toCenter^T F e)/s^2, and w the root there. Hence the field and its
// derivative:
//   F = sum max(0, w - u^2)^2,     F' = -4 sum max(0, w - u^2) u s.
#include "render/cpu/transparency/field_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "render/cpu/transparency/grid_walk.h"
#include "render/prepare/cells/tiles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/transparency/field_crossing.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/cells/simd_sums-inl.h"

#ifndef RENDER_FIELD_CROSSING_TYPES
#define RENDER_FIELD_CROSSING_TYPES
namespace render {

/// The balls that a ray meets within a cell, in whole blocks, of which the last is filled up with balls of no kernel.
struct MetBalls {
    std::size_t count = 0;  ///< without those that fill the last block
    std::vector<float> w, c, s;
    std::vector<std::int32_t> sortedIndex;  ///< index of each ball in BallCells

    void reserve(std::size_t most) {
        if (w.size() >= most) return;
        for (std::vector<float>* values : {&w, &c, &s}) values->resize(2 * most);
        sortedIndex.resize(2 * most);
    }
};

/// The field and its derivative at a distance on a ray.
struct FieldOnRay {
    float distance = 0.0F;
    float field = 0.0F;
    float slope = 0.0F;
};

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The forms of a vector of ellipsoids. (A SymmetricMatrix would not be compiled for the instruction set.)
struct Forms {
    V xx, yy, zz, xy, xz, yz;

    Forms(const BallCells& cells, std::size_t first)
        : xx(entry(cells, 0, first)),
          yy(entry(cells, 1, first)),
          zz(entry(cells, 2, first)),
          xy(entry(cells, 3, first)),
          xz(entry(cells, 4, first)),
          yz(entry(cells, 5, first)) {}

    Vec3 times(const Vec3& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
    }

 private:
    static V entry(const BallCells& cells, std::size_t which, std::size_t first) {
        return hn::LoadU(D(), &cells.form[which][first]);
    }
};

/// Appends those of the balls with the sorted indices from `first` to `end` whose kernels a part of a ray meets.
/// @tparam kIsAnisotropic  whether balls are ellipsoids
template <bool kIsAnisotropic>
void addMet(const BallCells& cells, std::size_t first, std::size_t end, const RayPart& ray, MetBalls& met) {
    const D d;
    const DI di;
    const VI lane = hn::Iota(di, 0);
    float* const toW = met.w.data();
    float* const toC = met.c.data();
    float* const toS = met.s.data();
    std::int32_t* const toIndex = met.sortedIndex.data();
    std::size_t count = met.count;
    const Vec3 origin = splat(ray.origin);
    const Vec3 direction = splat(ray.direction);
    for (; first < end; first += hn::Lanes(d)) {
        const auto loadFrom = [&](const std::vector<float>& values) { return hn::LoadU(d, &values[first]); };
        const Vec3 toCenter = Vec3{loadFrom(cells.x), loadFrom(cells.y), loadFrom(cells.z)} - origin;
        V s, closest, drop;
        if constexpr (kIsAnisotropic) {
            const Forms form(cells, first);
            const Vec3 turned = form.times(direction);
            const V square = dot(direction, turned);
            s = hn::Sqrt(square);
            // The forms that follow the last ball's are 0.
            closest = dot(toCenter, turned) / hn::Max(square, splat(1e-30F));
            const Vec3 off = toCenter - direction * closest;
            drop = dot(off, form.times(off));
        } else {
            s = loadFrom(cells.slope);
            closest = dot(toCenter, direction);
            const Vec3 off = toCenter - direction * closest;
            drop = dot(off, off) * (s * s);
        }
        const V w = loadFrom(cells.peak) - drop;
        const V c = closest * s;
        const V u = hn::Min(hn::Max(closest, splat(ray.from)), splat(ray.to)) * s - c;
        const M isMet = hn::And(w > u * u, hn::FirstN(d, end - first));
        if (none(isMet)) continue;
        const VI index = lane + splatInt(static_cast<std::int32_t>(first));
        // Compressing within the register and storing all of it is faster than compressed stores to memory.
        hn::StoreU(hn::Compress(w, isMet), d, toW + count);
        hn::StoreU(hn::Compress(c, isMet), d, toC + count);
        hn::StoreU(hn::Compress(s, isMet), d, toS + count);
        hn::StoreU(hn::Compress(index, hn::RebindMask(di, isMet)), di, toIndex + count);
        count += hn::CountTrue(d, isMet);
    }
    met.count = count;
}

/// Collects the balls that a part of a ray meets within a cell.
void collect(const BallCells& cells, glm::ivec3 cell, const RayPart& ray, MetBalls& met) {
    const glm::ivec3 low = max(cell - 1, glm::ivec3(0));
    const glm::ivec3 high = min(cell + 1, cells.count - 1);
    met.count = 0;
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            const std::size_t first = cells.begin[cellIndex(cells.count, low.x, y, z)];
            const std::size_t end = cells.begin[cellIndex(cells.count, high.x, y, z) + 1];
            // Whole vectors are stored, and a block to fill up the last.
            met.reserve(met.count + (end - first) + 2 * kBlock);
            cells.isAnisotropic() ? addMet<true>(cells, first, end, ray, met)
                                  : addMet<false>(cells, first, end, ray, met);
        }
    }
    std::fill_n(&met.w[met.count], kBlock, -1.0F);
    std::fill_n(&met.c[met.count], kBlock, 0.0F);
    std::fill_n(&met.s[met.count], kBlock, 0.0F);
}

FieldOnRay sampleAt(const MetBalls& met, float distance) {
    const D d;
    const V zero = splat(0.0F);
    const V at = splat(distance);
    BlockSum field, slope;
    field.fill(zero);
    slope.fill(zero);
    for (std::size_t block = 0; block < met.count; block += kBlock) {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) {
            const std::size_t k = block + v * hn::Lanes(d);
            const V s = hn::LoadU(d, &met.s[k]);
            const V u = at * s - hn::LoadU(d, &met.c[k]);
            const V root = hn::Max(hn::LoadU(d, &met.w[k]) - u * u, zero);
            field[v] = field[v] + root * root;
            slope[v] = slope[v] - root * (u * s);
        }
    }
    return {distance, total(field), 4.0F * total(slope)};
}

/// A bound of the field on a part of a ray: inside the metaballs one that it is nowhere below, outside one that it is
/// nowhere above. The root of a kernel is a parabola that opens downward: its least value is at an end of the part, its
/// greatest where the ray comes closest to the ball, or at the end nearest to that.
float boundOn(const MetBalls& met, float from, float to, bool isInside) {
    const D d;
    const V zero = splat(0.0F);
    BlockSum bound;
    bound.fill(zero);
    for (std::size_t block = 0; block < met.count; block += kBlock) {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) {
            const std::size_t k = block + v * hn::Lanes(d);
            const V s = hn::LoadU(d, &met.s[k]);
            const V c = hn::LoadU(d, &met.c[k]);
            const V atFrom = splat(from) * s - c;
            const V atTo = splat(to) * s - c;
            const V farthest = hn::Max(hn::Abs(atFrom), hn::Abs(atTo));
            const V nearest = hn::Max(hn::Max(atFrom, hn::Neg(atTo)), zero);
            const V u = isInside ? farthest : nearest;
            const V root = hn::Max(hn::LoadU(d, &met.w[k]) - u * u, zero);
            bound[v] = bound[v] + root * root;
        }
    }
    return total(bound);
}

/// Whether a sample is on the other side of the threshold than the ray.
bool isAcross(const FieldOnRay& sample, float threshold, bool isInside) {
    return (sample.field >= threshold) != isInside;
}

/// The distance between two samples at which the field has the threshold: Newton's steps from the far sample, halved
/// where they leave the interval.
float refined(const MetBalls& met, float threshold, FieldOnRay near, FieldOnRay far, bool isInside) {
    constexpr int kMostSteps = 16;  // enough for bisection alone to reach a float's precision
    const float precise = 1e-4F * (far.distance - near.distance);
    FieldOnRay at = std::abs(near.field - threshold) < std::abs(far.field - threshold) ? near : far;
    for (int k = 0; k < kMostSteps && far.distance - near.distance > precise; ++k) {
        float next = at.distance - (at.field - threshold) / at.slope;
        if (!(next > near.distance && next < far.distance)) next = 0.5F * (near.distance + far.distance);
        const float moved = std::abs(next - at.distance);
        at = sampleAt(met, next);
        (isAcross(at, threshold, isInside) ? far : near) = at;
        if (moved < precise) break;
    }
    return at.distance;
}

/// The first sample on the other side of the threshold between two samples on the ray's side, if the field turns back
/// between them: at the extremum of the cubic through both samples' values and slopes.
bool findTurn(const MetBalls& met, float threshold, const FieldOnRay& a, const FieldOnRay& b, bool isInside,
              FieldOnRay& turn) {
    const float sign = isInside ? -1.0F : 1.0F;
    if (!(sign * a.slope > 0.0F && sign * b.slope < 0.0F)) return false;
    // The secant of the slopes is near enough to the extremum: a body or a gap that it misses is thinner still.
    turn = sampleAt(met, a.distance + (b.distance - a.distance) * (a.slope / (a.slope - b.slope)));
    return isAcross(turn, threshold, isInside);
}

/// Stands for the slope of the field where only a bound of the field is known.
constexpr float kNotSampled = std::numeric_limits<float>::max();

/// The distance at which a part of a ray within one cell crosses the threshold. Where bounds show that it does not, the
/// ray advances by up to four steps at a time; elsewhere the field is sampled at every step.
float crossingInCell(const CastField& field, const MetBalls& met, const RayPart& part, bool isInside) {
    if (met.count == 0) return isInside ? part.from : kNoCrossing;
    FieldOnRay last = sampleAt(met, part.from);
    if (isAcross(last, field.threshold, isInside)) return part.from;
    float advance = 4.0F * field.step;
    while (last.distance < part.to) {
        const float to = std::min(last.distance + advance, part.to);
        const float bound = boundOn(met, last.distance, to, isInside);
        if (isInside ? bound >= field.threshold : bound < field.threshold) {
            last = {to, bound, kNotSampled};
            advance = std::min(2.0F * advance, 4.0F * field.step);
            continue;
        }
        if (advance > field.step) {
            advance *= 0.5F;
            continue;
        }
        if (last.slope == kNotSampled) last = sampleAt(met, last.distance);
        const FieldOnRay next = sampleAt(met, to);
        FieldOnRay turn;
        if (isAcross(next, field.threshold, isInside)) return refined(met, field.threshold, last, next, isInside);
        if (findTurn(met, field.threshold, last, next, isInside, turn))
            return refined(met, field.threshold, last, turn, isInside);
        last = next;
    }
    return kNoCrossing;
}

/// Sets the normal of a point of the surface and the shares of its balls.
void setSurface(const CastField& field, const RayPart& ray, const MetBalls& met, SurfacePoint& found) {
    const BallCells& cells = field.cells;
    const glm::vec3 point = ray.origin + found.distance * ray.direction;
    glm::vec3 downhill(0.0F);
    for (std::size_t k = 0; k < met.count; ++k) {
        const float u = found.distance * met.s[k] - met.c[k];
        const float root = met.w[k] - u * u;
        if (root <= 0.0F) continue;
        const auto ball = static_cast<std::size_t>(met.sortedIndex[k]);
        const glm::vec3 off = point - glm::vec3(cells.x[ball], cells.y[ball], cells.z[ball]);
        downhill += root * (cells.isAnisotropic() ? cells.formOf(ball).times(off) : met.s[k] * met.s[k] * off);
        found.shares.push_back({cells.particle[ball], root * root});
    }
    const float square = dot(downhill, downhill);
    found.normal = square > 0.0F ? downhill * (1.0F / std::sqrt(square)) : -ray.direction;
}

void findCrossing(const CastField& field, const RayPart& ray, bool isInside, SurfacePoint& found) {
    thread_local MetBalls met;
    found.distance = kNoCrossing;
    found.shares.clear();
    const auto finish = [&](float distance, const RayPart& part) {
        found.distance = distance;
        setSurface(field, part, met, found);
    };
    GridWalk walk(field.cells, ray);
    for (; !walk.isOver(); walk.next()) {
        const RayPart part = walk.part();
        collect(field.cells, walk.cell(), part, met);
        const float distance = crossingInCell(field, met, part, isInside);
        if (distance != kNoCrossing) return finish(distance, part);
    }
    // Outside of the grid is no ball: a ray that is inside leaves the metaballs where the grid ends.
    met.count = 0;
    if (isInside && walk.end() < ray.to) finish(std::max(walk.end(), ray.from), ray);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(findCrossing);

void findCrossing(const CastField& field, const RayPart& ray, bool isInside, SurfacePoint& found) {
    HWY_DYNAMIC_DISPATCH(findCrossing)(field, ray, isInside, found);
}

}  // namespace render

#endif
