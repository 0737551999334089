// The force between two particles: equations 2, 5 and 6 of the paper, with the pair energy and stiffness that follow
// from them. Every path over pairs and every obstacle calls it, but for their twins on vectors (lane_law-inl.h,
// outer_forces.cpp), which tests hold to the same bits.
//
// With D0 = r_i + r_p, R = c_r D0 and S = c_d D0, m = 5, n = 3 and b2 = b1/D0^2, equation 2 is P times the coefficient
//     s_r (b1/D^5 - b2/D^3) - s_d b_d (V.P)/D^2
//   = (1/D) b1 (1/D^2 - 1/D0^2) max(0, 1/D^2 - 1/R^2)  -  b_d (V.P) max(0, 1/D^2 - 1/S^2)
// because s_r b1/D^5 (1 - D^2/D0^2) = b1/D (1/D^2)(1 - D^2/R^2)(1/D^2)(1 - D^2/D0^2). A quotient rounds the way the
// exact one goes: at and beyond the cutoff both terms are exactly zero.
//
// The guard near D = 0, the only departure: below the core distance the coefficient keeps the value it has there, so
// that the force falls linearly to zero instead of growing without bound, and the energy is finite. With the core at
// the radius of equal particles (a share of 1/2) this is the clamp of D that the published program has.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/law/material.h"

