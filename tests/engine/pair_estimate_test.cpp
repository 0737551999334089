// The estimated number of pairs of neighbors against the number of pairs in a neighbor list.
#include "engine/neighbors/pair_estimate.h"

#include "engine/neighbors/neighbor_list.h"
#include "engine/state/bodies.h"
#include "tests/catch.h"

using namespace engine;

namespace {

double listedPairs(const std::vector<Vec3>& positions, const std::vector<double>& radii, double cutoff) {
    NeighborList list;
    build(list, positions, radii, cutoff, 0.0);
    return 0.5 * static_cast<double>(list.entryCount);
}

}  // namespace

TEST_CASE("The pairs of few particles are counted, those of many are estimated", "[neighbors]") {
    const auto check = [](double spacing, double tolerance) {
        const std::vector<Vec3> positions = boxPositions(Vec3::Zero(), Vec3(1, 1, 1), {.spacing = spacing});
        std::vector<double> radii(positions.size(), 0.05);
        radii[0] = 0.1;  // not in every sample
        const double cutoff = 0.4;
        INFO(positions.size() << " particles");
        CHECK(estimatePairCount(positions, radii, cutoff) ==
              Approx(listedPairs(positions, radii, cutoff)).epsilon(tolerance));
    };
    check(0.1, 0.0);
    // Each of n = 4000 particles has some tens of neighbors in the sample: the count of these pairs varies by about 1
    // %.
    check(0.04, 0.05);
    CHECK(estimatePairCount({}, {}, 1.0) == 0.0);
}

TEST_CASE("A sample is the same in every call, of about the size that is asked for", "[neighbors]") {
    const std::vector<std::uint32_t> sample = sampleOf(100000, 25);
    CHECK(sample == sampleOf(100000, 25));
    CHECK(static_cast<double>(sample.size()) == Approx(4000.0).epsilon(0.08));  // five standard deviations of 62
    CHECK(sampleOf(10, 1).size() == 10);
    CHECK(strideFor(100.0, 100.0) == 1);
    CHECK(strideFor(101.0, 100.0) == 2);
}
