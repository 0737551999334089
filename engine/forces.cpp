// The total force: pairs, gravity, obstacles.
#include "engine/forces.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <utility>

#include "engine/forces_grid.h"

namespace engine {

ForceEvaluator::ForceEvaluator(ForceLaw law, ForceMethod method)
    : law_(std::move(law)), method_(method), pairs_(law_) {}

void ForceEvaluator::evaluate(const Particles& particles, const std::vector<Vec3>& velocities,
                              std::vector<Vec3>& forces) {
    if (method_ == ForceMethod::reference)
        pairForcesReference(law_, particles, velocities, forces);
    else
        pairForcesGrid(particles, velocities, forces);

    const auto addExternal = [&](std::size_t p) {
        forces[p] += particles.mass[p] * law_.gravity;
        if (law_.scenery.colliders.empty()) return;
        const double dampingReach = law_.materials[particles.material[p]].dampingReach;
        forces[p] +=
            contactForce(law_.scenery, {particles.position[p], velocities[p], particles.radius[p], dampingReach});
    };
    constexpr std::size_t kGrain = 512;  // chosen: a chunk is some tens of microseconds
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, particles.count(), kGrain), [&](const auto& range) {
            for (std::size_t p = range.begin(); p < range.end(); ++p) addExternal(p);
        });
    });
}

void ForceEvaluator::pairForcesGrid(const Particles& particles, const std::vector<Vec3>& velocities,
                                    std::vector<Vec3>& forces) {
    forces.assign(particles.count(), Vec3::Zero());
    if (particles.count() < 2) return;
    pairs_.prepare(law_, particles, velocities);
    pairForces(pairs_, forces);
}

double ForceEvaluator::pairEnergyGrid(const Particles& particles) {
    if (particles.count() < 2) return 0.0;
    pairs_.prepare(law_, particles, particles.velocity);
    return pairEnergySum(pairs_);
}

}  // namespace engine
