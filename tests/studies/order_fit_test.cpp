// Orders fitted to errors that are known.
#include "tests/catch.h"

#include <cmath>

#include "studies/common/order_fit.h"

using studies::fittedOrder;

TEST_CASE("A power of the step has its exponent as order", "[studies]") {
    for (const double order : {1.0, 2.0, 4.0}) {
        std::vector<studies::StepError> points;
        for (const double step : {0.1, 0.05, 0.025, 0.01}) points.push_back({step, 7.0 * std::pow(step, order)});
        const auto fitted = fittedOrder(points);
        REQUIRE(fitted);
        CHECK(*fitted == Approx(order).epsilon(1e-12));  // roundings of logarithms
    }
}

TEST_CASE("Least squares, worked by hand", "[studies]") {
    // log2 step 0, 1, 2; log2 error 0, 1, 4: slope (1 * 4 - 0) / 2 = 2.
    const auto fitted = fittedOrder({{1, 1}, {2, 2}, {4, 16}});
    REQUIRE(fitted);
    CHECK(*fitted == Approx(2.0).epsilon(1e-12));
}

TEST_CASE("One step shows no order", "[studies]") {
    CHECK_FALSE(fittedOrder({}));
    CHECK_FALSE(fittedOrder({{0.01, 1e-3}}));
    CHECK_FALSE(fittedOrder({{0.01, 1e-3}, {0.01, 1e-4}}));
}
