// Which balls of a tile a vector of rays may meet, tested one vector of balls at a time. Part of metaball_cast.cpp,
// compiled once per instruction set by Highway's rules; the guard below is theirs.
#if defined(RENDER_BALL_CULLING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_BALL_CULLING_INL_H_
#undef RENDER_BALL_CULLING_INL_H_
#else
#define RENDER_BALL_CULLING_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <hwy/highway.h>

#include "render/cpu/metaballs/metaball_scene.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The balls of a tile's list as a structure of arrays, front to back. They are copied one vector at a time as they are
/// asked for: most lie behind the surface, where no ray comes.
class TileBalls {
 public:
    /// Starts on another tile; the memory is reused.
    void begin(const MetaballScene& scene, std::size_t tile) {
        const CellLists& tiles = scene.tiles;
        balls_ = scene.balls;
        index_ = std::span(tiles.items).subspan(tiles.begin[tile], tiles.begin[tile + 1] - tiles.begin[tile]);
        copied_ = 0;
        // Whole vectors are read.
        const std::size_t size = index_.size() + hn::Lanes(D());
        for (std::vector<float>* values : {&x_, &y_, &z_, &reach_, &distance_})
            if (values->size() < size) values->resize(size);
    }

    std::size_t size() const { return index_.size(); }
    std::uint32_t index(std::size_t k) const { return index_[k]; }

    /// View depth at which the kernel of ball k begins, m.
    float nearDepth(std::size_t k) {
        copyThrough(k);
        return z_[k] - reach_[k];
    }

    struct BallVector {
        Vec3 center;
        V reach;
        V distance;  ///< of the center from the eye or, in parallel projection, from the picture's middle
    };
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
                reach_[next] = ball.reach;
            }
            const Vec3 center{hn::LoadU(d, &x_[copied_]), hn::LoadU(d, &y_[copied_]), hn::LoadU(d, &z_[copied_])};
            hn::StoreU(hn::Sqrt(dot(center, center)), d, &distance_[copied_]);
        }
    }

    std::span<const Metaball> balls_;
    std::span<const std::uint32_t> index_;
    std::size_t copied_ = 0;  // number of balls copied so far, in whole vectors
    std::vector<float> x_, y_, z_, reach_, distance_;
};

/// A line with bounds on how far the rays of a vector are from it: at the parameter t at most originSpread +
/// directionSpread t.
struct RayBundle {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, 1.0F};
    float originSpread = 0.0F;
    float directionSpread = 0.0F;

    /// @param rays  the lanes that are cast
    RayBundle(const CameraFrame& frame, const ImagePoint& at, M rays) {
        // Centers are known to some 1e-7 of their distance, and the kernels see the rounding of their squares.
        constexpr float kRounding = 1e-5F;
        const glm::vec2 low(hn::GetLane(minOfLanes(at.x, rays)), hn::GetLane(minOfLanes(at.y, rays)));
        const glm::vec2 high(-hn::GetLane(minOfLanes(hn::Neg(at.x), rays)),
                             -hn::GetLane(minOfLanes(hn::Neg(at.y), rays)));
        const glm::vec2 middle = 0.5F * (low + high);
        const glm::vec2 half = high - middle;
        const float spread = std::sqrt(dot(half, half)) * (1.0F + kRounding);
        (frame.perspective ? direction : origin) += glm::vec3(middle, 0.0F);
        (frame.perspective ? directionSpread : originSpread) = spread;
        directionSpread += kRounding;
    }
};

/// Tells which balls of a tile a bundle of rays may meet at or beyond a view depth. The test is conservative: a ball
/// that it leaves out is out of reach of every ray of the bundle.
class BallCulling {
 public:
    BallCulling(TileBalls& balls, const RayBundle& bundle, float minDepth)
        : balls_(balls),
          bundle_(bundle),
          inverseSquare_(1.0F / dot(bundle.direction, bundle.direction)),
          minDepth_(minDepth) {}

    /// A bit for each ball of the vector that begins with ball `first`, set if some ray may meet it.
    std::uint32_t mayMeet(std::size_t first) const {
        const D d;
        const Vec3 direction = splat(bundle_.direction);
        const TileBalls::BallVector balls = balls_.load(first);
        const Vec3 offset = balls.center - splat(bundle_.origin);
        const V closest = dot(offset, direction) * splat(inverseSquare_);
        const Vec3 away = pointOnRay(offset, hn::Neg(closest), direction);
        const V limit =
            balls.reach + splat(bundle_.originSpread) + splat(bundle_.directionSpread) * (balls.reach + balls.distance);
        const M isMet = hn::And(dot(away, away) < limit * limit, offset.z + balls.reach >= splat(minDepth_));
        return maskBits(hn::And(isMet, hn::FirstN(d, balls_.size() - first)));
    }

 private:
    TileBalls& balls_;
    RayBundle bundle_;
    float inverseSquare_;
    float minDepth_;
};

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
