// The balls that a vector of rays meets, and the field of metaballs along the rays. Part of metaball_cast.cpp, compiled
// once per instruction set by Highway's rules; the guard below is theirs.
//
// On a ray at view depth t the square root of a ball's kernel is p - d^2 q^2 = w - u^2 (p the ball's peak, q its slope)
// with u = (t - t0) s, where t0 is the depth closest to the ball's center, s = |direction| q and w = p - (closest
// distance)^2 q^2. Hence the field and its derivative:
//   F = sum max(0, w - u^2)^2,     F' = -4 sum max(0, w - u^2) u s.
// The root of an ellipsoid's kernel is p - d^T A d: as above with s^2 = direction^T A direction, t0 where d^T A
// direction is zero, and w = p - d^T A d there.
#if defined(RENDER_NEAR_BALLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_NEAR_BALLS_INL_H_
#undef RENDER_NEAR_BALLS_INL_H_
#else
#define RENDER_NEAR_BALLS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <hwy/highway.h>
#include <tbb/cache_aligned_allocator.h>

#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/metaball_scene.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The product of a ball's form with a vector in each lane.
HWY_INLINE Vec3 formTimes(const SymmetricMatrix<float>& form, const Vec3& v) {
    const V xy = splat(form.xy);
    const V xz = splat(form.xz);
    const V yz = splat(form.yz);
    return {splat(form.xx) * v.x + xy * v.y + xz * v.z, xy * v.x + splat(form.yy) * v.y + yz * v.z,
            xz * v.x + yz * v.y + splat(form.zz) * v.z};
}

/// The balls of a tile's list as a structure of arrays, front to back. They are copied one vector at a time as they are
/// asked for: most lie behind the surface, where no ray comes.
class TileBalls {
 public:
    /// Begins with the balls of another tile; the memory is reused.
    void begin(const MetaballScene& scene, std::size_t tile) {
        balls_ = scene.balls;
        ellipsoids_ = scene.ellipsoids;
        index_ = scene.tiles.itemsOf(tile);
        copied_ = 0;
        // Whole vectors are read, also from the last balls on.
        const std::size_t size = index_.size() + hn::Lanes(D());
        for (std::vector<float>* values : {&x_, &y_, &z_, &reach_, &distance_})
            if (values->size() < size) values->resize(size);
    }

    std::size_t size() const { return index_.size(); }
    std::uint32_t index(std::size_t k) const { return index_[k]; }

    /// View depth at which the kernel of ball k begins, m.
    float nearDepth(std::size_t k) const {
        const Metaball& ball = balls_[index_[k]];
        return ball.center.z - ball.reach;
    }

    struct BallVector {
        Vec3 center;
        V reach;     ///< radius of a sphere around the kernel, m
        V distance;  ///< distance of the center from the origin of view coordinates, m
    };
    /// The vector of balls that begins with ball `first`.
    BallVector load(std::size_t first) {
        const D d;
        copyThrough(first);
        return {{hn::LoadU(d, &x_[first]), hn::LoadU(d, &y_[first]), hn::LoadU(d, &z_[first])},
                hn::LoadU(d, &reach_[first]),
                hn::LoadU(d, &distance_[first])};
    }

 private:
    void copyThrough(std::size_t k) {
        const D d;
        for (; copied_ <= k; copied_ += hn::Lanes(d)) {
            const std::size_t end = std::min(copied_ + hn::Lanes(d), index_.size());
            for (std::size_t next = copied_; next < end; ++next) {
                const Metaball& ball = balls_[index_[next]];
                x_[next] = ball.center.x;
                y_[next] = ball.center.y;
                z_[next] = ball.center.z;
                reach_[next] = ellipsoids_.empty() ? ball.reach : ellipsoids_[index_[next]].radius;
            }
            const Vec3 center{hn::LoadU(d, &x_[copied_]), hn::LoadU(d, &y_[copied_]), hn::LoadU(d, &z_[copied_])};
            hn::StoreU(hn::Sqrt(dot(center, center)), d, &distance_[copied_]);
        }
    }

    std::span<const Metaball> balls_;
    std::span<const Ellipsoid> ellipsoids_;
    std::span<const std::uint32_t> index_;
    std::size_t copied_ = 0;  // number of balls copied so far, in whole vectors
    std::vector<float> x_, y_, z_, reach_, distance_;
};

