// SIMD code, compiled once per instruction set, with one particle in each lane.
#include "engine/stepping/kick_drift.h"

#include "engine/state/state_checks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/stepping/kick_drift.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/core/simd_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

/// Updates as many particles from index `first` on as D has lanes; returns whether their new positions and velocities
/// are valid.
template <class D, bool addsWeight>
bool move(const KickDrift& step, std::size_t first, Particles& particles) {
    using V = hn::Vec<D>;
    static constexpr D kTag{};  // static, so that the lambdas need not capture it
    const auto read = [](const Vec3& at) {
        Vector3<V> vectors;
        hn::LoadInterleaved3(kTag, at.data(), vectors.x, vectors.y, vectors.z);
        return vectors;
    };
    const auto write = [](const Vector3<V>& vectors, Vec3& at) {
        hn::StoreInterleaved3(vectors.x, vectors.y, vectors.z, kTag, at.data());
    };
    const auto areBelow = [](const Vector3<V>& vectors, double limit) {  // false for a NaN
        const V largest = hn::Set(kTag, limit);
        return hn::And(hn::And(hn::Lt(hn::Abs(vectors.x), largest), hn::Lt(hn::Abs(vectors.y), largest)),
                       hn::Lt(hn::Abs(vectors.z), largest));
    };
    const V h = hn::Set(kTag, step.h);
    const V mass = hn::LoadU(kTag, &particles.mass[first]);
    Vector3<V> force = read(step.forces[first]);
    if constexpr (addsWeight)
        addScaled(force, mass,
                  {hn::Set(kTag, step.gravity.x()), hn::Set(kTag, step.gravity.y()), hn::Set(kTag, step.gravity.z())});
    Vector3<V> velocity = read(particles.velocity[first]);
    addScaled(velocity, hn::Div(h, mass), force);
    velocity = scaled(hn::Set(kTag, step.decay), velocity);
    Vector3<V> position = read(particles.position[first]);
    addScaled(position, h, velocity);
    write(velocity, particles.velocity[first]);
    write(position, particles.position[first]);
    return hn::AllTrue(kTag, hn::And(areBelow(position, kWorldLimit), areBelow(velocity, kFastest)));
}

/// Updates full vectors of particles, then the remaining particles one by one.
template <bool addsWeight>
bool moveAll(const KickDrift& step, std::size_t begin, std::size_t end, Particles& particles) {
    using Many = hn::ScalableTag<double>;
    using One = hn::CappedTag<double, 1>;
    bool areValid = true;
    std::size_t p = begin;
    for (; p + hn::Lanes(Many()) <= end; p += hn::Lanes(Many())) areValid &= move<Many, addsWeight>(step, p, particles);
    for (; p < end; ++p) areValid &= move<One, addsWeight>(step, p, particles);
    return areValid;
}

bool kickAndDriftHere(const KickDrift& step, std::size_t begin, std::size_t end, Particles& particles) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    return step.hasWeight ? moveAll<false>(step, begin, end, particles) : moveAll<true>(step, begin, end, particles);
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
