// The kernels of a vector of balls of a set around a point, shared by the kernels that are compiled once per
// instruction set. Included by Highway's rules, from which the guard below comes.
#if defined(RENDER_BALL_SET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_BALL_SET_INL_H_
#undef RENDER_BALL_SET_INL_H_
#else
#define RENDER_BALL_SET_INL_H_
#endif

#include <array>
#include <cstddef>

#include <hwy/highway.h>
#include <glm/glm.hpp>

#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/cells/simd_sums-inl.h"
#include "render/prepare/rays/ball_set.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The terms of the kernels of a vector of balls around a point p. The square root of a kernel is peak - d^T F d, where
/// d is the vector from the ball's center to p and F its form, which of a round ball is its squared slope times the
/// identity.
/// @tparam kIsAnisotropic  whether balls are ellipsoids
template <bool kIsAnisotropic>
struct BallTerms {
    Vec3 off;     ///< d, m
    Vec3 turned;  ///< F d, 1/m
    V root;       ///< peak - d^T F d

    HWY_INLINE BallTerms(const BallSet& balls, std::size_t first, const Vec3& point)
        : off(point - Vec3{column(balls, kBallX, first), column(balls, kBallY, first), column(balls, kBallZ, first)}) {
        if constexpr (kIsAnisotropic) {
            const V xy = column(balls, kBallForm + 3, first);
            const V xz = column(balls, kBallForm + 4, first);
            const V yz = column(balls, kBallForm + 5, first);
            turned = {column(balls, kBallForm, first) * off.x + xy * off.y + xz * off.z,
                      xy * off.x + column(balls, kBallForm + 1, first) * off.y + yz * off.z,
                      xz * off.x + yz * off.y + column(balls, kBallForm + 2, first) * off.z};
        } else {
            turned = off * column(balls, kBallForm, first);
        }
        root = column(balls, kBallPeak, first) - dot(off, turned);
    }

    static HWY_INLINE V column(const BallSet& balls, std::size_t value, std::size_t first) {
        return hn::LoadU(D(), balls.column(value) + first);
    }
};

static_assert(BallSet::kSetBlock == kBlock);

/// A sum over the balls of a set.
class SetSum {
 public:
    HWY_INLINE SetSum() {
        for (std::size_t v = 0; v < kVectorsPerBlock; ++v) sums_[v] = splat(0.0F);
    }
    /// Adds the values of the v-th vector of a block.
    HWY_INLINE void add(std::size_t v, V values) { sums_[v] = sums_[v] + values; }
    HWY_INLINE float total() const { return render::HWY_NAMESPACE::total(sums_); }
    HWY_INLINE const BlockSum& sums() const { return sums_; }

 private:
    BlockSum sums_;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE glm::vec4 totals(const SetSum& a, const SetSum& b, const SetSum& c, const SetSum& e) {
    return {a.total(), b.total(), c.total(), e.total()};
}

#else

/// Adds up accumulators until four are left, in the order of total() in simd_sums-inl.h.
template <std::size_t kVectors>
HWY_INLINE auto foldedToFour(const std::array<V, kVectors>& sum) {
    if constexpr (kVectors == 1) {
        const hn::Half<D> d8;
        const hn::Half<hn::Half<D> > d4;
        const auto eight = hn::LowerHalf(d8, sum[0]) + hn::UpperHalf(d8, sum[0]);
        return hn::LowerHalf(d4, eight) + hn::UpperHalf(d4, eight);
    } else if constexpr (kVectors == 2) {
        const hn::Half<D> d4;
        const V eight = sum[0] + sum[1];
        return hn::LowerHalf(d4, eight) + hn::UpperHalf(d4, eight);
    } else {
        return (sum[0] + sum[2]) + (sum[1] + sum[3]);
    }
}

/// The totals of four sums: together they take little longer than one.
HWY_INLINE glm::vec4 totals(const SetSum& a, const SetSum& b, const SetSum& c, const SetSum& e) {
    const hn::CappedTag<float, 4> d;
    const auto fourA = foldedToFour(a.sums());
    const auto fourB = foldedToFour(b.sums());
    const auto fourC = foldedToFour(c.sums());
    const auto fourE = foldedToFour(e.sums());
    // As in total(), numbers 0 and 2 of each four are added, 1 and 3, and their sums.
    const auto pairsAb = hn::InterleaveLower(d, fourA, fourB) + hn::InterleaveUpper(d, fourA, fourB);
    const auto pairsCe = hn::InterleaveLower(d, fourC, fourE) + hn::InterleaveUpper(d, fourC, fourE);
    alignas(16) glm::vec4 found;
    hn::Store(hn::ConcatLowerLower(d, pairsCe, pairsAb) + hn::ConcatUpperUpper(d, pairsCe, pairsAb), d, &found.x);
    return found;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
