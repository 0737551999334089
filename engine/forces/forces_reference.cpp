// Equation 1 as the paper evaluates it: every pair of particles, one after another, in double precision. All faster
// code is tested against these functions, so they stay simple, serial and slow.
#include "engine/forces/forces.h"

namespace engine {
namespace {

struct Pair {
    Vec3 separation;  ///< P = x_p - x_i, or coincidentSeparation() where P is 0
    PairConstants<double> constants;
};

Pair pairOf(const ForceField& field, const Particles& ofP, std::size_t p, const Particles& ofI, std::size_t i) {
    const double restLength = ofP.radius[p] + ofI.radius[i];
    const Material material = mixed(field.materials[ofP.material[p]], field.materials[ofI.material[i]]);
    Pair pair{ofP.position[p] - ofI.position[i], pairConstants<double>(material, restLength)};
    if (squaredLength(pair.separation) == 0.0) pair.separation = coincidentSeparation(ofP.id[p], ofI.id[i], restLength);
    return pair;
}

/// Friction force on particle p of a pair at this relative velocity (m/s), in newtons.
Vec3 frictionOf(const Pair& pair, const Vec3& velocity) {
    const double distance = pair.separation.norm();
    const Vec3 normal = pair.separation / distance;
    const Vec3 slip = velocity - velocity.dot(normal) * normal;
    const double push = distance * pairCoefficient<kConservative>(distance * distance, 0.0, pair.constants);
    return -slipDamping(pair.constants.friction, push, slip.squaredNorm()) * slip;
}

}  // namespace

void pairForcesReference(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                         std::vector<Vec3>& forces) {
    forces.assign(particles.count(), Vec3::Zero());
    for (std::size_t p = 0; p < particles.count(); ++p) {
        for (std::size_t i = 0; i < particles.count(); ++i) {
            if (i == p) continue;
            const Pair pair = pairOf(field, particles, p, particles, i);
            const double distanceSq = squaredLength(pair.separation);
            const double approach = dot(velocities[p] - velocities[i], pair.separation);
            forces[p] += pairCoefficient<kAlongLine>(distanceSq, approach, pair.constants) * pair.separation;
            if (pair.constants.friction > 0.0) forces[p] += frictionOf(pair, velocities[p] - velocities[i]);
        }
    }
}

double pairEnergyReference(const ForceField& field, const Particles& particles, std::size_t p, std::size_t i) {
    return pairEnergyReference(field, particles, p, particles, i);
}

double pairEnergyReference(const ForceField& field, const Particles& ofP, std::size_t p, const Particles& ofI,
                           std::size_t i) {
    const Pair pair = pairOf(field, ofP, p, ofI, i);
    const double energy = pairEnergy(std::sqrt(squaredLength(pair.separation)), pair.constants);
    // The energy of a coincident pair is as far above U(0) as the energy at its stand-in separation is below it;
    // energyOf() in pair_sums.cpp gives the reason.
    const bool isCoincident = ofP.position[p] == ofI.position[i];
    return isCoincident ? 2.0 * pairEnergy(0.0, pair.constants) - energy : energy;
}

double pairEnergyReference(const ForceField& field, const Particles& particles) {
    double energy = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p)
        for (std::size_t i = p + 1; i < particles.count(); ++i) energy += pairEnergyReference(field, particles, p, i);
    return energy;
}

}  // namespace engine
