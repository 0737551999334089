// The balls of a tile that a group of rays may meet, told a vector of balls at a time. Part of metaball_cast.cpp,
// compiled once per instruction set.
#if defined(RENDER_SIEVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIEVE_INL_H_
#undef RENDER_SIEVE_INL_H_
#else
#define RENDER_SIEVE_INL_H_
#endif

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <hwy/highway.h>

#include "render/lane_rays-inl.h"
#include "render/metaball_cast.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The balls of a tile's list side by side, front to back.
struct TileBalls {
    std::vector<float> x, y, z, reach;
    std::vector<float> distance;  ///< from the eye or, in parallel projection, from the picture's middle
    std::span<const std::uint32_t> index;

    void load(const FieldCast& cast, std::size_t tile) {
        const CellLists& tiles = *cast.tiles;
        index = std::span(tiles.items).subspan(tiles.begin[tile], tiles.begin[tile + 1] - tiles.begin[tile]);
        // Whole vectors are read.
        const std::size_t room = index.size() + hn::Lanes(D());
        for (std::vector<float>* values : {&x, &y, &z, &reach, &distance})
            if (values->size() < room) values->resize(room);
        for (std::size_t k = 0; k < index.size(); ++k) {
            const FieldBall& ball = cast.balls[index[k]];
            x[k] = ball.center.x;
            y[k] = ball.center.y;
            z[k] = ball.center.z;
            reach[k] = ball.reach;
        }
        for (std::size_t k = 0; k < index.size(); k += hn::Lanes(D())) {
            const Vec3 center{hn::LoadU(D(), &x[k]), hn::LoadU(D(), &y[k]), hn::LoadU(D(), &z[k])};
            hn::StoreU(hn::Sqrt(dotted(center, center)), D(), &distance[k]);
        }
    }

    float nearDepth(std::size_t k) const { return z[k] - reach[k]; }
};

/// A line that no ray of a group is far from.
struct Bundle {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, 1.0F};
    float apart = 0.0F;  ///< of the origins
    float widen = 0.0F;  ///< of the directions

    /// at: where the group's rays cross the plane; rays: those of its lanes that are cast.
    Bundle(const CameraFrame& frame, const Plane& at, M rays) {
        // Centres are known to some 1e-7 of their distance, and the kernels see the rounding of their squares.
        constexpr float kRounding = 1e-5F;
        const glm::vec2 least(hn::GetLane(leastOf(at.x, rays)), hn::GetLane(leastOf(at.y, rays)));
        const glm::vec2 most(-hn::GetLane(leastOf(hn::Neg(at.x), rays)), -hn::GetLane(leastOf(hn::Neg(at.y), rays)));
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
    Sieve(const TileBalls& balls, const Bundle& bundle, float begin)
        : balls_(balls),
          bundle_(bundle),
          inverseSquare_(1.0F / dot(bundle.direction, bundle.direction)),
          begin_(begin) {}

    /// A bit for each of the vector of balls from this one on.
    std::uint32_t met(std::size_t first) const {
        const D d;
        const Vec3 direction = uniform(bundle_.direction);
        const Vec3 off{hn::Sub(hn::LoadU(d, &balls_.x[first]), all(bundle_.origin.x)),
                       hn::Sub(hn::LoadU(d, &balls_.y[first]), all(bundle_.origin.y)), hn::LoadU(d, &balls_.z[first])};
        const V reach = hn::LoadU(d, &balls_.reach[first]);
        const V closest = hn::Mul(dotted(off, direction), all(inverseSquare_));
        const Vec3 away = along(off, hn::Neg(closest), direction);
        const V limit = hn::Add(hn::Add(reach, all(bundle_.apart)),
                                hn::Mul(all(bundle_.widen), hn::Add(reach, hn::LoadU(d, &balls_.distance[first]))));
        const M met =
            hn::And(hn::Lt(dotted(away, away), hn::Mul(limit, limit)), hn::Ge(hn::Add(off.z, reach), all(begin_)));
        return bitsOf(hn::And(met, hn::FirstN(d, balls_.index.size() - first)));
    }

 private:
    const TileBalls& balls_;
    Bundle bundle_;
    float inverseSquare_;
    float begin_;
};

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
