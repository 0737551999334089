// The force between a particle and a surface that it touches, by one of two laws. In both, a repulsor lies behind the
// point of the surface that is closest to the particle: a particle at rest that acts on this particle alone, with the
// pair force of pair_law.h.
//
// The paper's walls (section 3.2): the repulsor has the same radius, strength and damping for particles of any kind. A
// heavy particle sinks in and a fine one does not, and what presses hard enough gets through.
//
// Scaled walls are as if made of the particle's own material, several times as stiff:
// - The repulsor has the particle's radius r and its strength b1 times kWallStiffness, so that a layer on the floor is
//   compressed less than the layers above it. The strength is at least that with which the wall carries the weight of
//   one particle whose center is half a radius above it, so that heavy particles of a soft material lie on the floor.
// - Damping. With the potential U of the repulsor's force f and w = sqrt(2 U / m), a damping coefficient of
//       c = 2 zeta f / w
//   turns the motion along the normal, m dv/dt = f - c v, into that of a damped oscillator, dv/ds = w - 2 zeta v and
//   dw/ds = -v with ds = f/(m w) dt. Therefore the ratio of the speeds after and before a rebound is the same at every
//   speed: the restitution e = exp(-pi zeta / sqrt(1 - zeta^2)). Where the scene gives no restitution, the damping of
//   the particle's material is added, with b_d c_d in place of the paper's 5 c_d, so that what is viscous does not
//   bounce.
// - Friction is Coulomb's, of the force f.
// - Adhesion (after Derjaguin, Muller and Toporov) pulls with a constant force wherever f acts, and fades over another
//   radius. It is a stress times the area of a particle in a layer of closest packing. It is not part of f, so that f
//   balances it in an adhering particle at rest, and friction holds the particle.
// - Wetting. To part a liquid of the surface tension sigma from a surface takes the work sigma (1 + cos theta) on a
//   unit of area, with the contact angle theta (Young and Dupre). The surface pulls on particles of such a liquid like
//   adhesion, but fades over L = 4 radii, so that it acts on the first three layers of closest packing. They are
//   2 sqrt(2/3) r apart, the first a radius above the surface, and have the energies -w_k L times the stress on a unit
//   of area. The sum of w_k is 0.652 (kWettedLayers), so that the stress is sigma (1 + cos theta) / (0.652 L).
// The steppers stop centers of particles at the surface; see obstacles/barriers.h.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/force_law/pair_law.h"
#include "engine/obstacles/obstacle_surfaces.h"

