// Checks the parts of a simulation's state one after another: particles, emitters, time steps.
#include "engine/run/state_validation.h"

#include <algorithm>
#include <cmath>

#include "engine/error_control/auto_stepper.h"
#include "engine/error_control/checked_steps.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

bool areFinite(const std::vector<Vec3>& vectors) {
    return std::ranges::all_of(vectors, [](const Vec3& vector) { return vector.allFinite(); });
}

bool haveEqualLengths(const Simulation& simulation) {
    const std::size_t count = simulation.particles.count();
    bool areEqual = !simulation.cache->forcesCurrent || simulation.cache->forces.size() == count;
    const bool hasHeat = simulation.setup.heat.has_value();
    forEachArray(simulation.particles, [&](const auto& array) {
        const bool isOfHeat = static_cast<const void*>(&array) == &simulation.particles.enthalpy;
        areEqual &= array.size() == (isOfHeat && !hasHeat ? 0 : count);
    });
    return areEqual;
}

/// Whether a particle may have become one of the other material: if both are stages of one that melts.
bool isSameSubstance(const Setup& setup, std::uint32_t material, std::uint32_t other) {
    if (material == other) return true;
    const Melt* const melt = setup.heat ? meltOf(*setup.heat, material) : nullptr;
    return melt != nullptr && isStage(*melt, other);
}

/// Whether a particle has the radius, mass and material that the setup gives it, at the start or by an emitter.
bool isOfSetup(const Simulation& simulation, std::size_t p) {
    const Particles& particles = simulation.particles;
    const Particles& initial = simulation.setup.initial;
    const std::size_t id = particles.id[p];
    if (id >= particles.nextId || (p > 0 && id <= particles.id[p - 1])) return false;
    if (id < initial.count())
        return particles.radius[p] == initial.radius[id] && particles.mass[p] == initial.mass[id] &&
               isSameSubstance(simulation.setup, particles.material[p], initial.material[id]);
    const std::vector<Material>& materials = simulation.setup.materials;
    const std::uint32_t material = particles.material[p];
    return material < materials.size() && particles.radius[p] == materials[material].radius &&
           particles.mass[p] == materials[material].mass;
}

bool areOfSetup(const Simulation& simulation) {
    const std::size_t everBorn = simulation.setup.initial.count() + birthCount(simulation);
    if (simulation.removedCount > 0 && !simulation.setup.world) return false;
    if (simulation.largestCountBeforeRemoval > everBorn ||
        (simulation.largestCountBeforeRemoval > 0) != (simulation.removedCount > 0))
        return false;
    if (simulation.particles.nextId != everBorn || simulation.particles.count() + simulation.removedCount != everBorn)
        return false;
    for (std::size_t p = 0; p < simulation.particles.count(); ++p)
        if (!isOfSetup(simulation, p)) return false;
    return true;
}

bool areOnSchedule(const Simulation& simulation) {
    for (std::size_t e = 0; e < simulation.emitters.size(); ++e)
        if (!isReachable(simulation.setup.emitters[e], simulation.emitters[e])) return false;
    return nextEmission(simulation) > simulation.time;
}

bool areStepsPossible(const Simulation& simulation) {
    const StepRestriction& restriction = simulation.restriction;
    const bool isKnown = simulation.setup.stepper == StepperKind::automatic
                             ? isReachable(simulation.automatic, simulation.stepper)
                             : simulation.stepper == simulation.setup.stepper;
    const StepCache& cache = *simulation.cache;
    const bool isLastKnown = areFinite(cache.meanAccelerations) && std::isfinite(cache.lastStep);
    // The comparisons are false for a NaN.
    return isKnown && isLastKnown && cache.lastStep >= 0.0 && restriction.seconds >= 0.5 * kShortestStep &&
           isLimit(restriction.reason);
}

}  // namespace

bool isInWorld(const std::vector<Vec3>& positions) {
    return std::ranges::all_of(positions, [](const Vec3& position) { return areBelow(position, kWorldLimit); });
}

const char* stateError(const Simulation& simulation) {
    if (!haveEqualLengths(simulation)) return "its arrays are of different lengths";
    if (!isInWorld(simulation.particles.position)) return "a particle is not in the world";
    if (!areFinite(simulation.particles.velocity)) return "a velocity is not finite";
    if (!std::ranges::all_of(simulation.particles.enthalpy, [](double heat) { return std::isfinite(heat); }))
        return "a heat is not finite";
    if (!(simulation.time >= 0.0) || !std::isfinite(simulation.time)) return "its time is not finite";
    if (!areOfSetup(simulation)) return "its particles are not the scene's";
    if (!areOnSchedule(simulation)) return "a birth is not on its schedule";
    if (!areStepsPossible(simulation)) return "the scene's stepper does not take its steps";
    return nullptr;
}

}  // namespace engine
