// Gives random impulses to pairs of neighbors.
#include "engine/heat/agitation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/random.h"
#include "engine/force_law/lattice.h"
#include "engine/ranks/exact_sums.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// Distinguishes the random numbers of agitation from others of the same seed.
constexpr std::uint64_t kStream = 0x61676974617465ULL;

/// How long an interval lasts, as a share of the time in which damping takes all but 1/e of the energy of random
/// motion. Chosen: the energy then varies by a fifth above and below its mean.
constexpr double kIntervalShare = 0.5;

/// The impulse that two particles get along their separation, as a multiple of it, in kg/s. The random number has the
/// variance 1 and is bounded, so that no particle is thrown out. The same for either order of the two.
double impulseOverSeparation(std::uint64_t key, std::uint32_t p, std::uint32_t i, double variance) {
    const double uniform = symmetricUnit(randomBits(key, std::min(p, i), std::max(p, i)));
    return std::sqrt(3.0 * variance) * uniform;
}

/// Square roots of the energies E of all materials, whose product is that of a pair.
std::vector<double> rootsOfEnergies(const std::vector<Material>& materials) {
    std::vector<double> roots;
    for (const Material& material : materials) roots.push_back(std::sqrt(agitationEnergy(material)));
    return roots;
}

/// The impulses on a particle from all neighbors, N s.
class Impulses {
 public:
    Impulses(const PairTraversal& pairs, std::uint64_t key, double seconds)
        : pairs_(pairs), key_(key), seconds_(seconds), roots_(rootsOfEnergies(pairs.materials)) {
        for (const Material& material : pairs.materials) reach_ = std::max(reach_, material.dampingReach);
        reach_ *= 2.0 * pairs.terms.largestRadius;
    }

    Vec3 on(std::size_t laneSlot) const {
        const PackedParticle& own = pairs_.packed[pairs_.sortedIndexAt(laneSlot)];
        Vec3 sum = Vec3::Zero();
        if (roots_[own.material] == 0.0) return sum;
        PairConstants<double> computed;
        pairs_.forEachWithin(reach_, laneSlot, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
            const PackedParticle& neighbor = pairs_.packed[other];
            const double energy = roots_[own.material] * roots_[neighbor.material];
            if (energy == 0.0) return;
            const double damping = pairDampingOverSq(distanceSq, pairs_.constants(own, neighbor, computed));
            if (damping == 0.0) return;
            const double variance = 2.0 * damping * energy * seconds_;
            sum += impulseOverSeparation(key_, own.id, neighbor.id, variance) * separation;
        });
        return sum;
    }

 private:
    const PairTraversal& pairs_;
    std::uint64_t key_;
    double seconds_;
    std::vector<double> roots_;
    double reach_ = 0.0;  ///< longest reach of damping, m
};

}  // namespace

double agitationEnergy(const Material& material) {
    return material.agitation * material.cohesion * 4.0 * material.radius * material.radius;
}

double agitationInterval(const Material& material) {
    if (!(agitationEnergy(material) > 0.0)) return std::numeric_limits<double>::infinity();
    const double spacing = 2.0 * material.radius;
    const double reachSq = spacing * spacing * material.dampingReach * material.dampingReach;
    const double shares = sumOverShells(
        spacing, reachSq, [&](double count, double distanceSq) { return count * (1.0 - distanceSq / reachSq); });
    // Of a particle's velocity, damping by all neighbors takes a third of b_d s_d / m along each axis.
    const double rate = 2.0 * material.damping * shares / (3.0 * material.mass);
    return rate > 0.0 ? kIntervalShare / rate : std::numeric_limits<double>::infinity();
}

double nextAgitation(const Simulation& simulation) {
    if (!(simulation.setup.agitationInterval > 0.0)) return std::numeric_limits<double>::infinity();
    return static_cast<double>(simulation.agitation.count + 1) * simulation.setup.agitationInterval;
}

bool isAgitationDueAt(const Simulation& simulation, double time) {
    return nextAgitation(simulation) <= time + kSameMoment;
}

void agitateDue(Simulation& simulation) {
    AgitationState& state = simulation.agitation;
    // The paper's stepper may pass several moments in a step.
    double seconds = 0.0;
    for (; isAgitationDueAt(simulation, simulation.time); ++state.count) seconds += simulation.setup.agitationInterval;
    if (countOfAll(simulation) == 0) return;
    Particles& particles = simulation.particles;
    StepCache& cache = *simulation.cache;
    const PairTraversal& pairs = cache.evaluator.preparePairs(particles);
    const Impulses impulses(pairs, randomBits(simulation.setup.seed, kStream, state.count), seconds);
    std::vector<double> gains(particles.count(), 0.0);
    pairs.forEachParticle([&](std::size_t laneSlot) {
        const std::uint32_t p = pairs.order()[pairs.sortedIndexAt(laneSlot)];
        if (p == kGhost) return;
        const Vec3 before = particles.velocity[p];
        const Vec3 impulse = impulses.on(laneSlot);
        particles.velocity[p] = before + impulse / particles.mass[p];
        gains[p] = 0.5 * dot(impulse, before + particles.velocity[p]);
    });
    const double gain = exactSum(*simulation.ranks, particles.count(), [&](std::size_t p) { return gains[p]; });
    state.work += gain;
    cache.forcesCurrent = false;
    // The accelerations of the steps before say nothing about the error of those to come.
    cache.meanAccelerations.clear();
    if (!cache.energy) return;
    *cache.energy += gain;
    cache.kinetic += gain;
    cache.work += gain;
    cache.workAtEnergy += gain;
}

}  // namespace engine