namespace engine {

/// Strength b1 of a scaled wall over that of the particle's material. Chosen: with 8 no particle of the scene liquid
/// lies deeper in its floor than two thirds of a radius; with 4 the error of the case hard/dam exceeds its limit.
inline constexpr double kWallStiffness = 8.0;

/// The contact of a particle and a surface under the paper's law: a pair of the particle and the repulsor.
struct RepulsorContact {
    PairConstants<double> constants = {};
    double distance = 0.0;    ///< distance to the repulsor, at least the core distance, m
    double beyondCore = 0.0;  ///< how far the repulsor is inside the core distance, m
};

/// The contact of a particle and a surface.
struct Contact {
    RepulsorContact repulsor;  ///< unused under the scaled law
    bool isPaper = true;
    double friction = 0.0;  ///< coefficient mu
    // Of scaled walls, all along the normal:
    double pressure = 0.0;        ///< repulsion, N
    double damping = 0.0;         ///< kg/s
    double stiffness = 0.0;       ///< N/m
    double energy = 0.0;          ///< of the repulsion, J
    double adhesion = 0.0;        ///< force with which the wall pulls, N
    double adhesionEnergy = 0.0;  ///< energy of that force, J, not positive
};

inline RepulsorContact repulsorContact(const Surface& surface, const RepulsorLaw& law, const Probe& probe) {
    const double restLength = probe.radius + surface.repulsorRadius;
    const double core = law.coreFraction * restLength;
    const double distance = surface.height + surface.repulsorRadius;
    RepulsorContact contact;
    contact.constants = repulsorConstants(law.repulsion, law.dampingFactor * probe.dampingReach, restLength, core);
    contact.distance = std::max(distance, core);
    contact.beyondCore = contact.distance - distance;
    return contact;
}

inline double repulsorForceOf(const RepulsorContact& contact, double normalSpeed) {
    return repulsorForce(contact.distance, normalSpeed, contact.constants);
}

/// Strength b1 of the repulsors of scaled walls for a particle under gravity of this size (m/s^2), N m^4.
inline double wallStrength(const Probe& probe, double gravity) {
    // The force at D = 3/2 r over b1/r^4, with D0 = 2 r: (1/(3/2)^2 - 1/2^2)^2.
    constexpr double kHalfRadiusForce = (1.0 / 2.25 - 0.25) * (1.0 / 2.25 - 0.25);
    const double square = probe.radius * probe.radius;
    return std::max(kWallStiffness * probe.repulsion, probe.mass * gravity * square * square / kHalfRadiusForce);
}

/// Growth of a scaled wall's stiffness with depth where a contact with it begins, in N/m^2: with D0 - D = d, the force
/// is 4 b1 d^2 / D0^6 at first.
inline double hardeningAtContact(const Obstacles& obstacles, const Probe& probe) {
    const double restLength = 2.0 * probe.radius;
    const double square = restLength * restLength;
    return 8.0 * wallStrength(probe, obstacles.gravity) / (square * square * square);
}

/// Adds to a contact a pull that fades beyond a particle's radius.
/// @param t      height above that, as a share of the range
/// @param force  of the pull, N
/// @param range  over which it fades, m
inline void addPull(Contact& contact, double t, double force, double range) {
    if (t <= 0.0) {
        contact.adhesion += force;
        contact.adhesionEnergy += force * range * (t - 0.5);
    } else if (t < 1.0) {
        contact.adhesion += force * (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t);
        contact.adhesionEnergy -= force * range * (0.5 - t + t * t * t - 0.5 * t * t * t * t);
    }
}

/// Adds the adhesion and the wetting of a surface.
inline void addAdhesion(Contact& contact, const Surface& surface, const Probe& probe) {
    const WallSurface& wall = *surface.wall;
    const double radius = probe.radius;
    const double area = 2.0 * std::numbers::sqrt3 * radius * radius;
    if (wall.adhesion > 0.0) addPull(contact, surface.height / radius - 1.0, wall.adhesion * area, radius);
    if (wall.wetting == 0.0 || probe.cohesion == 0.0) return;
    constexpr double kWettedLayers = 0.652;  // derived, see above
    const double range = (kWettingReach - 1.0) * radius;
    const double stress = probe.cohesion * wall.wetting / (kWettedLayers * range);
    addPull(contact, (surface.height - radius) / range, stress * area, range);
}

/// Sets the repulsion of a scaled wall and its damping. Force, energy and stiffness are those of pair_law.h for c_r =
/// 1, in terms of q = 1/D - 1/D0, which keeps all digits where a contact begins:
///   f = b1 q^2 (1/D + 1/D0)^2,  U = b1 q^3 (1/3 + D/D0),  k = 4 b1 q (1/D + 1/D0) / D^3
/// The center of a particle is below the surface only if it has started there; the force is then that at the surface.
[[gnu::always_inline]] inline void setRepulsion(Contact& contact, const Surface& surface, double gravity,
                                                const Probe& probe) {
    const double strength = wallStrength(probe, gravity);
    const double height = std::max(surface.height, 0.0);
    const double distance = height + probe.radius;
    const double inverse = 1.0 / distance;
    const double inverseRest = 0.5 / probe.radius;
    const double q = (probe.radius - height) * inverse * inverseRest;
    const double toRest = q * (inverse + inverseRest);
    contact.pressure = strength * toRest * toRest;
    contact.energy =
        strength * q * q * q * (1.0 / 3.0 + distance * inverseRest) + contact.pressure * (height - surface.height);
    if (surface.height >= 0.0) contact.stiffness = 4.0 * strength * toRest * inverse * inverse * inverse;
    if (contact.energy > 0.0)
        contact.damping =
            surface.wall->rebound.dampingRatio * contact.pressure * std::sqrt(2.0 * probe.mass / contact.energy);
    if (surface.wall->rebound.isDampedByMaterial)
        contact.damping += probe.damping * probe.dampingReach * toRest * distance * distance;
}

[[gnu::always_inline]] inline Contact contactWith(const Surface& surface, const Obstacles& obstacles,
                                                  const Probe& probe) {
    Contact contact;
    contact.isPaper = obstacles.wall == WallLaw::paper;
    if (contact.isPaper) {
        contact.repulsor = repulsorContact(surface, obstacles.law, probe);
        contact.friction = probe.friction;
        return contact;
    }
    contact.friction = surface.wall->friction.value_or(probe.friction);
    if (surface.height < probe.radius) setRepulsion(contact, surface, obstacles.gravity, probe);
    addAdhesion(contact, surface, probe);
    contact.pressure *= surface.slope;
    contact.adhesion *= surface.slope;
    return contact;
}

/// Force of a contact along the surface's normal on a particle with this normal speed (m/s), in newtons. On a particle
/// closer to the repulsor than the core distance acts the force at the core distance, so that it can only be pushed out
/// on the side of the surface.
inline double normalForce(const Contact& contact, double normalSpeed) {
    if (contact.isPaper) return repulsorForceOf(contact.repulsor, normalSpeed);
    return contact.pressure - contact.damping * normalSpeed - contact.adhesion;
}

/// Repulsion of a contact, in newtons: what friction is proportional to.
inline double pressureForce(const Contact& contact) {
    return contact.isPaper ? repulsorForceOf(contact.repulsor, 0.0) : contact.pressure;
}

/// Energy of the conservative part of a contact's force, in joules.
inline double contactEnergy(const Contact& contact) {
    if (!contact.isPaper) return contact.energy + contact.adhesionEnergy;
    const RepulsorContact& repulsor = contact.repulsor;
    return pairEnergy(repulsor.distance, repulsor.constants) + repulsorForceOf(repulsor, 0.0) * repulsor.beyondCore;
}

/// Velocity of a particle relative to the material of a surface, m/s.
inline Vec3 relativeVelocity(const Probe& probe, const Surface& surface) {
    return surface.motion == nullptr ? probe.velocity : Vec3(probe.velocity - surface.motion->velocity);
}

/// Energy of a particle at a surface of an obstacle, in joules; 0 where the surface does not act on it.
inline double surfaceEnergy(const Surface& surface, const Obstacles& obstacles, const Probe& probe) {
    const double reach = contactReach(*surface.wall, probe.radius);
    return surface.height >= reach ? 0.0 : contactEnergy(contactWith(surface, obstacles, probe));
}

/// The tangential part of a velocity (m/s) at a surface with this normal.
inline Vec3 slipVelocity(const Vec3& velocity, const Vec3& normal) {
    return velocity - dot(velocity, normal) * normal;
}

/// Adds the force of a contact on the particle, in newtons, friction included. Forced inline, because a function call
/// would take half of the time.
[[gnu::always_inline]] inline void addForce(const Surface& surface, const Contact& contact, const Probe& probe,
                                            Vec3& force) {
    const Vec3 velocity = relativeVelocity(probe, surface);
    force += normalForce(contact, dot(velocity, surface.normal)) * surface.normal;
    if (contact.friction == 0.0) return;
    const Vec3 slip = slipVelocity(velocity, surface.normal);
    force -= slipDamping(contact.friction, pressureForce(contact), squaredLength(slip)) * slip;
}

/// Records the load of a contact, if that is wanted of its obstacle.
/// @param impulse  that the particle gets, N s
inline void recordLoad(const Surface& surface, const Vec3& impulse, const Obstacles& obstacles, const Probe& probe,
                       ContactLoads& loads) {
    if (!isRecorded(obstacles, surface.obstacle)) return;
    loads.push_back({surface.obstacle, impulse, probe.position, materialVelocity(surface), probe.time});
}

/// Damping of a contact along the surface's normal, in kg/s.
inline double dampingAlong(const Contact& contact) {
    if (!contact.isPaper) return contact.damping;
    const double distanceSq = contact.repulsor.distance * contact.repulsor.distance;
    return pairDampingOverSq(distanceSq, contact.repulsor.constants) * distanceSq;
}

/// Stiffness of a contact along the surface's normal, in N/m; 0 inside the core distance, where the force is constant.
inline double stiffnessAlong(const Contact& contact) {
    if (!contact.isPaper) return contact.stiffness;
    if (contact.repulsor.beyondCore > 0.0) return 0.0;
    return std::max(0.0, pairStiffness(contact.repulsor.distance, contact.repulsor.constants));
}

}  // namespace engine
