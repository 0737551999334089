// Ghosts from geometry, and costs fitted to measurements.
#include "studies/scaling/rank_model.h"

#include <cmath>

namespace studies {
namespace {

/// Reach of a neighbor list in cutoffs. Chosen: skins of moving liquids are a tenth of the cutoff.
constexpr double kReach = 1.1;

/// Cost of a particle on one of many ranks, and of a ghost, over that of a particle in one process: copies and
/// messages, and for ghosts the search of neighbors. Measured: docs/beyond-one-machine.md.
constexpr double kCostOfOwn = 1.25;
constexpr double kCostOfGhost = 0.35;

/// Operations in a step for which all ranks wait for each other, and messages of a rank to its neighbors.
constexpr double kCollectives = 8.0;
constexpr double kMessages = 26.0;

}  // namespace

StepOnRanks stepOnRanks(const StepOnOneRank& alone, int ranks, double latency) {
    StepOnRanks step{alone.particles / ranks, 0.0, alone.seconds, 1.0};
    if (ranks == 1 || alone.particles == 0.0) return step;
    // Lengths are in cutoffs: of the cubes that a particle and a rank have, and of the layers of ghosts on their sides.
    // A rank in the middle has neighbors on both sides along an axis, one at an end on one side.
    constexpr double kSphere = 4.18879;  // volume of a sphere of radius 1
    const double volume = kSphere / (alone.neighbors + 1.0);
    const double edge = std::cbrt(step.particles * volume);
    const double sides = 2.0 * (1.0 - 1.0 / std::cbrt(ranks));
    const double outer = edge + sides * kReach;
    step.ghosts = (outer * outer * outer - edge * edge * edge) / volume;
    const double ofParticle = alone.seconds / alone.particles;
    step.seconds = ofParticle * (kCostOfOwn * step.particles + kCostOfGhost * step.ghosts) +
                   latency * (kCollectives * std::ceil(std::log2(ranks)) + kMessages);
    step.efficiency = alone.seconds / (ranks * step.seconds);
    return step;
}

}  // namespace studies
