// Energy, momentum and hash of a state.
#include "engine/run/diagnostics.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/core/hash.h"
#include "engine/ranks/exact_sums.h"
#include "engine/state/probe.h"
#include "engine/stepping/step_cache.h"

namespace engine {
Energy energy(ForceEvaluator& evaluator, const Particles& particles, double time, const Ranks& ranks) {
    const ForceField& field = evaluator.forceField();
    const double pairs = evaluator.pairEnergyGrid(particles);
    const auto [kinetic, contacts, gravity, fields] = exactSums<4>(ranks, particles.count(), [&](std::size_t p) {
        const Vec3& x = particles.position[p];
        const Vec3& v = particles.velocity[p];
        return std::array{0.5 * particles.mass[p] * squaredLength(v),
                          sumContacts(field.obstacles, probeOf(field.materials, particles, p, v, time)).energy,
                          -particles.mass[p] * dot(field.gravity, x),
                          particles.mass[p] * fieldPotential(field.fields, x)};
    });
    return {.kinetic = kinetic, .pairs = pairs, .contacts = contacts, .gravity = gravity, .fields = fields};
}

Energy energy(Simulation& simulation) {
    return energy(simulation.cache->evaluator, simulation.particles, simulation.time, *simulation.ranks);
}

Vec3 linearMomentum(const Particles& particles) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = 0; p < particles.count(); ++p) sum += particles.mass[p] * particles.velocity[p];
    return sum;
}

Vec3 angularMomentum(const Particles& particles) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = 0; p < particles.count(); ++p)
        sum += particles.mass[p] * particles.position[p].cross(particles.velocity[p]);
    return sum;
}

double largestSpeed(const Particles& particles) {
    double largestSq = 0.0;
    for (const Vec3& velocity : particles.velocity) largestSq = std::max(largestSq, squaredLength(velocity));
    return std::sqrt(largestSq);
}

std::string stateHash(const Particles& particles) {
    std::uint64_t hash = fnv1a({});
    const auto add = [&](const Vec3& vector) {
        for (int axis = 0; axis < 3; ++axis) hash = fnv1a(std::bit_cast<std::uint64_t>(vector[axis]), hash);
    };
    for (std::size_t p = 0; p < particles.count(); ++p) {
        hash = fnv1a(std::uint64_t{particles.id[p]}, hash);
        add(particles.position[p]);
        add(particles.velocity[p]);
    }
    for (const double enthalpy : particles.enthalpy) hash = fnv1a(std::bit_cast<std::uint64_t>(enthalpy), hash);
    return hexadecimal(hash);
}

}  // namespace engine
