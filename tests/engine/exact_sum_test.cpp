// Exact sums: rounding to the nearest double, independence of order and division, and what is not finite.
#include "engine/core/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "engine/ranks/exact_sums.h"
#include "tests/catch.h"

namespace {

double sumOf(const std::vector<double>& terms) {
    engine::ExactSum sum;
    for (const double term : terms) sum.add(term);
    return sum.value();
}

/// Random numbers of both signs, whose exponents are spread evenly over a range.
std::vector<double> randomTerms(std::size_t count, int leastExponent, int mostExponent, unsigned seed) {
    std::mt19937_64 bits(seed);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
    std::uniform_int_distribution<int> exponent(leastExponent, mostExponent);
    std::vector<double> terms(count);
    for (double& term : terms) term = std::ldexp(mantissa(bits), exponent(bits));
    return terms;
}

}  // namespace

TEST_CASE("a sum of one term is the term", "[exact]") {
    for (const double term :
         {0.0, 1.0, -1.0, 0.1, -3.7e-308, 5e-324, -5e-324, 1.7976931348623157e308, 0x1p-1022, 0x1.fffffffffffffp31})
        CHECK(sumOf({term}) == term);
    for (const double term : randomTerms(1000, -1073, 1023, 1)) CHECK(sumOf({term}) == term);
    CHECK(sumOf({}) == 0.0);
}

TEST_CASE("a sum is rounded once, to the nearest double and to even", "[exact]") {
    CHECK(sumOf({1.0, 1e100, 1.0, -1e100}) == 2.0);
    CHECK(sumOf({0x1p53, 1.0}) == 0x1p53);                // halfway, to even
    CHECK(sumOf({0x1p53, 1.0, 1e-300}) == 0x1p53 + 2.0);  // just above halfway
    CHECK(sumOf({0x1p53 + 2.0, 1.0}) == 0x1p53 + 4.0);    // halfway, to even
    CHECK(sumOf({0x1p53 + 2.0, 1.0, -1e-300}) == 0x1p53 + 2.0);
    CHECK(sumOf({-0x1p53, -1.0, -1e-300}) == -0x1p53 - 2.0);
    CHECK(sumOf({1.7e308, 1.7e308, -1.7e308}) == 1.7e308);
    CHECK(std::isinf(sumOf({1.7e308, 1.7e308})));
}

TEST_CASE("integers are summed exactly, far more than carries wait for", "[exact][threads]") {
    engine::ExactSum sum;
    std::int64_t expected = 0;
    std::mt19937_64 random(2);
    for (int k = 0; k < 100000; ++k) {
        const auto number = static_cast<std::int64_t>(random() >> 30) - (std::int64_t{1} << 33);
        sum.add(static_cast<double>(number));
        expected += number;
    }
    CHECK(sum.value() == static_cast<double>(expected));
    for (int k = 0; k < 5000; ++k) sum.add(0x1.fffffffffffffp1000);
    for (int k = 0; k < 5000; ++k) sum.add(-0x1.fffffffffffffp1000);
    CHECK(sum.value() == static_cast<double>(expected));
    // The largest terms, all of one word, in chunks of a parallel sum and one after the other.
    const auto term = [](std::size_t k) {
        return k < 10000 ? 0x1.fffffffffffffp30 : k < 20000 ? -0x1.fffffffffffffp30 : 1.0;
    };
    CHECK(engine::exactSum(engine::Ranks::alone(), 20007, term) == 7.0);
    engine::ExactSum::Adder adder;
    engine::ExactSum one;
    for (std::size_t k = 0; k < 20007; ++k) adder.add(term(k), one);
    adder.flush(one);
    CHECK(one.value() == 7.0);
}

TEST_CASE("a sum does not depend on the order and the division of its terms", "[exact][threads]") {
    const int spread = GENERATE(3, 40, 900);
    std::vector<double> terms = randomTerms(5000, -spread, spread, 3);
    const double expected = sumOf(terms);
    // The sum in long double of sorted terms is near; it is not exact.
    std::vector<long double> sorted(terms.begin(), terms.end());
    std::ranges::sort(sorted, [](long double a, long double b) { return std::abs(a) < std::abs(b); });
    const long double near = std::accumulate(sorted.begin(), sorted.end(), 0.0L);
    CHECK(std::abs(near - expected) <= 1e-15L * std::abs(near) + 1e-18L * std::abs(sorted.back()));
    std::mt19937_64 random(4);
    for (int repeat = 0; repeat < 5; ++repeat) {
        std::ranges::shuffle(terms, random);
        CHECK(sumOf(terms) == expected);
        engine::ExactSum whole;
        for (std::size_t begin = 0; begin < terms.size(); begin += 611) {
            engine::ExactSum part;
            for (std::size_t k = begin; k < std::min(begin + 611, terms.size()); ++k) part.add(terms[k]);
            whole += part;
        }
        CHECK(whole.value() == expected);
        const auto both = engine::exactSums<2>(engine::Ranks::alone(), terms.size(), [&](std::size_t k) {
            return std::array{terms[k], -2.0 * terms[k]};
        });
        CHECK(both[0] == expected);
        CHECK(both[1] == -2.0 * expected);
    }
}

TEST_CASE("a sum with a term that is not finite is not a number", "[exact]") {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    CHECK(std::isnan(sumOf({1.0, kInfinity})));
    CHECK(std::isnan(sumOf({1.0, -kInfinity, 2.0})));
    CHECK(std::isnan(sumOf({std::numeric_limits<double>::quiet_NaN()})));
    CHECK(std::isnan(
        engine::exactSum(engine::Ranks::alone(), 3, [](std::size_t k) { return k == 1 ? kInfinity : 1.0; })));
    engine::ExactSum sum;
    engine::ExactSum part;
    part.add(kInfinity);
    sum += part;
    CHECK(std::isnan(sum.value()));
}
