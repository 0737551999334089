// Ray casting of metaballs with Highway, one ray per lane; this file is compiled once per instruction set.
//
// The field along the rays (near_balls-inl.h) is sampled on a grid of depths. A sample at or above the threshold
// brackets the surface; between two samples below it a sliver can hide only if the field rises at the first and falls
// at the second, and then the maximum is looked for.
#include "render/cpu/metaballs/metaball_cast.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/metaballs/metaball_cast.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/metaballs/near_balls-inl.h"
#include "render/prepare/lighting/simd_occlusion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

// A hit is refined by kCubicSteps Newton steps on the cubic through the two samples that bracket it, then by at most
// kRefinements Newton steps on the field itself. The latter end with a step of less than kSmallStep of the distance
// between samples, which is half a radius. The error that is left is of the order of that step's square, 5e-5 radii; on
// grazing rays it is half of the step. More steps on the cubic gain nothing (measured): each has to wait for the one
// before, as each of the exact steps on the field has.
constexpr int kCubicSteps = 2;
constexpr int kRefinements = 6;
constexpr float kSmallStep = 1e-2F;
constexpr int kPeakBisections = 4;  // number of bisections for the field's maximum between two samples

/// A vector of rays that advances through the balls of a tile.
/// @tparam kIsAnisotropic  whether balls are ellipsoids
template <bool kIsAnisotropic>
class RayVector {
 public:
    /// @param active    the lanes that are cast
    /// @param minDepth  view depth at which the search of each ray begins, m
    RayVector(const MetaballScene& scene, TileBalls& balls, NearBallStorage& storage, const ImagePoint& at, M active,
              V minDepth)
        : scene_(scene),
          gridStart_(balls.size() == 0 ? 0.0F : std::max(0.0F, balls.nearDepth(0))),
          firstSample_(sampleBefore(hn::GetLane(minOfLanes(minDepth, active)))),
          ray_(viewRay(scene.frame, at)),
          near_(scene, balls, storage, ray_, RayBundle(scene.frame, at, active, depthOf(firstSample_))) {}

    /// Advances until every active ray has hit the surface, has left the balls behind or is at its end.
    /// @return the view depth of each hit, negative without one
    V cast(M active, V minDepth, V maxDepth) {
        const V threshold = splat(scene_.threshold);
        long k = firstSample_;
        float depth = depthOf(k);
        near_.enter(depth);
        FieldSample here = near_.sampleAt(splat(depth));
        M hasBegun = hn::And(active, minDepth <= here.depth);
        maxField_ = hn::IfThenElseZero(hasBegun, here.field);
        M isFound = hn::And(hasBegun, here.field >= threshold);
        FieldSample low = here;
        FieldSample high = here;
        active = hn::AndNot(isFound, active);
        while (!none(active)) {
            if (near_.isEmptyHere()) {
                const float next = near_.nextNearDepth();
                if (next == std::numeric_limits<float>::infinity()) break;
                k = std::max(k, sampleBefore(next) - 1);
                depth = depthOf(k);
                here = {splat(depth), splat(0.0F), splat(0.0F)};
            }
            const float ahead = depthOf(++k);
            near_.enter(ahead);
            const FieldSample there = near_.sampleAt(splat(ahead));
            hasBegun = hn::And(active, minDepth <= here.depth);
            M isHit = hn::And(hn::And(active, minDepth <= there.depth), there.field >= threshold);
            const M isSuspect = hn::AndNot(isHit, hn::And(hasBegun, mayPeakBetween(here, there, ahead - depth)));
            FieldSample reached = there;
            if (!none(isSuspect)) {
                const FieldSample peak = near_.sampleAt(peakBetween(depth, ahead));
                const M isSliver = hn::And(isSuspect, peak.field >= threshold);
                reached = select(isSliver, peak, reached);
                isHit = hn::Or(isHit, isSliver);
            }
            maxField_ = hn::Max(maxField_, hn::IfThenElseZero(hasBegun, there.field));
            // This has no branch, because it would be mispredicted too often.
            firstAtHit_ = none(isFound) ? near_.first() : firstAtHit_;
            // A ray that begins between the two samples, and whose second sample is a hit, begins inside the surface.
            low = select(isHit, select(hasBegun, here, there), low);
            high = select(isHit, reached, high);
            isFound = hn::Or(isFound, isHit);
            active = hn::AndNot(isHit, hn::And(active, there.depth <= maxDepth));
            depth = ahead;
            here = there;
            near_.leave(depth);
        }
        return hn::IfThenElse(isFound, refine(low, high), splat(-1.0F));
    }

