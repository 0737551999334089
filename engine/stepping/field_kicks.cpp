// Kicks of fields. The work that they do is the change of kinetic energy, which is known exactly: no potential is
// needed for the audit, and drag, boxes and switching count like everything else.
#include "engine/stepping/field_kicks.h"

#include <algorithm>
#include <cmath>
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

/// Applies kicks one after another; returns the energy (J) that the particles of all ranks have gained, or 0 if the
/// steps are not audited.
double apply(Simulation& simulation, const std::vector<FieldKick>& kicks) {
    Particles& particles = simulation.particles;
    const auto gain = [&](std::size_t p) {
        const Vec3 before = particles.velocity[p];
        Vec3 after = before;
        for (const FieldKick& kick : kicks) after = kick.velocityAfter(particles.position[p], after);
        particles.velocity[p] = after;
        return 0.5 * particles.mass[p] * dot(after - before, after + before);
    };
    if (simulation.cache->energy) return exactSum(*simulation.ranks, particles.count(), gain);
    inParallel(particles.count(), kParticleGrain, [&](std::size_t p) { gain(p); });
    return 0.0;
}

}  // namespace

void kickBefore(Simulation& simulation, double h) {
    const double from = simulation.time;
    const std::vector<FieldKick> kicks = kicksBetween(simulation.setup.fields, from, from + 0.5 * h);
    if (!kicks.empty()) simulation.cache->work += apply(simulation, kicks);
}

void kickAfter(Simulation& simulation, double h) {
    StepCache& cache = *simulation.cache;
    if (cache.energy && std::isnan(*cache.energy)) return;  // the step is rejected
    const double from = simulation.time;
    std::vector<FieldKick> kicks = kicksBetween(simulation.setup.fields, from + 0.5 * h, from + h);
    if (kicks.empty()) return;
    std::reverse(kicks.begin(), kicks.end());  // in the mirrored order, so that the step is symmetric in time
    const double gain = apply(simulation, kicks);
    cache.work += gain;
    if (!cache.energy || !isVerlet(simulation.stepper)) return;
    *cache.energy += gain;
    cache.kinetic += gain;
    cache.workAtEnergy += gain;
}

}  // namespace engine
