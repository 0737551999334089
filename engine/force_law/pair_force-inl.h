// The force law and the friction, written once for plain numbers and for SIMD vectors. pair_law.h includes this file
// into namespace engine for double and float; simd_forces.cpp and external_forces.cpp include it again for each
// instruction set, because a function that is inlined into a SIMD kernel must be compiled for that instruction set.
// Hence there is no include guard and no namespace here, and the formulas use nothing but +, -, *, / and larger(),
// atLeast(), atMost(), times(), lessFrom(), positivePart(), reciprocal() and squareRoot(), which the includer defines
// for its Number. Every path computes the same bits. All functions are forced inline, so that a kernel computes once
// what two of them share.
//
// With the symbols of pair_law.h, m = 5, n = 3 and b2 = b1/D0^2, equation 2 is P times the coefficient
//     s_r (b1/D^5 - b2/D^3) - s_d b_d (V.P)/D^2,   s_r = max(0, 1 - D^2/R^2),  s_d = max(0, 1 - D^2/S^2)
//   = (1/D) b1 (1/D^2 - 1/D0^2) max(0, 1/D^2 - 1/R^2)  -  b_d (V.P) max(0, 1/D^2 - 1/S^2)
// because s_r b1/D^5 (1 - D^2/D0^2) = b1/D (1/D^2)(1 - D^2/R^2)(1/D^2)(1 - D^2/D0^2). Rounding keeps the order of
// quotients: at and beyond the cutoff both terms are exactly zero.
//
// The treatment of small distances is the only departure from the paper: below the core distance the coefficient keeps
// its value at the core distance, so that the force falls linearly to zero instead of growing without bound, and the
// energy is finite. With a core distance of half the rest length, which is the radius of equal particles, the published
// program limits D in the same way.

/// The constants of the force law for one pair, computed once from the pair's material and rest length.
template <class Number>
struct PairConstants {
    Number b1;                ///< strength b1 of the repulsion, N m^4
    Number bd;                ///< damping coefficient b_d, kg/s
    Number inverseRestSq;     ///< 1/D0^2 with the rest length D0, 1/m^2
    Number inverseReachSq;    ///< 1/R^2 with the reach R of the conservative force, 1/m^2
    Number reachSq;           ///< R^2, m^2
    Number inverseDampingSq;  ///< 1/S^2 with the reach S of the damping, 1/m^2
    Number coreSq;            ///< square of the core distance, m^2
    Number friction;          ///< mu
    Number cutoffSq;          ///< square of the distance at and beyond which nothing acts, m^2
    Number pull;              ///< strength kappa of the pull of cohesion, N/m
    Number pullReachSq;       ///< S_c^2 with the reach S_c of the pull, m^2
    Number inversePullWidth;  ///< 1/(S_c^2 - D0^2), 1/m^2
};

/// The constants of a pair with the rest length D0 (m), from those of the same materials at a rest length of 1 m, which
/// are constantsPerRestLength(). Only 1/D0^2 takes a division.
template <bool hasPull, class Number>
[[gnu::always_inline]] inline PairConstants<Number> atRestLength(const PairConstants<Number>& perRestLength,
                                                                 Number restLength) {
    const Number restSq = restLength * restLength;
    PairConstants<Number> c = perRestLength;
    c.inverseRestSq = reciprocal(restSq);
    if constexpr (hasPull) {
        c.pullReachSq = restSq * perRestLength.pullReachSq;
        c.inversePullWidth = c.inverseRestSq * perRestLength.inversePullWidth;
    }
    c.inverseReachSq = c.inverseRestSq * perRestLength.inverseReachSq;
    c.inverseDampingSq = c.inverseRestSq * perRestLength.inverseDampingSq;
    c.reachSq = restSq * perRestLength.reachSq;
    c.coreSq = restSq * perRestLength.coreSq;
    c.cutoffSq = restSq * perRestLength.cutoffSq;
    if constexpr (hasPull) c.inverseRestSq = c.inverseRestSq * perRestLength.inverseRestSq;
    return c;
}