    /// Greatest value of the field at the samples that cast() took on each ray.
    V maxField() const { return maxField_; }

    /// Writes normal, color and sky visibility at the depths that cast() found, to the block's rays first, first + 1,
    /// .... Lanes without a hit get values of no meaning, which may be NaN.
    void writeAttributes(V depth, std::size_t first, RayBlock& block) const {
        const V zero = splat(0.0F);
        const Vec3 point = pointOnRay(ray_.origin, depth, ray_.direction);
        Vec3 normal{zero, zero, zero};
        Vec3 color = normal;
        Vec3 skyPlus = normal;
        Vec3 skyMinus = normal;
        V weight = zero;
        for (std::size_t k = firstAtHit_; k < near_.end(); ++k) {
            const V root = hn::Max(near_.rootAt(k, depth), zero);
            // Many of the balls on the way end before the hit or begin behind it.
            if (hn::AllTrue(D(), root <= zero)) continue;
            const Metaball& ball = scene_.balls[near_.index(k)];
            const BallAttributes& attributes = scene_.attributes[near_.index(k)];
            const Vec3 off = point - splat(ball.center);
            if constexpr (kIsAnisotropic)
                normal = normal + formTimes(scene_.ellipsoids[near_.index(k)].form, off) * root;
            else
                normal = normal + off * (root * splat(ball.slope * ball.slope));
            const V kernel = root * root;
            weight = weight + kernel;
            color = color + splat(attributes.color) * kernel;
            if (!scene_.hasSky) continue;
            const SkyVisibility& sky = attributes.sky;
            skyPlus = skyPlus + splat(glm::vec3(sky[0], sky[2], sky[4])) * kernel;
            skyMinus = skyMinus + splat(glm::vec3(sky[1], sky[3], sky[5])) * kernel;
        }
        normal = normal * (splat(1.0F) / hn::Sqrt(hn::Max(dot(normal, normal), splat(1e-30F))));
        const V share = splat(1.0F) / hn::Max(weight, splat(1e-30F));
        storeVec3(normal, block.normal, first);
        storeVec3(color * share, block.color, first);
        if (scene_.hasSky) storeVec3(skyAlong(normal, skyPlus * share, skyMinus * share), block.sky, first);
    }

 private:
    /// Sky visibility along the normal, against it and along the mirrored ray d - 2 (d.n) n.
    Vec3 skyAlong(const Vec3& normal, const Vec3& plus, const Vec3& minus) const {
        const Vec3 direction = ray_.direction * (splat(1.0F) / near_.directionLength());
        const Vec3 mirrored = direction - normal * (splat(2.0F) * dot(direction, normal));
        const Vec3 world = toWorld(scene_.frame, normal);
        return {skyVisibilityToward(world, plus, minus), skyVisibilityToward(world, minus, plus),
                skyVisibilityToward(toWorld(scene_.frame, mirrored), plus, minus)};
    }

    float depthOf(long sample) const { return gridStart_ + static_cast<float>(sample) * scene_.step; }

    /// The last sample of the grid that does not lie beyond this depth, or the first sample if all do.
    long sampleBefore(float depth) const { return std::max(0L, static_cast<long>((depth - gridStart_) / scene_.step)); }

    /// Whether the field may exceed the threshold between two samples a and b that lie below it, a distance h apart: it
    /// rises at a and falls at b, and the tangents meet above the threshold. They meet where F0 + F0' x = F1 - F1' (h -
    /// x) at the height (F1 F0' - F0 F1' - F0' F1' h) / (F0' - F1').
    M mayPeakBetween(const FieldSample& a, const FieldSample& b, float h) const {
        const V zero = splat(0.0F);
        const V height = b.field * a.slope - a.field * b.slope - a.slope * b.slope * splat(h);
        const V limit = splat(scene_.threshold) * (a.slope - b.slope);
        return hn::And(hn::And(a.slope > zero, b.slope < zero), height > limit);
    }

    /// View depth between two samples where the derivative of the field changes its sign, found by bisection.
    V peakBetween(float from, float to) const {
        V low = splat(from);
        V high = splat(to);
        for (int k = 0; k < kPeakBisections; ++k) {
            const V middle = (low + high) * splat(0.5F);
            const M isRising = near_.sampleAt(middle).slope > splat(0.0F);
            low = hn::IfThenElse(isRising, middle, low);
            high = hn::IfThenElse(isRising, high, middle);
        }
        return (low + high) * splat(0.5F);
    }

