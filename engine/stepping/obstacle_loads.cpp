// Sums of loads over threads and ranks.
#include "engine/stepping/obstacle_loads.h"

#include "engine/ranks/exact_sums.h"

namespace engine {
namespace {

/// The numbers of an obstacle's load: impulse, angular impulse, work.
constexpr std::size_t kNumbers = 7;

std::array<double, kNumbers> numbersOf(const ContactLoad& load, const Vec3& pivot) {
    const Vec3 turn = (load.point - pivot).cross(load.impulse);
    return {load.impulse.x(),
            load.impulse.y(),
            load.impulse.z(),
            turn.x(),
            turn.y(),
            turn.z(),
            dot(load.impulse, load.velocity)};
}

}  // namespace

void addUpLoads(Simulation& simulation) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.areRecorded.empty()) return;
    StepCache& cache = *simulation.cache;
    cache.stepLoads.resize(obstacles.shapes.size());
    std::vector<std::array<ExactSum, kNumbers>> sums(obstacles.shapes.size());
    for (const ContactLoad& load : cache.loads.list()) {
        const Vec3 pivot = pivotAt(obstacles, load.obstacle, load.time);
        const std::array<double, kNumbers> numbers = numbersOf(load, pivot);
        for (std::size_t k = 0; k < kNumbers; ++k) sums[load.obstacle][k].add(numbers[k]);
    }
    cache.loads.list().clear();
    for (std::size_t k = 0; k < sums.size(); ++k) {
        if (!isRecorded(obstacles, k)) continue;
        const std::array<double, kNumbers> sum = roundedOverRanks(*simulation.ranks, sums[k]);
        ObstacleLoad& load = cache.stepLoads[k];
        load.impulse += Vec3(sum[0], sum[1], sum[2]);
        load.angularImpulse += Vec3(sum[3], sum[4], sum[5]);
        load.work += sum[6];
        cache.work += sum[6];
    }
}

void acceptLoads(Simulation& simulation) {
    std::vector<ObstacleLoad>& ofStep = simulation.cache->stepLoads;
    if (ofStep.empty()) return;
    for (std::size_t k = 0; k < ofStep.size(); ++k) {
        simulation.loads[k].impulse += ofStep[k].impulse;
        simulation.loads[k].angularImpulse += ofStep[k].angularImpulse;
        simulation.loads[k].work += ofStep[k].work;
    }
    ofStep.clear();
}

}  // namespace engine
