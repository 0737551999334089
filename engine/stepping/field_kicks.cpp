// Kicks of fields. The work that they do is the change of kinetic energy, which is known exactly: no potential is
// needed for the audit, and drag, boxes and switching count like everything else.
#include "engine/stepping/field_kicks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/ranks/exact_sums.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

std::vector<FieldKick> kicksBetween(const std::vector<Field>& fields, double from, double to) {
    std::vector<FieldKick> kicks;
    for (const Field& field : fields)
        if (const FieldKick kick(field, from, to); kick.exists()) kicks.push_back(kick);
    return kicks;
}

/// What kicks have done to the particles of all ranks.
struct KickSums {
    double gain = 0.0;          ///< of kinetic energy, J
    double differenceSq = 0.0;  ///< sum of the squared differences to the kicks before, (radii per second)^2
};

/// Applies kicks one after another, and records what they change in the step cache. The sums are left out if the steps
/// are not audited.
KickSums kickAll(Simulation& simulation, const std::vector<FieldKick>& kicks) {
    Particles& particles = simulation.particles;
    std::vector<Vec3>& changes = simulation.cache->fieldChanges;
    changes.resize(particles.count(), Vec3::Zero());
    const auto kickOne = [&](std::size_t p) {
        const Vec3 before = particles.velocity[p];
        Vec3 after = before;
        for (const FieldKick& kick : kicks) after = kick.velocityAfter(particles.position[p], after);
        particles.velocity[p] = after;
        const Vec3 change = after - before;
        const double differenceSq = squaredLength(change - changes[p]) / (particles.radius[p] * particles.radius[p]);
        changes[p] = change;
        return std::array{0.5 * particles.mass[p] * dot(change, after + before), differenceSq};
    };
    if (simulation.cache->energy) {
        const auto [gain, differenceSq] = exactSums<2>(*simulation.ranks, particles.count(), kickOne);
        return {gain, differenceSq};
    }
    inParallel(particles.count(), kParticleGrain, [&](std::size_t p) { kickOne(p); });
    return {};
}

}  // namespace

void kickBefore(Simulation& simulation, double h) {
    const double from = simulation.time;
    const std::vector<FieldKick> kicks = kicksBetween(simulation.setup.fields, from, from + 0.5 * h);
    std::vector<Vec3>& changes = simulation.cache->fieldChanges;
    changes.clear();
    if (!kicks.empty()) simulation.cache->work += kickAll(simulation, kicks).gain;
}

void kickAfter(Simulation& simulation, double h) {
    StepCache& cache = *simulation.cache;
    if (cache.energy && std::isnan(*cache.energy)) return;  // the step is rejected
    const double from = simulation.time;
    std::vector<FieldKick> kicks = kicksBetween(simulation.setup.fields, from + 0.5 * h, from + h);
    if (kicks.empty()) return;
    std::reverse(kicks.begin(), kicks.end());  // in the mirrored order, so that the step is symmetric in time
    const auto [gain, differenceSq] = kickAll(simulation, kicks);
    cache.work += gain;
    if (!cache.energy || !isVerlet(simulation.stepper)) return;
    *cache.energy += gain;
    cache.kinetic += gain;
    cache.workAtEnergy += gain;
    cache.predictionError +=
        std::sqrt(differenceSq / static_cast<double>(std::max<std::uint64_t>(1, countOfAll(simulation))));
}

}  // namespace engine
