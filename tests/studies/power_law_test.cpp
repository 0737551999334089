// Exponents fitted to points that follow a known power law, and costs read off known Pareto fronts.
#include "studies/common/power_law.h"

#include <cmath>

#include "tests/catch.h"

using studies::costAt;
using studies::powerLawExponent;

namespace {

/// The runs of a method with error = 1 / cost^2.
const std::vector<studies::CostPoint> kOrderTwo = {{1, 1}, {1e-2, 10}, {1e-4, 100}};

constexpr double kRounding = 1e-12;  // of logarithms and a power

}  // namespace

TEST_CASE("A power of the step has its exponent as order", "[studies]") {
    for (const double order : {1.0, 2.0, 4.0}) {
        std::vector<studies::PowerLawPoint> points;
        for (const double step : {0.1, 0.05, 0.025, 0.01}) points.push_back({step, 7.0 * std::pow(step, order)});
        const auto fitted = powerLawExponent(points);
        REQUIRE(fitted);
        CHECK(*fitted == Approx(order).epsilon(kRounding));
    }
}

TEST_CASE("The least-squares exponent of three points is the one worked out by hand", "[studies]") {
    // log2 x is 0, 1, 2 and log2 y is 0, 1, 4: the slope is (1 * 4 - 0) / 2 = 2.
    const auto fitted = powerLawExponent({{1, 1}, {2, 2}, {4, 16}});
    REQUIRE(fitted);
    CHECK(*fitted == Approx(2.0).epsilon(kRounding));
}

TEST_CASE("A single step shows no order", "[studies]") {
    CHECK_FALSE(powerLawExponent({}));
    CHECK_FALSE(powerLawExponent({{0.01, 1e-3}}));
    CHECK_FALSE(powerLawExponent({{0.01, 1e-3}, {0.01, 1e-4}}));
}

TEST_CASE("Between the points of a power law the interpolated cost is exact", "[studies]") {
    CHECK(costAt(kOrderTwo, 1e-2).value() == Approx(10).epsilon(kRounding));
    CHECK(costAt(kOrderTwo, 1e-1).value() == Approx(3.1622776601683795).epsilon(kRounding));
    CHECK(costAt(kOrderTwo, 1e-3).value() == Approx(31.622776601683793).epsilon(kRounding));
}

TEST_CASE("The cost does not depend on the order of the points", "[studies]") {
    CHECK(costAt({kOrderTwo[2], kOrderTwo[0], kOrderTwo[1]}, 1e-3).value() == costAt(kOrderTwo, 1e-3).value());
}

TEST_CASE("An error above the front costs as much as the cheapest point; one below it has no cost", "[studies]") {
    CHECK(costAt(kOrderTwo, 5.0).value() == 1.0);
    CHECK_FALSE(costAt(kOrderTwo, 0.99e-4));
    CHECK_FALSE(costAt({}, 1.0));
}

TEST_CASE("A point that another beats in both error and cost does not count", "[studies]") {
    auto points = kOrderTwo;
    points.push_back({0.5, 20});  // more expensive than the second point, and a larger error
    points.push_back({2.0, 1.0});
    CHECK(costAt(points, 1e-1).value() == costAt(kOrderTwo, 1e-1).value());
    CHECK(costAt(points, 5.0).value() == 1.0);
}
