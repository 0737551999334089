// The field of the metaballs along a vector of rays. Part of metaball_cast.cpp, compiled once per instruction set by
// Highway's rules; the guard below is theirs.
//
// On a ray at view depth t the square root of a ball's kernel is p - d^2 q^2 = w - u^2 (p the ball's peak, q its slope)
// with u = (t - t0) s, where t0 is the depth closest to the ball's center, s = |direction| q and w = p - (closest
// distance)^2 q^2. Hence the field and its derivative:
//   F = sum max(0, w - u^2)^2,     F' = -4 sum max(0, w - u^2) u s.
#if defined(RENDER_NEAR_BALLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_NEAR_BALLS_INL_H_
#undef RENDER_NEAR_BALLS_INL_H_
#else
#define RENDER_NEAR_BALLS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <hwy/highway.h>
#include <tbb/cache_aligned_allocator.h>

#include "render/cpu/metaballs/ball_culling-inl.h"
#include "render/cpu/metaballs/metaball_scene.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The field and its derivative at one depth of each ray.
struct FieldSample {
    V depth, field, slope;
};

HWY_INLINE FieldSample select(M mask, const FieldSample& yes, const FieldSample& no) {
    return {hn::IfThenElse(mask, yes.depth, no.depth), hn::IfThenElse(mask, yes.field, no.field),
            hn::IfThenElse(mask, yes.slope, no.slope)};
}

/// Memory of NearBalls, which is reused from one vector of rays to the next.
struct NearBallStorage {
    std::vector<float, tbb::cache_aligned_allocator<float>> terms;  ///< per ball: w, t0 s and s, each one vector
    std::vector<float> nearDepth, farDepth;                         ///< where the ball's kernel begins and ends
    std::vector<std::uint32_t> index;                               ///< in MetaballScene::balls

    void reserve(std::size_t ballCount) {
        if (index.size() > ballCount) return;
        const std::size_t lanes = hn::Lanes(D());
        // A ball is written before it is known to be met, and whole vectors of depths are read.
        terms.resize(3 * lanes * (ballCount + 1));
        nearDepth.resize(ballCount + lanes);
        farDepth.resize(ballCount + lanes);
        index.resize(ballCount + 1);
    }
};

/// The balls that the rays of a vector meet, in the order of the tile's list. They are admitted as the rays advance: of
/// the `count_` admitted balls those before `entered_` begin before the present depth, and those before `left_` end
/// there.
class NearBalls {
 public:
    NearBalls(const MetaballScene& scene, TileBalls& tileBalls, NearBallStorage& storage, const Ray& ray,
              const BallCulling& culling)
        : scene_(scene), tileBalls_(tileBalls), storage_(storage), culling_(culling), ray_(ray) {
        storage_.reserve(tileBalls.size());
        const V square = dot(ray.direction, ray.direction);
        length_ = hn::Sqrt(square);
        inverseSquare_ = splat(1.0F) / square;
    }

    V directionLength() const { return length_; }

    /// Rays have come to a depth: admits the balls that begin before it.
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

    /// @param first  balls from this one on are summed
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
        V root;  // w - u^2
        V turn;  // u s
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
        for (std::uint32_t bits = culling_.mayMeet(culled_); bits != 0; bits &= bits - 1)
            admit(tileBalls_.index(culled_ + static_cast<std::size_t>(std::countr_zero(bits))));
        culled_ += hn::Lanes(D());
    }

    void admit(std::uint32_t index) {
        const D d;
        const Metaball& ball = scene_.balls[index];
        const Vec3 toCenter = splat(ball.center) - ray_.origin;
        const V closest = dot(toCenter, ray_.direction) * inverseSquare_;
        const Vec3 off = toCenter - ray_.direction * closest;
        const V w = splat(ball.peak) - dot(off, off) * splat(ball.slope * ball.slope);
        const V s = length_ * splat(ball.slope);
        float* terms = &storage_.terms[3 * count_ * hn::Lanes(d)];
        store(w, terms);
        store(closest * s, terms + hn::Lanes(d));
        store(s, terms + 2 * hn::Lanes(d));
        storage_.nearDepth[count_] = ball.center.z - ball.reach;
        storage_.farDepth[count_] = ball.center.z + ball.reach;
        storage_.index[count_] = index;
        // Without a branch: most are met, and the others are overwritten.
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
    BallCulling culling_;
    Ray ray_;
    V length_;  // of the direction
    V inverseSquare_;
    std::size_t culled_ = 0;  // balls of the tile that have been tested
    std::size_t count_ = 0;   // balls admitted
    std::size_t entered_ = 0;
    std::size_t left_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
