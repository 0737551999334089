// Costs read off fronts that are known.
#include "tests/catch.h"

#include "studies/common/pareto_front.h"

using studies::costAt;

namespace {

/// A method of order 2: error = 1 / cost^2.
const std::vector<studies::CostPoint> kOrderTwo = {{1, 1}, {1e-2, 10}, {1e-4, 100}};

constexpr double kRounding = 1e-12;  // logarithms and a power

}  // namespace

TEST_CASE("Between points a power law is met exactly", "[studies]") {
    CHECK(costAt(kOrderTwo, 1e-2).value() == Approx(10).epsilon(kRounding));
    CHECK(costAt(kOrderTwo, 1e-1).value() == Approx(3.1622776601683795).epsilon(kRounding));
    CHECK(costAt(kOrderTwo, 1e-3).value() == Approx(31.622776601683793).epsilon(kRounding));
}

TEST_CASE("The order of the points does not matter", "[studies]") {
    CHECK(costAt({kOrderTwo[2], kOrderTwo[0], kOrderTwo[1]}, 1e-3).value() == costAt(kOrderTwo, 1e-3).value());
}

TEST_CASE("Above the front the cheapest point, below it nothing", "[studies]") {
    CHECK(costAt(kOrderTwo, 5.0).value() == 1.0);
    CHECK_FALSE(costAt(kOrderTwo, 0.99e-4));
    CHECK_FALSE(costAt({}, 1.0));
}

TEST_CASE("A point that another beats in both does not count", "[studies]") {
    auto points = kOrderTwo;
    points.push_back({0.5, 20});  // dearer than the second, and worse
    points.push_back({2.0, 1.0});
    CHECK(costAt(points, 1e-1).value() == costAt(kOrderTwo, 1e-1).value());
    CHECK(costAt(points, 5.0).value() == 1.0);
}
