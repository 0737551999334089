// Books heat, lets it flow, and changes stages.
#include "engine/heat/heat_moment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/heat/heat_exchange.h"
#include "engine/ranks/exact_sums.h"
#include "engine/state/probe.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// Heat of damping is given to the particles as soon as it warms all of them by this much in the mean, K. Chosen: no
/// scene shows it, and most exchanges need not find out who is damped.
constexpr double kLeastWarming = 1e-4;

/// Energy that has become heat since the last exchange, J; 0 where steps are not audited, so that none is known.
double lostEnergy(const Simulation& simulation) {
    const StepCache& cache = *simulation.cache;
    if (!cache.energy) return 0.0;
    return cache.energyAtHeat - (*cache.energy - cache.workAtEnergy);
}

/// Books the heat that motion has lost, and gives it to the particles once it is worth it.
void bookLostEnergy(Simulation& simulation, const PairTraversal& pairs) {
    HeatState& state = simulation.heat;
    const double lost = lostEnergy(simulation);
    state.damped += lost;
    state.pending += lost;
    Particles& particles = simulation.particles;
    const double capacity = exactSum(*simulation.ranks, particles.count(), [&](std::size_t p) {
        return particles.mass[p] * simulation.setup.materials[particles.material[p]].thermal.capacity;
    });
    if (!(state.pending > kLeastWarming * capacity)) return;
    const std::vector<double> dissipation = dissipationOf(pairs, particles);
    const std::array<double, 2> sums = exactSums<2>(*simulation.ranks, particles.count(), [&](std::size_t p) {
        return std::array{dissipation[p], particles.mass[p]};
    });
    // Where nothing is damped at this moment, all have a share.
    const bool isDamped = sums[0] > 0.0;
    const double heat = std::exchange(state.pending, 0.0);
    inParallel(particles.count(), kParticleGrain, [&](std::size_t p) {
        particles.enthalpy[p] += heat * (isDamped ? dissipation[p] / sums[0] : particles.mass[p] / sums[1]);
    });
}

/// The materials that the particles have at their enthalpies.
std::vector<std::uint32_t> stagesOfAll(const Simulation& simulation) {
    const Particles& particles = simulation.particles;
    std::vector<std::uint32_t> stages(particles.count());
    inParallel(particles.count(), kParticleGrain, [&](std::size_t p) {
        stages[p] = stageAt(*simulation.setup.heat, simulation.setup.materials, particles.material[p],
                            particles.enthalpy[p] / particles.mass[p]);
    });
    return stages;
}

/// Energy of a particle at the obstacles if it were of this material, J.
double contactEnergyAs(const Simulation& simulation, std::size_t p, std::uint32_t material) {
    if (simulation.setup.obstacles.shapes.empty()) return 0.0;
    const Particles& particles = simulation.particles;
    const Probe probe = probeOf(simulation.setup.materials, particles, p, material, Vec3::Zero(), simulation.time);
    return sumContacts(simulation.setup.obstacles, probe).energy;
}

/// What the new stages of all particles, in combined order, change of the energy of pairs and contacts.
class StageChange {
 public:
    StageChange(const Simulation& simulation, const PairTraversal& pairs, const std::vector<std::uint32_t>& before,
                const std::vector<std::uint32_t>& after)
        : simulation_(simulation), pairs_(pairs), before_(before), after_(after) {}

    /// The share of a particle that gets another stage, J: half of a pair of which both do.
    double of(std::size_t laneSlot, std::uint32_t p) const {
        const std::uint32_t sorted = pairs_.sortedIndexAt(laneSlot);
        const std::uint32_t own = pairs_.list.order[sorted];
        double change = contactEnergyAs(simulation_, p, after_[own]) - contactEnergyAs(simulation_, p, before_[own]);
        pairs_.forEachNeighbor(laneSlot, [&](std::uint32_t neighbor, const Vec3&, double distanceSq) {
            const std::uint32_t other = pairs_.list.order[neighbor];
            const double distance = std::sqrt(distanceSq);
            const double rest = pairs_.packed[sorted].radius + pairs_.packed[neighbor].radius;
            const double ofPair = energyOf(after_[own], after_[other], rest, distance) -
                                  energyOf(before_[own], before_[other], rest, distance);
            change += (after_[other] == before_[other] ? 1.0 : 0.5) * ofPair;
        });
        return change;
    }

