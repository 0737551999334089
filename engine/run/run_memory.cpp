// Counts the bytes of all arrays of a run, which state/simulation.h, stepping/step_cache.h and forces/pair_matrix.h
// declare.
#include "engine/run/run_memory.h"

#include "engine/error_control/auto_stepper.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// Bytes of the particles, and of the arrays that every stepper keeps with an entry for each particle.
std::size_t bytesOfState(const Simulation& simulation) {
    constexpr std::size_t kState = 2 * sizeof(Vec3) + 3 * sizeof(double) + 2 * sizeof(std::uint32_t);
    constexpr std::size_t kForces = 3 * sizeof(Vec3);  // forces, predicted velocities and positions at the step's start
    constexpr std::size_t kDrift = sizeof(double) + sizeof(std::uint8_t) + sizeof(std::uint32_t);
    const std::size_t initial = simulation.setup.initial.count() * kState;
    return initial + simulation.particles.count() * (kState + kForces + kDrift + sizeof(PackedParticle));
}

/// Bytes of the saved states: four that checked steps can restore, and one that the automatic stepper keeps.
std::size_t bytesBefore(const Simulation& simulation) {
    constexpr std::size_t kStates = 5;
    return kStates * 3 * sizeof(Vec3) * simulation.particles.count();
}

/// Bytes of the implicit steppers' matrix and of the vectors of its solver.
std::size_t bytesOfMatrix(const Simulation& simulation) {
    const bool hasFriction = termsFor(simulation.cache->evaluator.forceField(), simulation.particles).pair.friction;
    const bool hasObstacles = !simulation.setup.obstacles.shapes.empty();
    const NeighborRows& rows = simulation.cache->evaluator.list().rows;
    const std::size_t entries = (hasFriction ? 2 : 1) * sizeof(double) * roomOf(rows);
    const std::size_t own = hasObstacles ? sizeof(Matrix3) : 0;
    constexpr std::size_t kVectors = 5 * sizeof(Vec3);
    return bytesOf(rows) + entries +
           simulation.particles.count() * (sizeof(double) + own + sizeof(PackedParticle) + kVectors);
}

}  // namespace

std::size_t peakBytesOfMaterials(const Simulation& simulation) {
    constexpr std::size_t kLists = 3;  // in the setup, the force field and the traversal of pairs
    const std::size_t count = simulation.setup.materials.size();
    const std::size_t run = (kLists * count + tabulatedCount(count)) * sizeof(Material);
    return simulation.setup.stepper == StepperKind::automatic ? (1 + kTrialRuns) * run : run;
}

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
    return (1 + kTrialRuns) * run + 2 * (before + bytesOfMatrix(simulation));
}

}  // namespace engine