/// A line that all rays of a vector stay close to: at the parameter t each is at most originSpread + directionSpread t
/// away from it.
class RayBundle {
 public:
    /// @param at    points of the image plane that the rays go through
    /// @param rays  mask of the rays that are cast
    RayBundle(const CameraFrame& frame, const ImagePoint& at, M rays, float minDepth) : minDepth_(minDepth) {
        // Chosen: the centers of balls are rounded by some 1e-7 of their distance, and kernels are computed from
        // rounded squares of distances.
        constexpr float kRounding = 1e-5F;
        const glm::vec2 low(hn::GetLane(minOfLanes(at.x, rays)), hn::GetLane(minOfLanes(at.y, rays)));
        const glm::vec2 high(-hn::GetLane(minOfLanes(hn::Neg(at.x), rays)),
                             -hn::GetLane(minOfLanes(hn::Neg(at.y), rays)));
        const glm::vec2 middle = 0.5F * (low + high);
        const glm::vec2 half = high - middle;
        const float spread = std::sqrt(dot(half, half)) * (1.0F + kRounding);
        (frame.perspective ? direction_ : origin_) += glm::vec3(middle, 0.0F);
        (frame.perspective ? directionSpread_ : originSpread_) = spread;
        directionSpread_ += kRounding;
        inverseSquare_ = 1.0F / dot(direction_, direction_);
    }

    /// A bit for each ball of the vector that begins with ball `first` of a tile: not set where no ray of the bundle
    /// can come within reach of the ball at or beyond the view depth minDepth.
    std::uint32_t mayMeet(TileBalls& tileBalls, std::size_t first) const {
        const D d;
        const Vec3 direction = splat(direction_);
        const TileBalls::BallVector balls = tileBalls.load(first);
        const Vec3 offset = balls.center - splat(origin_);
        const V closest = dot(offset, direction) * splat(inverseSquare_);
        const Vec3 away = pointOnRay(offset, hn::Neg(closest), direction);
        const V limit = balls.reach + splat(originSpread_) + splat(directionSpread_) * (balls.reach + balls.distance);
        const M isMet = hn::And(dot(away, away) < limit * limit, offset.z + balls.reach >= splat(minDepth_));
        return maskBits(hn::And(isMet, hn::FirstN(d, tileBalls.size() - first)));
    }

 private:
    glm::vec3 origin_{0.0F};
    glm::vec3 direction_{0.0F, 0.0F, 1.0F};
    float originSpread_ = 0.0F;
    float directionSpread_ = 0.0F;
    float inverseSquare_ = 1.0F;  // 1 / squared length of the direction
    float minDepth_;
};

/// The field and its derivative at one depth of each ray.
struct FieldSample {
    V depth, field, slope;
};

HWY_INLINE FieldSample select(M mask, const FieldSample& yes, const FieldSample& no) {
    return {hn::IfThenElse(mask, yes.depth, no.depth), hn::IfThenElse(mask, yes.field, no.field),
            hn::IfThenElse(mask, yes.slope, no.slope)};
}

/// The memory of a NearBalls, which is reused from one vector of rays to the next.
struct NearBallStorage {
    std::vector<float, tbb::cache_aligned_allocator<float>> terms;  ///< w, t0 s and s of each ball, for all lanes
    std::vector<float> nearDepth, farDepth;  ///< view depths at which each ball's kernel begins and ends, m
    std::vector<std::uint32_t> index;        ///< index of each ball in MetaballScene::balls

    void reserve(std::size_t ballCount) {
        if (index.size() > ballCount) return;
        const std::size_t lanes = hn::Lanes(D());
        // A ball is stored before it is known whether rays meet it, and whole vectors of depths are read.
        terms.resize(3 * lanes * (ballCount + 1));
        nearDepth.resize(ballCount + lanes);
        farDepth.resize(ballCount + lanes);
        index.resize(ballCount + 1);
    }
};

/// The balls that the rays of a vector meet, in the order of the tile's list. They are admitted as the rays advance: of
/// the `count_` admitted balls those before `entered_` begin before the present depth, and those before `left_` end
/// before it.
/// @tparam kIsAnisotropic  whether balls are ellipsoids
template <bool kIsAnisotropic>
class NearBalls {
 public:
    NearBalls(const MetaballScene& scene, TileBalls& tileBalls, NearBallStorage& storage, const Ray& ray,
              const RayBundle& bundle)
        : scene_(scene), tileBalls_(tileBalls), storage_(storage), bundle_(bundle), ray_(ray) {
        storage_.reserve(tileBalls.size());
        const V square = dot(ray.direction, ray.direction);
        length_ = hn::Sqrt(square);
        inverseSquare_ = splat(1.0F) / square;
    }

    V directionLength() const { return length_; }

    /// Advances the rays to a depth and admits the balls that begin before it.
    void enter(float depth) {
        while (culled_ < tileBalls_.size() && tileBalls_.nearDepth(culled_) <= depth) admitVector();
        entered_ = firstNotBelow(storage_.nearDepth, entered_, count_, depth);
    }

    /// Leaves the balls behind that end before a depth. They stay stored for the refinement.
    void leave(float depth) { left_ = firstNotBelow(storage_.farDepth, left_, entered_, depth); }

