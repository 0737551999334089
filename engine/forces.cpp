// Which terms a set of particles needs, and the total force: pairs, gravity, obstacles.
#include "engine/forces.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <utility>

namespace engine {
namespace {

bool sameLaw(const Material& a, const Material& b) {
    return a.repulsion == b.repulsion && a.damping == b.damping && a.repulsionReach == b.repulsionReach &&
           a.dampingReach == b.dampingReach && a.coreFraction == b.coreFraction;
}

}  // namespace

std::vector<Material> mixedPairs(const std::vector<Material>& materials) {
    std::vector<Material> pairs;
    for (const Material& a : materials)
        for (const Material& b : materials) pairs.push_back(sameLaw(a, b) ? a : mixed(a, b));
    return pairs;
}

ForceTerms termsFor(const ForceLaw& law, const Particles& particles) {
    ForceTerms terms;
    double reach = 0.0;
    for (const Material& material : law.materials) {
        terms.pair.attraction |= material.repulsionReach > 1.0;
        terms.pair.damping |= material.damping > 0.0;
        terms.uniform &= sameLaw(material, law.materials.front());
        // The mix's reaches lie between those of its parts.
        reach = std::max(reach, material.repulsionReach);
        if (material.damping > 0.0) reach = std::max(reach, material.dampingReach);
    }
    double largestRadius = 0.0;
    for (const double radius : particles.radius) {
        terms.uniform &= radius == particles.radius.front();
        largestRadius = std::max(largestRadius, radius);
    }
    terms.cutoff = reach * 2.0 * largestRadius;
    return terms;
}

ForceEvaluator::ForceEvaluator(ForceLaw law, ForceMethod method)
    : law_(std::move(law)), method_(method), pairs_(mixedPairs(law_.materials)) {}

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
        forces[p] += contactForce(law_.scenery, {particles.position[p], velocities[p], particles.radius[p], dampingReach});
    };
    constexpr std::size_t kGrain = 512;  // chosen: a chunk is some tens of microseconds
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, particles.count(), kGrain), [&](const auto& range) {
            for (std::size_t p = range.begin(); p < range.end(); ++p) addExternal(p);
        });
    });
}

}  // namespace engine
