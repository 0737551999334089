// SIMD code, compiled once per instruction set. The coordinates of the particles lie side by side in memory, three
// numbers a particle, so three SIMD vectors hold the coordinates of as many particles as one vector has lanes.
#include "engine/stepping/kick_drift.h"

#include <array>

#include "engine/stepping/state_checks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/stepping/kick_drift.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Raw arrays of the particles' quantities; force, position and velocity have three numbers a particle.
struct Numbers {
    const double* mass;
    const double* force;
    double* position;
    double* velocity;
};

/// Updates the velocities and positions of as many particles at a time as D has lanes.
template <class D, bool addsWeight>
class Kicker {
    using V = hn::Vec<D>;
    using Indices = decltype(hn::SetTableIndices(D(), static_cast<const std::int64_t*>(nullptr)));
    static constexpr D kTag{};
    static constexpr std::size_t kMost = hn::MaxLanes(D());
    static constexpr std::size_t kAxes = 3;

 public:
    explicit Kicker(const KickDrift& step)
        : h_(hn::Set(kTag, step.h)),
          decay_(hn::Set(kTag, step.decay)),
          particle_{particlesOf(0), particlesOf(1), particlesOf(2)},
          gravity_{gravityOf(step, 0), gravityOf(step, 1), gravityOf(step, 2)} {}

    static std::size_t lanes() { return hn::Lanes(kTag); }

    /// Moves as many particles as there are lanes, from index `first` on; returns whether their new positions and
    /// velocities are valid.
    bool move(const Numbers& all, std::size_t first) const {
        const V mass = hn::LoadU(kTag, all.mass + first);
        const V perMass = hn::Div(h_, mass);
        auto areValid = hn::FirstN(kTag, lanes());
        for (std::size_t k = 0; k < kAxes; ++k) {
            const std::size_t at = kAxes * first + k * lanes();
            V force = hn::LoadU(kTag, all.force + at);
            if constexpr (addsWeight)
                force = hn::Add(force, hn::Mul(hn::TableLookupLanes(mass, particle_[k]), gravity_[k]));
            const V kick = hn::Mul(hn::TableLookupLanes(perMass, particle_[k]), force);
            const V velocity = hn::Mul(decay_, hn::Add(hn::LoadU(kTag, all.velocity + at), kick));
            const V position = hn::Add(hn::LoadU(kTag, all.position + at), hn::Mul(h_, velocity));
            hn::StoreU(velocity, kTag, all.velocity + at);
            hn::StoreU(position, kTag, all.position + at);
            areValid = hn::And(areValid, isBelow(position, kWorldLimit));
            areValid = hn::And(areValid, isBelow(velocity, kFastest));
        }
        return hn::AllTrue(kTag, areValid);
    }

 private:
    /// Whether the numbers are below a limit in magnitude, lane by lane; a NaN is not.
    static hn::Mask<D> isBelow(V number, double limit) { return hn::Lt(hn::Abs(number), hn::Set(kTag, limit)); }

    /// For each lane of one of the three vectors of coordinates, the particle that the coordinate belongs to.
    static Indices particlesOf(std::size_t vector) {
        std::array<std::int64_t, kMost> of;
        for (std::size_t lane = 0; lane < lanes(); ++lane)
            of[lane] = static_cast<std::int64_t>((vector * lanes() + lane) / kAxes);
        return hn::SetTableIndices(kTag, of.data());
    }

    static V gravityOf(const KickDrift& step, std::size_t vector) {
        std::array<double, kMost> of;
        for (std::size_t lane = 0; lane < lanes(); ++lane)
            of[lane] = step.gravity[static_cast<Eigen::Index>((vector * lanes() + lane) % kAxes)];
        return hn::LoadU(kTag, of.data());
    }

    V h_, decay_;
    std::array<Indices, kAxes> particle_;
    std::array<V, kAxes> gravity_;
};

/// Moves full vectors of particles from `first` on; on return `first` is the start of the remainder.
template <class D, bool addsWeight>
bool moveMany(const KickDrift& step, const Numbers& all, std::size_t& first, std::size_t end) {
    const Kicker<D, addsWeight> kicker(step);
    bool areValid = true;
    for (; first + kicker.lanes() <= end; first += kicker.lanes()) areValid &= kicker.move(all, first);
    return areValid;
}

template <bool addsWeight>
bool moveAll(const KickDrift& step, const Numbers& all, std::size_t begin, std::size_t end) {
    std::size_t first = begin;
    const bool areValid = moveMany<hn::ScalableTag<double>, addsWeight>(step, all, first, end);
    return moveMany<hn::CappedTag<double, 1>, addsWeight>(step, all, first, end) && areValid;
}

bool kickAndDriftHere(const KickDrift& step, std::size_t begin, std::size_t end, Particles& particles) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const Numbers all{particles.mass.data(), step.forces.data()->data(), particles.position.data()->data(),
                      particles.velocity.data()->data()};
    return step.hasWeight ? moveAll<false>(step, all, begin, end) : moveAll<true>(step, all, begin, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(kickAndDriftHere);

bool kickAndDrift(const KickDrift& step, std::size_t begin, std::size_t end, Particles& particles) {
    if (begin == end) return true;
    return HWY_DYNAMIC_DISPATCH(kickAndDriftHere)(step, begin, end, particles);
}

}  // namespace engine

#endif
