// Counts member by member, as state/simulation.h, stepping/step_cache.h and forces/pair_matrix.h declare them.
#include "engine/run/run_memory.h"

#include "engine/error_control/auto_stepper.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// Bytes of the particles, and of what every stepper keeps for each of them.
std::size_t bytesOfState(const Simulation& simulation) {
    constexpr std::size_t kState = 2 * sizeof(Vec3) + 3 * sizeof(double) + 2 * sizeof(std::uint32_t);
    constexpr std::size_t kForces = 3 * sizeof(Vec3);  // with predicted velocities and positions at the start
    constexpr std::size_t kDrift = sizeof(double) + sizeof(std::uint8_t) + sizeof(std::uint32_t);
    const std::size_t initial = simulation.setup.initial.count() * kState;
    return initial + simulation.particles.count() * (kState + kForces + kDrift + sizeof(PackedParticle));
}

/// Bytes of the states that the audit can restore, and of the one that the automatic stepper saves.
std::size_t bytesBefore(const Simulation& simulation) {
    constexpr std::size_t kStates = 5;
    return kStates * 3 * sizeof(Vec3) * simulation.particles.count();
}

/// Bytes of the implicit steppers' matrix and of the vectors of its solver.
std::size_t bytesOfMatrix(const Simulation& simulation) {
    const bool hasFriction = termsFor(simulation.cache->evaluator.law(), simulation.particles).pair.friction;
    const bool hasObstacles = !simulation.setup.obstacles.shapes.empty();
    const NeighborRows& rows = simulation.cache->evaluator.list().rows;
    const std::size_t entries = (hasFriction ? 2 : 1) * sizeof(double) * roomOf(rows);
    const std::size_t own = hasObstacles ? sizeof(Matrix3) : 0;
    constexpr std::size_t kVectors = 5 * sizeof(Vec3);
    return bytesOf(rows) + entries +
           simulation.particles.count() * (sizeof(double) + own + sizeof(PackedParticle) + kVectors);
}

}  // namespace

std::size_t peakBytes(const Simulation& simulation) {
    const std::size_t run = bytesOfState(simulation) + bytesOf(simulation.cache->evaluator.list());
    const std::size_t before = bytesBefore(simulation);
    switch (simulation.setup.stepper) {
        case StepperKind::symplecticEuler:
            return run;
        case StepperKind::velocityVerlet:
        case StepperKind::leapfrog:
            return run + before;
        case StepperKind::implicitDamping:
        case StepperKind::linearlyImplicit:
            return run + before + bytesOfMatrix(simulation);
        case StepperKind::automatic:
            break;
    }
    return (1 + kRunsOfEstimate) * run + 2 * (before + bytesOfMatrix(simulation));
}

}  // namespace engine
