// A ray walks through the cells of the field. Where the field is surely on the ray's side of the threshold it is not
// evaluated; in the subcells that the surface may pass through it is sampled, 16 balls at a time. This file is
// compiled once per instruction set.
//
// With the root w = peak - d^T F d of each ball's kernel at a point, d being the vector from its center and F its form,
// the field and its derivative along the direction e of the ray are sums over the balls with w > 0:
//   sum w^2,     -4 e^T g  with  g = sum w F d,
// where g is along the normal that points out of the metaballs.
#include "render/cpu/transparency/field_crossing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "render/cpu/transparency/ball_cache.h"
#include "render/cpu/transparency/grid_walk.h"
#include "render/prepare/cells/tiles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/transparency/field_crossing.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/rays/ball_set-inl.h"

#ifndef RENDER_FIELD_CROSSING_TYPES
#define RENDER_FIELD_CROSSING_TYPES
namespace render {

/// Stands for the slope of the field where only its side of the threshold is known.
constexpr float kNotSampled = std::numeric_limits<float>::max();

/// The field and its derivative at a distance on a ray.
struct FieldOnRay {
    float distance = 0.0F;
    float field = 0.0F;
    float slope = kNotSampled;
    glm::vec3 outward{0.0F};  ///< g: along the normal
};

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

template <bool kIsAnisotropic>
FieldOnRay sampleAt(const BallSet& balls, const RayPart& ray, float distance) {
    const V zero = splat(0.0F);
    const Vec3 point = splat(ray.origin + distance * ray.direction);
    SetSum field, x, y, z;
    for (std::size_t block = 0; block < balls.size(); block += kBlock) {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) {
            const BallTerms<kIsAnisotropic> at(balls, block + v * hn::Lanes(D()), point);
            const V root = hn::Max(at.root, zero);
            field.add(v, root * root);
            x.add(v, root * at.turned.x);
            y.add(v, root * at.turned.y);
            z.add(v, root * at.turned.z);
        }
    }
    const glm::vec4 sums = totals(x, y, z, field);
    const glm::vec3 outward(sums);
    return {distance, sums.w, -4.0F * dot(outward, ray.direction), outward};
}

/// The search for the first crossing on a ray.
template <bool kIsAnisotropic>
class CrossingSearch {
 public:
    CrossingSearch(const CastField& field, const RayPart& ray, bool isInside)
        : field_(field),
          ray_(ray),
          isInside_(isInside),
          inverse_(inverseOf(ray.direction)),
          inverseStep_(1.0F / field.step) {}

    SurfacePoint find() {
        const BallCells& cells = field_.cells;
        GridWalk walk({cells.low, cells.side, cells.count}, ray_, inverse_);
        for (; !walk.isOver(); walk.next()) {
            cell_ = walk.cell();
            const std::int32_t block = field_.sides.blocks[walk.index()];
            if (block >= 0 ? crossesBlock(walk, block) : crossesAll(walk.from(), block)) return found_;
        }
        // Outside of the grid is no ball: a ray that is inside leaves the metaballs where the grid ends.
        if (isInside_ && walk.end() < ray_.to) setFound({std::max(walk.end(), ray_.from), 0.0F, 0.0F, {}}, nullptr);
        return found_;
    }

 private:
    /// Passes a block or subcell that is on one side of the threshold. @return whether that is not the ray's
    bool crossesAll(float from, std::int32_t side) {
        isFirst_ = false;
        last_.slope = kNotSampled;
        if ((side == kAllInside) == isInside_) return false;
        const BallSet& balls = field_.cache.around(field_.cells, cell_);
        return setFound(sampleAt<kIsAnisotropic>(balls, ray_, from), &balls);
    }

    /// Passes the subcells of a block. @return whether the ray crosses the threshold in one of them
    bool crossesBlock(const GridWalk& walk, std::int32_t block) {
        const float side = field_.cells.side;
        const int along = field_.sides.along;
        const CubeGrid grid{field_.cells.low + side * glm::vec3(walk.cell()), side / static_cast<float>(along),
                            glm::ivec3(along)};
        const std::size_t first = field_.sides.subcellsOfBlock() * static_cast<std::size_t>(block);
        const RayPart part{ray_.origin, ray_.direction, walk.from(), walk.to()};
        for (GridWalk subwalk(grid, part, inverse_); !subwalk.isOver(); subwalk.next()) {
            const std::size_t subcell = first + subwalk.index();
            const std::int32_t count = field_.sides.subcells[subcell].count;
            if (count > 0 ? crossesSubcell(subwalk, subcell) : crossesAll(subwalk.from(), count)) return true;
        }
        return false;
    }

    /// Passes a subcell that the surface may pass through.
    bool crossesSubcell(const GridWalk& walk, std::size_t subcell) {
        const BallSet& balls = field_.cache.ofSubcell(field_.cells, field_.sides, subcell);
        if (isFirst_) {
            isFirst_ = false;
            last_ = sampleAt<kIsAnisotropic>(balls, ray_, walk.from());
            if (isAcross(last_)) return setFound(last_, &balls);
        }
        if (last_.slope == kNotSampled) last_.distance = walk.from();
        const float length = walk.to() - walk.from();
        const int steps = static_cast<int>(length * inverseStep_) + 1;
        const float step = length / static_cast<float>(steps);
        for (int k = 1; k <= steps; ++k) {
            const float at = k == steps ? walk.to() : walk.from() + step * static_cast<float>(k);
            const FieldOnRay next = sampleAt<kIsAnisotropic>(balls, ray_, at);
            if (isAcross(next)) return setFound(refined(balls, last_, next), &balls);
            if (turnsBack(balls, next)) return true;
            last_ = next;
        }
        return false;
    }

