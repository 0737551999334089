// Energies as sums over the particles in chunks of fixed size, so that a verdict does not depend on threads.
#include "engine/stepping/step_audit.h"

#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/stepping/drift.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// Chosen: far below any motion that one sees, in radii per second.
constexpr double kSlow = 0.1;

/// A thousand roundings of the sums that the energy is the difference of.
constexpr double kRounding = 1e-13;

double contactEnergyOf(const Simulation& simulation, std::size_t p) {
    if (simulation.setup.obstacles.shapes.empty() || isClear(simulation, p)) return 0.0;
    const Particles& particles = simulation.particles;
    return contactEnergy(simulation.setup.obstacles, {particles.position[p], Vec3::Zero(), particles.radius[p], 1.0});
}

/// Of a newborn with all that are older, J.
double energyWithEarlier(const Simulation& simulation, std::size_t p, const LinkedCells& cells) {
    double energy = 0.0;
    cells.forEachNear(simulation.particles.position[p], [&](std::size_t i) {
        if (i < p) energy += pairEnergyReference(simulation.cache->evaluator.law(), simulation.particles, p, i);
    });
    return energy;
}

/// Alone, a particle may go as far as it likes, but where it may have passed an obstacle unseen.
bool mayGoFar(const Simulation& simulation) {
    if (simulation.particles.count() > 1) return false;
    return simulation.particles.count() == 0 || simulation.setup.obstacles.shapes.empty() ||
           simulation.cache->swept[0] != 0 || isClear(simulation, 0);
}

bool movedTooFar(const Simulation& simulation, const BeforeStep& kept) {
    const Particles& particles = simulation.particles;
    if (mayGoFar(simulation)) return false;
    const double far = largestOver(particles.count(), [&](std::size_t p) {
        const double waySq = squaredLength(particles.position[p] - kept.position[p]);
        return waySq <= particles.radius[p] * particles.radius[p] ? 0.0 : 1.0;  // what is no number is too far
    });
    return far > 0.0;
}

}  // namespace

double energyAllowance(const Simulation& simulation) {
    const Particles& particles = simulation.particles;
    const double slow = sumOver(particles.count(), [&](std::size_t p) {
        const double speed = kSlow * particles.radius[p];
        return 0.5 * particles.mass[p] * speed * speed;
    });
    return kEnergyAllowance * (simulation.cache->kinetic + slow) +
           kRounding * std::abs(simulation.cache->energy.value_or(0.0));
}

void noteEnergy(Simulation& simulation, const OwnEnergy& own, double pairEnergy) {
    simulation.cache->kinetic = own.kinetic;
    simulation.cache->energy = own.kinetic + own.potential + pairEnergy;
}

void noteEnergy(Simulation& simulation, double pairEnergy) {
    const OwnEnergy own = sumOver<OwnEnergy>(simulation.particles.count(), [&](std::size_t p) {
        return ownEnergy(simulation, p, contactEnergyOf(simulation, p));
    });
    noteEnergy(simulation, own, pairEnergy);
}

void markInvalid(Simulation& simulation) {
    simulation.cache->energy = std::numeric_limits<double>::quiet_NaN();
}

void addEnergyOfEmitted(Simulation& simulation, std::size_t first, const LinkedCells& cells) {
    if (!simulation.cache->energy) return;
    for (std::size_t p = first; p < simulation.particles.count(); ++p) {
        const OwnEnergy own = ownEnergy(simulation, p, contactEnergyOf(simulation, p));
        simulation.cache->kinetic += own.kinetic;
        *simulation.cache->energy += own.kinetic + own.potential + energyWithEarlier(simulation, p, cells);
    }
}

void keep(const Simulation& simulation, BeforeStep& kept) {
    kept.time = simulation.time;
    kept.emitters = simulation.emitters;
    copy(simulation.particles.position, kept.position);
    copy(simulation.particles.velocity, kept.velocity);
    kept.forcesCurrent = simulation.cache->forcesCurrent;
    if (kept.forcesCurrent) copy(simulation.cache->forces, kept.forces);
    kept.energy = simulation.cache->energy;
    kept.kinetic = simulation.cache->kinetic;
    kept.allowance = energyAllowance(simulation);
    kept.steps = simulation.steps;
}

void takeBack(Simulation& simulation, const BeforeStep& kept) {
    truncate(simulation.particles, kept.position.size());
    simulation.time = kept.time;
    simulation.emitters = kept.emitters;
    simulation.particles.position = kept.position;
    simulation.particles.velocity = kept.velocity;
    simulation.cache->clearance.clear();
    simulation.cache->evaluator.invalidateDisplacementBound();
    simulation.cache->cachedNeighbors
        .clear();  // they are from before, and a run that is gone on with does not know them
    simulation.cache->forcesCurrent = kept.forcesCurrent;
    if (kept.forcesCurrent) {
        simulation.cache->forces = kept.forces;
        simulation.cache->evaluator.renewList(simulation.particles);  // who has forces has their list; see prepareDrift
    }
    simulation.cache->energy = kept.energy;
    simulation.cache->kinetic = kept.kinetic;
    const StepStatistics spent = simulation.steps;
    simulation.steps = kept.steps;
    simulation.steps.forceEvaluations = spent.forceEvaluations;
    simulation.steps.products = spent.products;
    simulation.steps.rejected = spent.rejected;
}

std::optional<StepLimit> objection(const Simulation& simulation, const BeforeStep& kept) {
    if (movedTooFar(simulation, kept)) return StepLimit::displacement;
    if (kept.energy && !(*simulation.cache->energy <= *kept.energy + kept.allowance)) return StepLimit::audit;
    return std::nullopt;
}

}  // namespace engine