    /// View depth at which the cubic through two samples and their slopes meets the threshold, by Newton's method. It
    /// starts where the chord meets the threshold and is kept between the samples.
    V cubicRoot(const FieldSample& low, const FieldSample& high) const {
        const V zero = splat(0.0F);
        const V one = splat(1.0F);
        const V tiny = splat(1e-20F);
        const V width = high.depth - low.depth;
        const V rise = high.field - low.field;
        const V first = low.slope * width;
        const V last = high.slope * width;
        // The cubic is low + first u + square u^2 + cube u^3 for u from 0 to 1.
        const V cube = first + last - (rise + rise);
        const V square = rise - (first + cube);
        const V missing = splat(scene_.threshold) - low.field;
        V u = hn::Min(missing / hn::Max(rise, tiny), one);
        for (int k = 0; k < kCubicSteps; ++k) {
            const V value = u * (first + u * (square + u * cube));
            const V slope = first + u * (square + square + splat(3.0F) * (u * cube));
            u = hn::Min(hn::Max(u + (missing - value) / hn::Max(slope, tiny), zero), one);
        }
        return low.depth + u * width;
    }

    /// View depth of the hit between two samples that bracket it, by Newton's method on the field. Each ray ends with
    /// its first small step; a step that would leave the bracket goes to the middle of the bracket instead.
    V refine(const FieldSample& from, const FieldSample& to) const {
        const D d;
        V low = from.depth;
        V high = to.depth;
        V depth = cubicRoot(from, to);
        M isRough = hn::FirstN(d, hn::Lanes(d));
        for (int k = 0; k < kRefinements; ++k) {
            const FieldSample sample = near_.sampleAt(depth, firstAtHit_);
            const V excess = sample.field - splat(scene_.threshold);
            const M isInside = excess >= splat(0.0F);
            high = hn::IfThenElse(isInside, depth, high);
            low = hn::IfThenElse(isInside, low, depth);
            const V newton = depth - excess / hn::Max(sample.slope, splat(1e-20F));
            const M isBracketed = hn::And(newton >= low, newton <= high);
            const V middle = (low + high) * splat(0.5F);
            const V next = hn::IfThenElse(isRough, hn::IfThenElse(isBracketed, newton, middle), depth);
            // After a step to the middle, half of the bracket is left.
            const V left = hn::IfThenElse(isBracketed, hn::Abs(next - depth), high - low);
            isRough = hn::And(isRough, left > splat(kSmallStep * scene_.step));
            depth = next;
            if (none(isRough)) break;
        }
        return depth;
    }

    const MetaballScene& scene_;
    float gridStart_;   // view depth of sample 0 of the tile, m
    long firstSample_;  // index of the first sample that these rays take
    Ray ray_;
    NearBalls<kIsAnisotropic> near_;
    std::size_t firstAtHit_ = 0;  // first ball that may reach the hit of the nearest lane
    V maxField_;
};

template <bool kIsAnisotropic>
void castRays(const MetaballScene& scene, std::size_t tile, RayBlock& block) {
    const D d;
    const std::size_t lanes = hn::Lanes(d);
    if (block.count == 0) return;
    thread_local TileBalls balls;
    thread_local NearBallStorage storage;
    balls.begin(scene, tile);
    for (std::size_t first = 0; first < block.count; first += lanes) {
        const M active = hn::FirstN(d, std::min(lanes, block.count - first));
        const V minDepth = load(&block.minDepth[first]);
        const ImagePoint at = imagePointAt(scene.frame, load(&block.x[first]), load(&block.y[first]));
        RayVector<kIsAnisotropic> rays(scene, balls, storage, at, active, minDepth);
        const V depth = rays.cast(active, minDepth, load(&block.maxDepth[first]));
        store(depth, &block.depth[first]);
        store(rays.maxField(), &block.maxField[first]);
        if (!scene.attributes.empty() && !hn::AllTrue(d, depth < splat(0.0F)))
            rays.writeAttributes(depth, first, block);
    }
}

void castBlock(const MetaballScene& scene, std::size_t tile, RayBlock& block) {
    if (scene.ellipsoids.empty())
        castRays<false>(scene, tile, block);
    else
        castRays<true>(scene, tile, block);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(castBlock);

void castBlock(const MetaballScene& scene, std::size_t tile, RayBlock& block) {
    HWY_DYNAMIC_DISPATCH(castBlock)(scene, tile, block);
}

}  // namespace render

#endif