/// 1/D^2 of a pair, in 1/m^2, where D counts as no smaller than the core distance.
template <class Number>
[[gnu::always_inline]] inline Number guardedInverseSq(Number distanceSq, Number coreSq) {
    return reciprocal(larger(distanceSq, coreSq));
}

// Cohesion. The paper has no surface tension. Beyond the rest length, particles pull on each other with the force
//     kappa D (1 - v) v^2,   v = (S_c^2 - D^2) / (S_c^2 - D0^2),   D0 < D < S_c,
// which is zero with its slope at S_c and zero at D0. It is a polynomial in D^2, so that it takes no root and its
// potential has a closed form. Below D0, v counts as 1. Source of the idea: Tartakovsky and Meakin, Phys. Rev. E 72
// (2005); cohesion.h has kappa.

/// v of the pull: 1 up to the rest length, and exactly 0 at and beyond the reach of the pull.
template <class Number>
[[gnu::always_inline]] inline Number pullShare(Number distanceSq, const PairConstants<Number>& c) {
    return atMost(positivePart(c.pullReachSq - distanceSq) * c.inversePullWidth, 1.0);
}

/// Coefficient of -P in the pull, in N/m.
template <class Number>
[[gnu::always_inline]] inline Number pullCoefficient(Number distanceSq, const PairConstants<Number>& c) {
    const Number v = pullShare(distanceSq, c);
    return (c.pull * (v * v)) * lessFrom(1.0, v);
}

/// Energy of the pull, in joules: minus the integral of its force from its reach,
///   -kappa (S_c^2 - D0^2)/2 (v^3/3 - v^4/4).
template <class Number>
[[gnu::always_inline]] inline Number pullEnergy(Number distanceSq, const PairConstants<Number>& c) {
    const Number v = pullShare(distanceSq, c);
    const Number scale = times(-1.0 / 8.0, c.pull) * reciprocal(c.inversePullWidth);
    return scale * ((v * v) * v) * lessFrom(4.0 / 3.0, v);
}

/// Stiffness of the pull between D0 and S_c, in N/m, negative where the pull grows with distance:
///   kappa (v^2 (1 - v) - 2 D^2 v (2 - 3 v) / (S_c^2 - D0^2)).
/// @param v  pullShare() of the pair; where it is 1, the pull has no stiffness
template <class Number>
[[gnu::always_inline]] inline Number pullStiffness(Number distanceSq, Number v, const PairConstants<Number>& c) {
    const Number bend = times(6.0, distanceSq) * c.inversePullWidth * lessFrom(2.0 / 3.0, v);
    return c.pull * v * (v * lessFrom(1.0, v) - bend);
}

/// Coefficient of P in the conservative part of equation 2, in N/m.
/// @param distanceSq  P.P, in m^2
/// @param inverseSq   guardedInverseSq() of the pair, 1/m^2
/// @param inverse     square root of inverseSq, 1/m
template <PairTerms terms, class Number>
[[gnu::always_inline]] inline Number conservativeFrom(Number distanceSq, Number inverseSq, Number inverse,
                                                      const PairConstants<Number>& c) {
    const Number toRest = inverseSq - c.inverseRestSq;
    const Number toReach = positivePart(terms.attraction ? inverseSq - c.inverseReachSq : toRest);
    const Number repulsion = c.b1 * inverse * (toRest * toReach);
    if constexpr (terms.cohesion) return repulsion - pullCoefficient(distanceSq, c);
    return repulsion;
}