    /// Whether a sample is on the other side of the threshold than the ray.
    bool isAcross(const FieldOnRay& sample) const { return (sample.field >= field_.threshold) != isInside_; }

    /// Whether the field is across between the last sample and the next, neither of which is, because it turns back
    /// between them: at the extremum of the cubic through both samples' values and slopes.
    bool turnsBack(const BallSet& balls, const FieldOnRay& next) {
        const float sign = isInside_ ? -1.0F : 1.0F;
        if (!(sign * next.slope < 0.0F)) return false;
        if (last_.slope == kNotSampled) last_ = sampleAt<kIsAnisotropic>(balls, ray_, last_.distance);
        if (!(sign * last_.slope > 0.0F)) return false;
        // The secant of the slopes is near enough to the extremum: a body or a gap that it misses is thinner still.
        const float share = last_.slope / (last_.slope - next.slope);
        const FieldOnRay turn =
            sampleAt<kIsAnisotropic>(balls, ray_, last_.distance + (next.distance - last_.distance) * share);
        if (!isAcross(turn)) return false;
        return setFound(refined(balls, last_, turn), &balls);
    }

    /// Where the cubic through the values and slopes of two samples on both sides of the threshold crosses it.
    float cubicCrossing(const FieldOnRay& near, const FieldOnRay& far) const {
        const float length = far.distance - near.distance;
        const float rise = far.field - near.field;
        const float a = near.slope * length - rise;
        const float b = rise - far.slope * length;
        // With t from 0 to 1 it is near.field + rise t + t (1 - t) (a (1 - t) + b t).
        float t = std::clamp((field_.threshold - near.field) / rise, 0.0F, 1.0F);
        for (int k = 0; k < 3; ++k) {
            const float rest = 1.0F - t;
            const float bend = a * rest + b * t;
            const float value = near.field + rise * t + t * rest * bend - field_.threshold;
            const float slope = rise + (rest - t) * bend + t * rest * (b - a);
            t -= value / slope;
        }
        return near.distance + length * t;
    }

    /// A sample as near to where the field has the threshold between two samples as matters: Newton's steps, halved
    /// where they leave the interval.
    FieldOnRay refined(const BallSet& balls, FieldOnRay near, FieldOnRay far) const {
        constexpr int kMostSteps = 16;  // enough for bisection alone to reach a float's precision
        // The step that follows is the square of this, and normals are off by as much as radii are longer than steps.
        const float precise = 1e-3F * (far.distance - near.distance);
        FieldOnRay at = far;
        for (int k = 0; k < kMostSteps; ++k) {
            const bool isCubic = k == 0 && near.slope != kNotSampled;
            const float next =
                isCubic ? cubicCrossing(near, far) : at.distance - (at.field - field_.threshold) / at.slope;
            const bool isWithin = next > near.distance && next < far.distance;
            if (isWithin && !isCubic && std::abs(next - at.distance) < precise) {
                at.distance = next;
                break;
            }
            at = sampleAt<kIsAnisotropic>(balls, ray_, isWithin ? next : 0.5F * (near.distance + far.distance));
            (isAcross(at) ? far : near) = at;
        }
        return at;
    }

    /// @return true
    bool setFound(const FieldOnRay& at, const BallSet* balls) {
        const float square = dot(at.outward, at.outward);
        found_.distance = at.distance;
        found_.normal = square > 0.0F ? at.outward * (1.0F / std::sqrt(square)) : -ray_.direction;
        found_.balls = balls;
        return true;
    }

    const CastField& field_;
    const RayPart& ray_;
    bool isInside_;
    glm::vec3 inverse_;
    float inverseStep_;
    glm::ivec3 cell_{0};   // that the ray is in
    bool isFirst_ = true;  // whether nothing is known of the field on the ray yet
    FieldOnRay last_;      // on the ray's side
    SurfacePoint found_;
};

SurfacePoint findCrossing(const CastField& field, const RayPart& ray, bool isInside) {
    if (field.cells.isAnisotropic()) return CrossingSearch<true>(field, ray, isInside).find();
    return CrossingSearch<false>(field, ray, isInside).find();
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(findCrossing);

SurfacePoint findCrossing(const CastField& field, const RayPart& ray, bool isInside) {
    return HWY_DYNAMIC_DISPATCH(findCrossing)(field, ray, isInside);
}

void findShares(const BallCells& cells, const BallSet& balls, glm::vec3 point, std::vector<BallShare>& shares) {
    shares.clear();
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const auto ball = static_cast<std::size_t>(balls.index(k));
        const glm::vec3 off = point - glm::vec3(cells.x[ball], cells.y[ball], cells.z[ball]);
        const float drop =
            cells.isAnisotropic() ? dot(off, cells.formOf(ball).times(off)) : dot(off, off) * cells.squaredSlope[ball];
        const float root = cells.peak[ball] - drop;
        if (root > 0.0F) shares.push_back({cells.particle[ball], root * root});
    }
}

}  // namespace render

#endif