namespace engine {

/// Chosen: a heap of twenty layers that creeps at this speed everywhere moves a centimeter in ten seconds, m/s.
inline constexpr double kStickingSpeed = 1e-3;

/// The constants of one pair, worked out once from its material and its rest length.
template <class Scalar>
struct PairConstants {
    Scalar b1{};                ///< N m^4
    Scalar bd{};                ///< kg/s
    Scalar inverseRestSq{};     ///< 1/D0^2
    Scalar inverseReachSq{};    ///< 1/R^2
    Scalar reachSq{};           ///< R^2, repulsion and attraction end here
    Scalar inverseDampingSq{};  ///< 1/S^2
    Scalar coreSq{};            ///< square of the guard's distance
    Scalar friction{};          ///< mu
    Scalar cutoffSq{};          ///< nothing acts at or beyond it
};

/// Which terms of the coefficient are compiled.
struct PairTerms {
    bool attraction = true;  ///< c_r above 1
    bool damping = true;     ///< b_d above 0
    bool friction = false;   ///< mu above 0
    bool oneReach = false;   ///< R = S wherever there is damping: both terms end with one factor
};

/// Constants of a pair of the given material (see mixed() for unlike ones) and rest length D0 = r_i + r_p, in meters.
template <class Scalar>
PairConstants<Scalar> pairConstants(const Material& material, double restLength) {
    const double reach = material.repulsionReach * restLength;
    const double damping = material.dampingReach * restLength;
    const double core = material.coreFraction * restLength;
    PairConstants<Scalar> c;
    c.b1 = static_cast<Scalar>(material.repulsion);
    c.bd = static_cast<Scalar>(material.damping);
    c.inverseRestSq = static_cast<Scalar>(1.0 / (restLength * restLength));
    c.inverseReachSq = static_cast<Scalar>(1.0 / (reach * reach));
    c.reachSq = static_cast<Scalar>(reach * reach);
    c.inverseDampingSq = static_cast<Scalar>(1.0 / (damping * damping));
    c.coreSq = static_cast<Scalar>(core * core);
    c.friction = static_cast<Scalar>(material.friction);
    c.cutoffSq = material.damping > 0.0 ? static_cast<Scalar>(std::max(reach * reach, damping * damping)) : c.reachSq;
    return c;
}

/// Damping of a pair along the line between the two, over D^2: b_d s_d / D^2, in kg/(s m^2). Times P P^T it is the
/// pair's damping matrix, times V.P the coefficient of P that damps. Zero at and beyond the damping's reach.
template <class Scalar>
Scalar pairDampingOverSq(Scalar distanceSq, const PairConstants<Scalar>& c) {
    const Scalar inverseSq = Scalar(1) / std::max(distanceSq, c.coreSq);
    return c.bd * std::max(Scalar(0), inverseSq - c.inverseDampingSq);
}

/// Coefficient of P in equation 2, in N/m; exactly zero at and beyond the cutoff.
/// Shape:  distanceSq = P.P (m^2), approach = V.P (m^2/s), P = x_p - x_i, V = v_p - v_i.
/// Holds:  unchanged when p and i are swapped, so that the force negates bit for bit.
/// Source: Cote 2024, equations 2, 5, 6; departs from them only below the core distance.
/// Inline by force, as pairEnergy: what two of them have in common in one pass is then computed once.
template <PairTerms terms, class Scalar>
[[gnu::always_inline]] inline Scalar pairCoefficient(Scalar distanceSq, Scalar approach,
                                                     const PairConstants<Scalar>& c) {
    const Scalar inverseSq = Scalar(1) / std::max(distanceSq, c.coreSq);
    const Scalar pull = c.b1 * std::sqrt(inverseSq);
    const Scalar toRest = inverseSq - c.inverseRestSq;
    const Scalar toReach = std::max(Scalar(0), terms.attraction ? inverseSq - c.inverseReachSq : toRest);
    if constexpr (!terms.damping) return pull * (toRest * toReach);
    if constexpr (terms.oneReach) return (pull * toRest - c.bd * approach) * toReach;
    const Scalar toDamping = std::max(Scalar(0), inverseSq - c.inverseDampingSq);
    return pull * (toRest * toReach) - c.bd * approach * toDamping;
}

/// Pair energy U(D) of the conservative block, in joules: minus the integral of the force from the cutoff.
///   U = b1 { (D^-3 - R^-3)/3 - A (1/D - 1/R) + B (R - D) },  A = 1/D0^2 + 1/R^2,  B = 1/(D0^2 R^2)
/// Below the core distance Dc, where F = F(Dc) D/Dc:  U = U(Dc) + F(Dc) (Dc^2 - D^2) / (2 Dc).
template <class Scalar>
[[gnu::always_inline]] inline Scalar pairEnergy(Scalar distance, const PairConstants<Scalar>& c) {
    if (distance * distance >= c.reachSq) return Scalar(0);
    const Scalar core = std::sqrt(c.coreSq);
    const Scalar guarded = std::max(distance, core);
    const Scalar reach = std::sqrt(c.reachSq);
    const Scalar inverse = Scalar(1) / guarded;
    const Scalar inverseReach = Scalar(1) / reach;
    const Scalar cubes = (inverse * inverse * inverse - inverseReach * inverseReach * inverseReach) / Scalar(3);
    const Scalar a = c.inverseRestSq + c.inverseReachSq;
    const Scalar b = c.inverseRestSq * c.inverseReachSq;
    const Scalar outside = c.b1 * (cubes - a * (inverse - inverseReach) + b * (reach - guarded));
    if (distance >= core) return outside;
    const Scalar slope = pairCoefficient<PairTerms{true, false}>(c.coreSq, Scalar(0), c);
    return outside + slope * (c.coreSq - distance * distance) / Scalar(2);
}

/// Stiffness k = -dF/dD of the conservative block, in N/m; negative where the force softens with approach.
///   k = b1 (4 D^-5 - 2 A D^-3), and -F(Dc)/Dc below the core distance.
template <class Scalar>
Scalar pairStiffness(Scalar distance, const PairConstants<Scalar>& c) {
    const Scalar distanceSq = distance * distance;
    if (distanceSq >= c.reachSq) return Scalar(0);
    if (distanceSq < c.coreSq) return -pairCoefficient<PairTerms{true, false}>(c.coreSq, Scalar(0), c);
    const Scalar inverse = Scalar(1) / distance;
    const Scalar inverseCubed = inverse * inverse * inverse;
    const Scalar a = c.inverseRestSq + c.inverseReachSq;
    return c.b1 * (Scalar(4) * inverseCubed * inverse * inverse - Scalar(2) * a * inverseCubed);
}

/// Friction, a departure from the paper, whose law has nothing tangential: the coefficient c_t of -V_t, in kg/s.
///   c_t = mu N / max(|V_t|, kStickingSpeed),   N = max(0, conservative force),   V_t = V - (V.n) n
/// So the friction is Coulomb's mu N against the slip, and below the sticking speed a viscous creep that takes its
/// sortedIndex: what would stick creeps, at most at that speed. It only removes energy, since F.V = -c_t V_t^2. It
/// keeps linear momentum; angular momentum it does not keep, since particles have no spin to take it up. Shape:
/// normalForce N, newtons; slipSq |V_t|^2, m^2/s^2.
template <class Scalar>
Scalar slipDamping(Scalar friction, Scalar normalForce, Scalar slipSq) {
    return friction * std::max(Scalar(0), normalForce) / std::max(std::sqrt(slipSq), Scalar(kStickingSpeed));
}

/// A stand-in for P when two particles coincide exactly and P has no direction: a short vector drawn from their ids.
/// Shape:  length kCoincidentShare * restLength, m. Holds: swapping the ids negates it bit for bit.
std::array<double, 3> coincidentSeparation(std::uint32_t idP, std::uint32_t idI, double restLength);

/// Chosen: long enough for the linear core to block the pair within a few steps, short beside any core.
inline constexpr double kCoincidentShare = 0.01;

}  // namespace engine