/// Coefficient of P in equation 2, in N/m, from D^2 (m^2), from 1/D^2 (1/m^2) and 1/D (1/m) with D no smaller than the
/// core distance, and from `approach`, which is V.P (m^2/s).
template <PairTerms terms, class Number>
[[gnu::always_inline]] inline Number coefficientFrom(Number distanceSq, Number inverseSq, Number inverse,
                                                     Number approach, const PairConstants<Number>& c) {
    const Number damping = c.bd * approach;
    if constexpr (!terms.damping) {
        return conservativeFrom<terms>(distanceSq, inverseSq, inverse, c);
    } else if constexpr (terms.equalReach) {
        const Number toRest = inverseSq - c.inverseRestSq;
        return (c.b1 * inverse * toRest - damping) * positivePart(inverseSq - c.inverseReachSq);
    } else {
        return conservativeFrom<terms>(distanceSq, inverseSq, inverse, c) -
               damping * positivePart(inverseSq - c.inverseDampingSq);
    }
}

/// Coefficient of P in equation 2, in N/m; exactly zero at and beyond the cutoff. The result is the same when particles
/// p and i are swapped, so that the force changes its sign and no bit else. Source: Cote 2024, equations 2, 5 and 6,
/// but for the core.
/// @param distanceSq  P.P, in m^2
/// @param approach    V.P, in m^2/s
template <PairTerms terms, class Number>
[[gnu::always_inline]] inline Number pairCoefficient(Number distanceSq, Number approach,
                                                     const PairConstants<Number>& c) {
    const Number inverseSq = guardedInverseSq(distanceSq, c.coreSq);
    return coefficientFrom<terms>(distanceSq, inverseSq, squareRoot(inverseSq), approach, c);
}

/// Damping of a pair along the line between the two particles, divided by D^2: b_d s_d / D^2, in kg/(s m^2). Multiplied
/// by P P^T it is the damping matrix of the pair; multiplied by V.P it is the damping part of the coefficient of P.
/// Zero at and beyond the reach of the damping.
template <class Number>
[[gnu::always_inline]] inline Number pairDampingOverSq(Number distanceSq, const PairConstants<Number>& c) {
    return c.bd * positivePart(guardedInverseSq(distanceSq, c.coreSq) - c.inverseDampingSq);
}

/// Coefficient c_t of the friction force -c_t V_t, in kg/s. The paper has no friction: its force has no tangential
/// part.
///   c_t = mu N / max(|V_t|, kStickingSpeed),   N = max(0, conservative force),   V_t = V - (V.n) n
/// This is Coulomb friction, mu N against the slip velocity V_t. Below the sticking speed, viscous creep takes the
/// place of static friction. Friction only removes energy, since F.V = -c_t V_t^2. It conserves linear but not angular
/// momentum, since particles have no spin.
/// @param normalForce  conservative force along n, in newtons
/// @param slipSq       |V_t|^2, in m^2/s^2
template <class Number>
[[gnu::always_inline]] inline Number slipDamping(Number friction, Number normalForce, Number slipSq) {
    return friction * positivePart(normalForce) / atLeast(squareRoot(slipSq), kStickingSpeed);
}

/// Constants of the pair of a particle and the repulsor of an obstacle (section 3.2 of the paper): c_r = c_d = 1.
/// @param restLength  D0, the sum of the two radii, in meters
/// @param core        the core distance, in meters
template <class Number>
[[gnu::always_inline]] inline PairConstants<Number> repulsorConstants(Number b1, Number bd, Number restLength,
                                                                      Number core) {
    PairConstants<Number> c{};
    c.b1 = b1;
    c.bd = bd;
    c.reachSq = restLength * restLength;
    c.inverseRestSq = c.inverseReachSq = c.inverseDampingSq = reciprocal(c.reachSq);
    c.coreSq = core * core;
    return c;
}

/// Force of an obstacle along its surface's normal on a particle in contact with it, in newtons.
/// @param distance     distance of the particle from the repulsor, at least the core distance, in meters
/// @param normalSpeed  velocity of the particle along the normal, in m/s
template <class Number>
[[gnu::always_inline]] inline Number repulsorForce(Number distance, Number normalSpeed,
                                                   const PairConstants<Number>& c) {
    return distance * pairCoefficient<kRepulsorTerms>(distance * distance, distance * normalSpeed, c);
}
