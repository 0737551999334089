// Bulk statistics and position errors of a few particles, whose values are worked out by hand.
#include "studies/common/state_difference.h"

#include <cmath>

#include "tests/catch.h"

using engine::Vec3;

namespace {

/// Particles of 0.15 m and 1 kg on the x axis at 0, 1, 2, ... m.
engine::Particles row(int count) {
    engine::Particles particles;
    for (int k = 0; k < count; ++k) engine::append(particles, {.position = Vec3(k, 0, 0)});
    return particles;
}

constexpr double kSumRounding = 1e-14;  // of a few sums of at most ten numbers below ten

}  // namespace

TEST_CASE("The center and the radius of gyration are weighted by mass", "[studies]") {
    engine::Particles pair;
    engine::append(pair, {.position = Vec3(0, 0, 0), .mass = 3.0});
    engine::append(pair, {.position = Vec3(4, 0, 0), .mass = 1.0});
    const auto statistics = studies::bulkStatistics(pair);
    CHECK((statistics.center - Vec3(1, 0, 0)).norm() <= kSumRounding);
    // (3 * 1^2 + 1 * 3^2) / 4 = 3
    CHECK(std::abs(statistics.gyration - std::sqrt(3.0)) <= kSumRounding);
}

TEST_CASE("R90 and z90 hold nine of ten particles, and all of fewer than ten", "[studies]") {
    engine::Particles ten = row(10);
    for (int k = 0; k < 10; ++k) ten.position[static_cast<std::size_t>(k)].y() = 9.0 - k;
    const auto statistics = studies::bulkStatistics(ten);
    // The center is (4.5, 4.5, 0) and the distances are sqrt(2) times 0.5, 0.5, 1.5, 1.5, ..., 4.5, 4.5. The ninth of
    // them is one of the two largest.
    CHECK(std::abs(statistics.r90 - 4.5 * std::sqrt(2.0)) <= kSumRounding);
    CHECK(statistics.z90 == 8.0);
    // Of two distances, both 0.5, the second one counts.
    CHECK(std::abs(studies::bulkStatistics(row(2)).r90 - 0.5) <= kSumRounding);
    // Twenty on a line: the center is 9.5, the distances are 0.5, 0.5, 1.5, 1.5, ..., 9.5, 9.5, and the 18th counts.
    CHECK(std::abs(studies::bulkStatistics(row(20)).r90 - 8.5) <= kSumRounding);
}

TEST_CASE("The statistics of no particles are zero", "[studies]") {
    const auto statistics = studies::bulkStatistics({});
    CHECK(statistics.gyration == 0.0);
    CHECK(statistics.r90 == 0.0);
    CHECK(statistics.z90 == 0.0);
}

TEST_CASE("The largest difference is that of the quantity that differs most", "[studies]") {
    studies::BulkStatistics a;
    studies::BulkStatistics b;
    CHECK(studies::largestDifference(a, b) == 0.0);
    b.center = Vec3(3, 4, 0);
    b.gyration = -4.0;
    CHECK(studies::largestDifference(a, b) == 5.0);
    b.z90 = 6.0;
    CHECK(studies::largestDifference(a, b) == 6.0);
    b.r90 = 7.0;
    CHECK(studies::largestDifference(a, b) == 7.0);
    b.gyration = 8.0;
    CHECK(studies::largestDifference(b, a) == 8.0);
}

TEST_CASE("Position errors are measured in each particle's own radius", "[studies]") {
    const engine::Particles reference = row(2);
    engine::Particles moved = reference;
    moved.position[0].y() += 0.15;
    moved.position[1].z() += 0.45;
    const auto error = studies::positionError(moved, reference, 2);
    CHECK(error.compared == 2);
    CHECK(error.largest == Approx(3.0).epsilon(kSumRounding));
    CHECK(error.rms == Approx(std::sqrt(5.0)).epsilon(kSumRounding));  // (1 + 9) / 2
    engine::Particles larger = reference;
    larger.radius[1] = 0.45;
    CHECK(studies::positionError(moved, larger, 2).rms == Approx(1.0).epsilon(kSumRounding));
}

TEST_CASE("Particles born at different times are not compared", "[studies]") {
    engine::Particles a = row(3);
    engine::Particles b = row(3);
    a.position[2].y() += 1.5;
    CHECK(studies::positionError(a, b, 2).compared == 3);  // the third was born in both at the same time
    a.birthTime[2] = 0.1;
    CHECK(studies::positionError(a, b, 2).compared == 2);
    CHECK(studies::positionError(a, b, 2).largest == 0.0);
    a.birthTime[2] = 0.0;
    a.material[2] = 1;
    CHECK(studies::positionError(a, b, 2).compared == 2);
    CHECK(studies::positionError(row(4), b, 2).compared == 2);
    CHECK(studies::positionError({}, {}, 0).compared == 0);
}

TEST_CASE("Displaced particles stay within the distance, and are the same in every call", "[studies]") {
    const engine::Particles particles = row(100);
    const engine::Particles twin = studies::displaced(particles, 1e-6);
    const auto error = studies::positionError(twin, particles, 100);
    CHECK(error.largest <=
          std::sqrt(3.0) * 1e-6 * (1 + 1e-6));      // up to 1e-6 along each axis; positions are rounded by 1e-14 m
    CHECK(error.rms == Approx(1e-6).epsilon(0.2));  // variance 1/3 on each of three axes; 100 samples
    CHECK(studies::positionError(twin, studies::displaced(particles, 1e-6), 100).largest == 0.0);
}
