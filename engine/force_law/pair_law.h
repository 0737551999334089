// The force between two particles: equations 2, 5 and 6 of Cote 2024, and the pair energy, stiffness and friction that
// belong to it. Start reading here. Force and friction are in pair_force-inl.h, which is compiled both for plain
// numbers and for SIMD vectors and serves particles and obstacles. This file has what is computed with plain numbers
// only: constants, energy and stiffness of a pair.
//
// Symbols. P = x_p - x_i is the separation of particles p and i, D its length, V = v_p - v_i their relative velocity.
// D0 = r_p + r_i is the rest length, R = c_r D0 where repulsion and attraction end, S = c_d D0 where damping ends. In a
// material with cohesion the repulsion reaches a little further, as if D0 were lambda D0 in the first two of the three,
// and there is a pull between D0 and S_c = kPullReach D0.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "engine/core/vec3.h"
#include "engine/force_law/material.h"

namespace engine {

/// The terms of the force law that a kernel over pairs is compiled with.
struct PairTerms {
    bool attraction = true;   ///< whether particles attract: c_r is above 1
    bool damping = true;      ///< whether there is damping: b_d is above 0
    bool friction = false;    ///< whether there is friction: mu is above 0
    bool equalReach = false;  ///< whether attraction and damping end at one distance (R = S) in every damped pair
    bool cohesion = false;    ///< whether particles pull on each other beyond their rest length: kappa is above 0
};

/// Calls visit.operator()<terms>() with the cheapest compiled combination of terms that contains all needed terms, and
/// returns the result of visit. Few scenes need friction or cohesion, so there is only one combination with each of
/// them, and one with both, which contains everything.
template <class Visit>
auto withTerms(PairTerms needed, const Visit& visit) {
    if (needed.cohesion && needed.friction)
        return visit.template operator()<PairTerms{true, true, true, false, true}>();
    if (needed.cohesion) return visit.template operator()<PairTerms{true, true, false, false, true}>();
    if (needed.friction) return visit.template operator()<PairTerms{true, true, true}>();
    if (needed.damping && needed.equalReach) return visit.template operator()<PairTerms{true, true, false, true}>();
    if (needed.attraction && needed.damping) return visit.template operator()<PairTerms{true, true}>();
    if (needed.attraction) return visit.template operator()<PairTerms{true, false}>();
    if (needed.damping) return visit.template operator()<PairTerms{false, true}>();
    return visit.template operator()<PairTerms{false, false}>();
}

/// The terms of the conservative force: attraction, repulsion and cohesion without damping and friction.
inline constexpr PairTerms kConservative{.attraction = true, .damping = false, .cohesion = true};

/// All terms that act along the line between two particles.
inline constexpr PairTerms kAlongLine{.attraction = true, .damping = true, .cohesion = true};

/// Reach S_c of the pull of cohesion, in rest lengths. Chosen: see cohesion.h.
inline constexpr double kPullReach = 3.0;

/// The terms of the force between particles and obstacles (section 3.2 of the paper): repulsion and damping, no
/// attraction.
inline constexpr PairTerms kRepulsorTerms{.attraction = false, .damping = true};

/// Slip speed below which friction is viscous, m/s. Chosen: if all layers of a heap creep over each other at this
/// speed, it moves a centimeter in ten seconds.
inline constexpr double kStickingSpeed = 1e-3;

// The functions that pair_force-inl.h needs, for plain numbers. core/simd_vectors-inl.h has the same functions for
// SIMD vectors.
template <std::floating_point Number>
Number larger(Number a, Number b) {
    return std::max(a, b);
}
template <std::floating_point Number>
Number atLeast(Number number, double bound) {
    return std::max(number, static_cast<Number>(bound));
}
template <std::floating_point Number>
Number atMost(Number number, double bound) {
    return std::min(number, static_cast<Number>(bound));
}
template <std::floating_point Number>
Number times(double factor, Number number) {
    return static_cast<Number>(factor) * number;
}
template <std::floating_point Number>
Number lessFrom(double from, Number number) {
    return static_cast<Number>(from) - number;
}
template <std::floating_point Number>
Number positivePart(Number number) {
    return std::max(Number(0), number);
}
template <std::floating_point Number>
Number reciprocal(Number number) {
    return Number(1) / number;
}
template <std::floating_point Number>
Number squareRoot(Number number) {
    return std::sqrt(number);
}

// Included inside namespace engine on purpose: the formulas are compiled again in other namespaces, for SIMD vectors.
#include "engine/force_law/pair_force-inl.h"

/// Constants of the force law for a pair of particles of the given material; for unlike particles that is mixed() of
/// the two.
/// @param restLength  D0 = r_i + r_p, in meters
template <std::floating_point Number>
PairConstants<Number> pairConstants(const Material& material, double restLength) {
    const double rest = material.restRatio * restLength;
    const double reach = material.repulsionReach * rest;
    const double damping = material.dampingReach * restLength;
    const double core = material.coreFraction * restLength;
    PairConstants<Number> c;
    c.b1 = static_cast<Number>(material.repulsion);
    c.bd = static_cast<Number>(material.damping);
    c.inverseRestSq = static_cast<Number>(1.0 / (rest * rest));
    c.inverseReachSq = static_cast<Number>(1.0 / (reach * reach));
    c.reachSq = static_cast<Number>(reach * reach);
    c.inverseDampingSq = static_cast<Number>(1.0 / (damping * damping));
    c.coreSq = static_cast<Number>(core * core);
    c.friction = static_cast<Number>(material.friction);
    c.cutoffSq = material.damping > 0.0 ? static_cast<Number>(std::max(reach * reach, damping * damping)) : c.reachSq;
    const double pullReach = kPullReach * restLength;
    c.pull = static_cast<Number>(material.pull);
    c.pullReachSq = static_cast<Number>(pullReach * pullReach);
    c.inversePullWidth = static_cast<Number>(1.0 / (pullReach * pullReach - restLength * restLength));
    if (material.pull > 0.0) c.cutoffSq = std::max(c.cutoffSq, c.pullReachSq);
    return c;
}

/// The constants at a rest length of 1 m, from which atRestLength() computes those of pairs of any radii. 1/R^2 and
/// 1/S^2 are a few units in the last place too large, and S_c^2 is as much too small, so that no rounding lets a pair
/// act at or beyond its cutoff.
template <std::floating_point Number>
PairConstants<Number> constantsPerRestLength(const Material& material) {
    // Six roundings by half a unit each, of D0, 1/D0^2, the constants here and their product.
    constexpr Number kOutward = 1 + 8 * std::numeric_limits<Number>::epsilon();
    PairConstants<Number> c = pairConstants<Number>(material, 1.0);
    c.inverseReachSq *= kOutward;
    c.inverseDampingSq *= kOutward;
    c.pullReachSq /= kOutward;
    return c;
}

/// Pair energy U(D) of the conservative part, in joules: minus the integral of the force from the cutoff.
///   U = b1 { (D^-3 - R^-3)/3 - A (1/D - 1/R) + B (R - D) },  A = 1/D0^2 + 1/R^2,  B = 1/(D0^2 R^2)
/// Below the core distance Dc, where F = F(Dc) D/Dc: U = U(Dc) + F(Dc) (Dc^2 - D^2) / (2 Dc). The energy of the pull is
/// added where there is one. Forced inline, so that subexpressions that force and energy of a pair share are computed
/// once.
template <std::floating_point Number>
[[gnu::always_inline]] inline Number pairEnergy(Number distance, const PairConstants<Number>& c) {
    const Number pulled = c.pull > Number(0) ? pullEnergy(distance * distance, c) : Number(0);
    if (distance * distance >= c.reachSq) return pulled;
    const Number core = std::sqrt(c.coreSq);
    const Number guarded = std::max(distance, core);
    const Number reach = std::sqrt(c.reachSq);
    const Number inverse = Number(1) / guarded;
    const Number inverseReach = Number(1) / reach;
    const Number cubes = (inverse * inverse * inverse - inverseReach * inverseReach * inverseReach) / Number(3);
    const Number a = c.inverseRestSq + c.inverseReachSq;
    const Number b = c.inverseRestSq * c.inverseReachSq;
    const Number outside = c.b1 * (cubes - a * (inverse - inverseReach) + b * (reach - guarded));
    if (distance >= core) return outside + pulled;
    const Number slope = pairCoefficient<kConservative>(c.coreSq, Number(0), c);
    return outside + slope * (c.coreSq - distance * distance) / Number(2) + pulled;
}

/// Stiffness k = -dF/dD of the conservative part, in N/m; negative where the force softens with approach.
///   k = b1 (4 D^-5 - 2 A D^-3), and -F(Dc)/Dc below the core distance Dc,
/// and that of the pull where there is one.
template <std::floating_point Number>
Number pairStiffness(Number distance, const PairConstants<Number>& c) {
    const Number distanceSq = distance * distance;
    const Number v = pullShare(distanceSq, c);
    const Number pulled = v < Number(1) ? pullStiffness(distanceSq, v, c) : Number(0);
    if (distanceSq >= c.reachSq) return pulled;
    if (distanceSq < c.coreSq) return -pairCoefficient<kConservative>(c.coreSq, Number(0), c);
    const Number inverse = Number(1) / distance;
    const Number inverseCubed = inverse * inverse * inverse;
    const Number a = c.inverseRestSq + c.inverseReachSq;
    return c.b1 * (Number(4) * inverseCubed * inverse * inverse - Number(2) * a * inverseCubed) + pulled;
}

/// Replacement for the separation P (m) of two particles that coincide exactly, where P has no direction: a random
/// vector of length kCoincidentShare * restLength, determined by the particles' ids. Swapping the ids only changes its
/// sign.
Vec3 coincidentSeparation(std::uint32_t idP, std::uint32_t idI, double restLength);

/// Length of the replacement for the separation of coincident particles, in rest lengths. Chosen: long enough for the
/// force to separate the pair within a few steps, short compared with any core distance.
inline constexpr double kCoincidentShare = 0.01;

}  // namespace engine
