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

TEST_CASE("the numbers of docs/beyond-one-machine.md are those of the model", "[rank-model]") {
    constexpr double kSeconds = 0.236e-6;  // of a particle on one thread
    struct Row {
        int ranks;
        double ghosts, weak, weakEfficiency;  ///< 50,000 particles each: number, ms
        double strong, strongEfficiency;      ///< 10 million particles in all: ms
    };
    const auto near = [](double number) { return Approx(number).epsilon(0.01); };
    for (const Row& row : {Row{1, 0, 11.8, 1, 2360, 1}, Row{2, 4221, 15.2, 0.78, 1482, 0.80},
                           Row{8, 10631, 15.8, 0.75, 376, 0.78}, Row{64, 16469, 16.3, 0.72, 49.1, 0.75},
                           Row{512, 19523, 16.7, 0.71, 6.95, 0.66}, Row{1000, 20145, 16.7, 0.71, 3.88, 0.61}}) {
        INFO(row.ranks << " ranks");
        const StepOnRanks weak = stepOnRanks({5e4 * row.ranks, 45.0, kSeconds * 5e4 * row.ranks}, row.ranks);
        const StepOnRanks strong = stepOnRanks({1e7, 45.0, kSeconds * 1e7}, row.ranks);
        if (row.ranks > 1) CHECK(weak.ghosts == near(row.ghosts));
        if (row.ranks > 1) CHECK(1e3 * weak.seconds == near(row.weak));
        CHECK(1e3 * strong.seconds == near(row.strong));
        CHECK(weak.efficiency == near(row.weakEfficiency));
        CHECK(strong.efficiency == near(row.strongEfficiency));
    }
    CHECK(1e3 * stepOnRanks({140647.0, 45.0, 33.1e-3}, 2).seconds == near(21.2));
    CHECK(1e3 * stepOnRanks({94000.0, 45.0, 2.0 * 10.1e-3}, 2).seconds == near(13.0));
}