 private:
    double energyOf(std::uint32_t p, std::uint32_t i, double restLength, double distance) const {
        const PairConstants<double> constants = pairs_.table.constantsOf(pairs_.materials, p, i);
        return pairEnergy(distance, pairs_.terms.oneRadius ? constants : atRestLength<true>(constants, restLength));
    }

    const Simulation& simulation_;
    const PairTraversal& pairs_;
    const std::vector<std::uint32_t>& before_;
    const std::vector<std::uint32_t>& after_;
};

/// Gives the particles the materials of their stages. Returns whether any has changed, on any rank.
bool changeStages(Simulation& simulation, const PairTraversal& pairs) {
    Particles& particles = simulation.particles;
    const std::vector<std::uint32_t> stages = stagesOfAll(simulation);
    if (holdsOnAll(*simulation.ranks, stages == particles.material)) return false;
    ForceEvaluator& evaluator = simulation.cache->evaluator;
    std::vector<std::uint32_t> before;
    std::vector<std::uint32_t> after;
    evaluator.shareMaterials(particles.material, before);
    evaluator.shareMaterials(stages, after);
    const StageChange change(simulation, pairs, before, after);
    std::vector<double> changes(particles.count(), 0.0);
    pairs.forEachParticle([&](std::size_t laneSlot) {
        const std::uint32_t p = pairs.order()[pairs.sortedIndexAt(laneSlot)];
        if (p == kGhost || stages[p] == particles.material[p]) return;
        changes[p] = change.of(laneSlot, p);
        particles.enthalpy[p] -= changes[p];
    });
    simulation.heat.ofMelting +=
        exactSum(*simulation.ranks, particles.count(), [&](std::size_t p) { return changes[p]; });
    particles.material = stages;
    evaluator.renewMaterials(particles);
    simulation.cache->forcesCurrent = false;
    simulation.cache->energy.reset();
    // The accelerations of the steps before say nothing about the error of those to come.
    simulation.cache->meanAccelerations.clear();
    return true;
}

}  // namespace

double nextHeatMoment(const Simulation& simulation) {
    if (!simulation.setup.heat) return std::numeric_limits<double>::infinity();
    return static_cast<double>(simulation.heat.exchangeCount + 1) * simulation.setup.heat->interval;
}

bool isHeatDueAt(const Simulation& simulation, double time) {
    return nextHeatMoment(simulation) <= time + kSameMoment;
}

bool exchangeHeatDue(Simulation& simulation) {
    const HeatSetup& heat = *simulation.setup.heat;
    // The paper's stepper may pass several moments in a step.
    double seconds = 0.0;
    for (; isHeatDueAt(simulation, simulation.time); ++simulation.heat.exchangeCount) seconds += heat.interval;
    Particles& particles = simulation.particles;
    ForceEvaluator& evaluator = simulation.cache->evaluator;
    if (countOfAll(simulation) == 0) return false;
    const PairTraversal& pairs = evaluator.preparePairs(particles);
    bookLostEnergy(simulation, pairs);
    const ShareNumbers share = [&](const std::vector<double>& own, std::vector<double>& combined) {
        evaluator.shareNumbers(own, combined);
    };
    HeatScratch scratch;
    HeatNetwork network;
    const Ranks& ranks = *simulation.ranks;
    const std::vector<Material>& materials = simulation.setup.materials;
    scratch.temperature.resize(particles.count());
    inParallel(particles.count(), kParticleGrain,
               [&](std::size_t p) { scratch.temperature[p] = temperatureOf(materials, particles, p); });
    share(scratch.temperature, scratch.combined);
    findFlows(pairs, particles, simulation.setup.obstacles, heat, scratch.combined, simulation.time, network);
    if (!isExplicit(network, materials, ranks, seconds, particles)) findLinks(pairs, particles, network);
    simulation.heat.received += exchangeHeat(network, materials, ranks, share, seconds, particles, scratch);
    return !heat.melts.empty() && changeStages(simulation, pairs);
}

}  // namespace engine