    /// Whether no ball is at the present depth, so that the field is 0 there.
    bool isEmptyHere() const { return left_ == entered_; }

    /// The depth at which the next ball begins, infinity if there is none. @pre isEmptyHere()
    float nextNearDepth() {
        while (entered_ == count_ && culled_ < tileBalls_.size()) admitVector();
        return entered_ == count_ ? std::numeric_limits<float>::infinity() : storage_.nearDepth[entered_];
    }

    /// The balls whose kernels reach the present depth are among those from first() to end().
    std::size_t first() const { return left_; }
    std::size_t end() const { return entered_; }
    std::uint32_t index(std::size_t ball) const { return storage_.index[ball]; }

    FieldSample sampleAt(V depth) const { return sampleAt(depth, left_); }

    /// The field and its derivative at a depth of each ray.
    /// @param first  index of the first ball that is summed
    FieldSample sampleAt(V depth, std::size_t first) const {
        const V zero = splat(0.0F);
        V field = zero;
        V slope = zero;
        for (std::size_t ball = first; ball < entered_; ++ball) {
            const Term term = termOf(ball, depth);
            const V root = hn::Max(term.root, zero);
            field = field + root * root;
            slope = slope - root * term.turn;
        }
        return {depth, field, slope * splat(4.0F)};
    }

    /// w - u^2 of one ball: the square root of its kernel where that is above zero.
    V rootAt(std::size_t ball, V depth) const { return termOf(ball, depth).root; }

 private:
    struct Term {
        V root;  // w - u^2 of the formulas at the top of this file
        V turn;  // u s of these formulas
    };

    Term termOf(std::size_t ball, V depth) const {
        const D d;
        const float* terms = &storage_.terms[3 * ball * hn::Lanes(d)];
        const V s = load(terms + 2 * hn::Lanes(d));
        const V u = depth * s - load(terms + hn::Lanes(d));
        return {load(terms) - u * u, u * s};
    }

    /// Admits the next vector of the tile's balls, as far as some ray meets them.
    void admitVector() {
        for (std::uint32_t bits = bundle_.mayMeet(tileBalls_, culled_); bits != 0; bits &= bits - 1)
            admit(tileBalls_.index(culled_ + static_cast<std::size_t>(std::countr_zero(bits))));
        culled_ += hn::Lanes(D());
    }

    void admit(std::uint32_t index) {
        const D d;
        const Metaball& ball = scene_.balls[index];
        const Vec3 toCenter = splat(ball.center) - ray_.origin;
        V closest = dot(toCenter, ray_.direction) * inverseSquare_;
        Vec3 off = toCenter - ray_.direction * closest;
        V w;
        V s;
        if constexpr (kIsAnisotropic) {
            // From the point nearest to the center, where numbers are small, to the greatest value of the kernel.
            const SymmetricMatrix<float>& form = scene_.ellipsoids[index].form;
            const Vec3 along = formTimes(form, ray_.direction);
            const V square = dot(along, ray_.direction);
            const V change = dot(off, along) / square;
            closest = closest + change;
            off = off - ray_.direction * change;
            w = splat(ball.peak) - dot(off, formTimes(form, off));
            s = hn::Sqrt(square);
        } else {
            w = splat(ball.peak) - dot(off, off) * splat(ball.slope * ball.slope);
            s = length_ * splat(ball.slope);
        }
        float* terms = &storage_.terms[3 * count_ * hn::Lanes(d)];
        store(w, terms);
        store(closest * s, terms + hn::Lanes(d));
        store(s, terms + 2 * hn::Lanes(d));
        storage_.nearDepth[count_] = ball.center.z - ball.reach;
        storage_.farDepth[count_] = ball.center.z + ball.reach;
        storage_.index[count_] = index;
        // Without a branch: most balls are met, and the others are overwritten by the next one.
        count_ += none(w > splat(0.0F)) ? 0U : 1U;
    }

    /// The first of the depths from `first` to `end` that is not less than a depth.
    static std::size_t firstNotBelow(const std::vector<float>& depths, std::size_t first, std::size_t end,
                                     float depth) {
        const D d;
        for (; first < end; first += hn::Lanes(d)) {
            const std::intptr_t lane = hn::FindFirstTrue(d, hn::LoadU(d, &depths[first]) >= splat(depth));
            if (lane >= 0) return std::min(end, first + static_cast<std::size_t>(lane));
        }
        return end;
    }

    const MetaballScene& scene_;
    TileBalls& tileBalls_;
    NearBallStorage& storage_;
    RayBundle bundle_;
    Ray ray_;
    V length_;                // length of the rays' direction
    V inverseSquare_;         // 1 / squared length of the rays' direction
    std::size_t culled_ = 0;  // number of the tile's balls that have been tested
    std::size_t count_ = 0;   // number of balls admitted
    std::size_t entered_ = 0;
    std::size_t left_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
