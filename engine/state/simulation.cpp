// Statistics of steps, and counts of particles and emissions.
#include "engine/state/simulation.h"

#include <algorithm>

namespace engine {

void record(StepStatistics& steps, double h, StepLimit limit, StepperKind stepper) {
    steps.shortest = steps.count == 0 ? h : std::min(steps.shortest, h);
    steps.longest = std::max(steps.longest, h);
    ++steps.count;
    ++steps.limitedBy[static_cast<std::size_t>(limit)];
    ++steps.takenBy[static_cast<std::size_t>(stepper)];
}

StepStatistics& StepStatistics::operator+=(const StepStatistics& other) {
    shortest = count == 0 ? other.shortest : std::min(shortest, other.shortest);
    longest = std::max(longest, other.longest);
    count += other.count;
    forceEvaluations += other.forceEvaluations;
    matrices += other.matrices;
    products += other.products;
    rejected += other.rejected;
    held += other.held;
    for (std::size_t limit = 0; limit < kStepLimits; ++limit) limitedBy[limit] += other.limitedBy[limit];
    for (std::size_t stepper = 0; stepper < kStepperKinds; ++stepper) takenBy[stepper] += other.takenBy[stepper];
    return *this;
}

std::uint64_t countOfAll(const Simulation& simulation) {
    return sumOfAll(*simulation.ranks, simulation.particles.count());
}

std::uint64_t largestCount(const Simulation& simulation) {
    return std::max(simulation.largestCountBeforeRemoval, countOfAll(simulation));
}

std::uint64_t birthCount(const Simulation& simulation) {
    std::uint64_t sum = 0;
    for (const EmitterState& state : simulation.emitters) sum += state.births;
    return sum;
}

std::uint64_t refusalCount(const Simulation& simulation) {
    std::uint64_t asked = 0;
    for (const Emitter& emitter : simulation.setup.emitters) asked += askedCount(emitter, simulation.time);
    return asked - birthCount(simulation);
}

}  // namespace engine
