// The model of steps on several ranks, at its limits and against ghosts that are counted.
#include "studies/scaling/rank_model.h"

#include <cmath>

#include "tests/catch.h"

using namespace studies;

namespace {

constexpr StepOnOneRank kBlock{.particles = 1e6, .neighbors = 45.0, .seconds = 0.25};

/// Particles of a cubic lattice, with one of them per unit of volume, in a layer of a width around a cube, on as many
/// sides as a rank in the middle has.
double countedGhosts(int edge, double width) {
    const int margin = static_cast<int>(std::ceil(width)) + 1;
    double count = 0.0;
    const auto isWithin = [&](int k) { return k + 0.5 > -width && k + 0.5 < edge + width; };
    const auto isOwn = [&](int k) { return k >= 0 && k < edge; };
    for (int x = -margin; x < edge + margin; ++x)
        for (int y = -margin; y < edge + margin; ++y)
            for (int z = -margin; z < edge + margin; ++z)
                if (isWithin(x) && isWithin(y) && isWithin(z) && !(isOwn(x) && isOwn(y) && isOwn(z))) ++count;
    return count;
}

}  // namespace

TEST_CASE("one rank is a process", "[rank-model]") {
    const StepOnRanks one = stepOnRanks(kBlock, 1);
    CHECK(one.particles == kBlock.particles);
    CHECK(one.ghosts == 0.0);
    CHECK(one.seconds == kBlock.seconds);
    CHECK(one.efficiency == 1.0);
}

TEST_CASE("more ranks are faster and less efficient, until messages take longer than particles", "[rank-model]") {
    StepOnRanks before = stepOnRanks(kBlock, 2);
    CHECK(before.efficiency < 1.0);
    CHECK(before.efficiency > 0.75);
    for (int ranks = 4; ranks <= 1024; ranks *= 2) {
        const StepOnRanks step = stepOnRanks(kBlock, ranks);
        INFO(ranks);
        CHECK(step.seconds < before.seconds);
        CHECK(step.efficiency < before.efficiency);
        CHECK(step.ghosts / step.particles > before.ghosts / before.particles);
        before = step;
    }
    CHECK(stepOnRanks({1000.0, 45.0, 2e-4}, 1024).seconds > 2e-4 / 10.0);
    CHECK(stepOnRanks(kBlock, 64, 1e-3).efficiency < 0.2 * stepOnRanks(kBlock, 64).efficiency);
}

TEST_CASE("ghosts in the middle of many ranks are those of a lattice", "[rank-model]") {
    // With one particle per unit of volume, the cutoff is (3 (m + 1) / 4 pi)^(1/3).
    constexpr double kNeighbors = 1000.0;  // so many that the lattice is fine beside the cutoff
    const double cutoff = std::cbrt(3.0 * (kNeighbors + 1.0) / (4.0 * 3.14159265358979));
    const int edge = 40;
    const int ranks = 1000000;  // nearly all of them have neighbors on all sides
    const double all = 1e6 * edge * edge * edge;
    const double counted = countedGhosts(edge, 1.1 * cutoff);
    CHECK(stepOnRanks({all, kNeighbors, 1.0}, ranks).ghosts == Approx(counted).epsilon(0.1));
}
