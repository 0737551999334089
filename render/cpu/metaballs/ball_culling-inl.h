// The balls of a tile that a group of rays may meet, told a vector of balls at a time. Part of metaball_cast.cpp,
// compiled once per instruction set.
#if defined(RENDER_SIEVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIEVE_INL_H_
#undef RENDER_SIEVE_INL_H_
#else
#define RENDER_SIEVE_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <hwy/highway.h>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The balls of a tile's list side by side, front to back, a vector at a time as they are asked for: most lie behind
/// the surface, where no ray comes.
class TileBalls {
 public:
    /// Those of another tile.
    void begin(const FieldCast& cast, std::size_t tile) {
        const CellLists& tiles = *cast.tiles;
        balls_ = cast.balls;
        index_ = std::span(tiles.items).subspan(tiles.begin[tile], tiles.begin[tile + 1] - tiles.begin[tile]);
        copied_ = 0;
        // Whole vectors are read.
        const std::size_t room = index_.size() + hn::Lanes(D());
        for (std::vector<float>* values : {&x_, &y_, &z_, &reach_, &distance_})
            if (values->size() < room) values->resize(room);
    }

    std::size_t size() const { return index_.size(); }
    std::uint32_t index(std::size_t k) const { return index_[k]; }

    float nearDepth(std::size_t k) {
        copyUpTo(k);
        return z_[k] - reach_[k];
    }

    /// A vector of balls.
    struct Vector {
        Vec3 center;
        V reach;
        V distance;  ///< from the eye or, in parallel projection, from the picture's middle
    };
    Vector from(std::size_t first) {
        const D d;
        copyUpTo(first);
        return {{hn::LoadU(d, &x_[first]), hn::LoadU(d, &y_[first]), hn::LoadU(d, &z_[first])},
                hn::LoadU(d, &reach_[first]),
                hn::LoadU(d, &distance_[first])};
    }

 private:
    /// So far as that is not done yet.
    void copyUpTo(std::size_t k) {
        const D d;
        for (; copied_ <= k; copied_ += hn::Lanes(d)) {
            const std::size_t end = std::min(copied_ + hn::Lanes(d), index_.size());
            for (std::size_t place = copied_; place < end; ++place) {
                const FieldBall& ball = balls_[index_[place]];
                x_[place] = ball.center.x;
                y_[place] = ball.center.y;
                z_[place] = ball.center.z;
                reach_[place] = ball.reach;
            }
            const Vec3 center{hn::LoadU(d, &x_[copied_]), hn::LoadU(d, &y_[copied_]), hn::LoadU(d, &z_[copied_])};
            hn::StoreU(hn::Sqrt(dot(center, center)), d, &distance_[copied_]);
        }
    }

    std::span<const FieldBall> balls_;
    std::span<const std::uint32_t> index_;
    std::size_t copied_ = 0;  // whole vectors of them
    std::vector<float> x_, y_, z_, reach_, distance_;
};

/// A line that no ray of a group is far from.
struct Bundle {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, 1.0F};
    float apart = 0.0F;  ///< of the origins
    float widen = 0.0F;  ///< of the directions

    /// at: where the group's rays cross the plane; rays: those of its lanes that are cast.
    Bundle(const CameraFrame& frame, const ImagePoint& at, M rays) {
        // Centers are known to some 1e-7 of their distance, and the kernels see the rounding of their squares.
        constexpr float kRounding = 1e-5F;
        const glm::vec2 least(hn::GetLane(minOfLanes(at.x, rays)), hn::GetLane(minOfLanes(at.y, rays)));
        const glm::vec2 most(-hn::GetLane(minOfLanes(hn::Neg(at.x), rays)),
                             -hn::GetLane(minOfLanes(hn::Neg(at.y), rays)));
        const glm::vec2 middle = 0.5F * (least + most);
        const glm::vec2 half = most - middle;
        const float spread = std::sqrt(dot(half, half)) * (1.0F + kRounding);
        (frame.perspective ? direction : origin) += glm::vec3(middle, 0.0F);
        (frame.perspective ? widen : apart) = spread;
        widen += kRounding;
    }
};

/// Tells which balls of a tile rays may meet beyond a depth. A ball that is left out is out of reach of each of them:
/// on a ray of the bundle, a place t from its beginning is at most apart + widen t from the bundle's line.
class Sieve {
 public:
    Sieve(TileBalls& balls, const Bundle& bundle, float begin)
        : balls_(balls),
          bundle_(bundle),
          inverseSquare_(1.0F / dot(bundle.direction, bundle.direction)),
          begin_(begin) {}

    /// A bit for each of the vector of balls from this one on.
    std::uint32_t met(std::size_t first) const {
        const D d;
        const Vec3 direction = splat(bundle_.direction);
        const TileBalls::Vector balls = balls_.from(first);
        const Vec3 off{hn::Sub(balls.center.x, splat(bundle_.origin.x)),
                       hn::Sub(balls.center.y, splat(bundle_.origin.y)), balls.center.z};
        const V closest = hn::Mul(dot(off, direction), splat(inverseSquare_));
        const Vec3 away = pointOnRay(off, hn::Neg(closest), direction);
        const V limit = hn::Add(hn::Add(balls.reach, splat(bundle_.apart)),
                                hn::Mul(splat(bundle_.widen), hn::Add(balls.reach, balls.distance)));
        const M met =
            hn::And(hn::Lt(dot(away, away), hn::Mul(limit, limit)), hn::Ge(hn::Add(off.z, balls.reach), splat(begin_)));
        return maskBits(hn::And(met, hn::FirstN(d, balls_.size() - first)));
    }

 private:
    TileBalls& balls_;
    Bundle bundle_;
    float inverseSquare_;
    float begin_;
};

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
