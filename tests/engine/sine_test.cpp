// Tests the sine and cosine of poses: their error, their symmetries, and that their bits are those of any machine.
#include "tests/catch.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "engine/core/hash.h"
#include "engine/core/random.h"
#include "engine/core/sine.h"

using engine::sineAndCosine;

namespace {

constexpr double kMost = 1e6;        // largest angle that is promised, rad
constexpr double kPromised = 4e-16;  // largest error that is promised

/// An angle for tests: of random sign, and of random size between 1e-9 and 1e6.
double angleOf(std::uint64_t index) {
    const double share = engine::symmetricUnit(engine::randomBits(1, 2, index));
    const double sign = engine::symmetricUnit(engine::randomBits(1, 3, index)) < 0.0 ? -1.0 : 1.0;
    return sign * std::pow(10.0, -1.5 + 7.5 * share);
}

/// Checks against the library's functions of long double, whose error is 2000 times smaller than what is allowed.
void checkAt(double angle) {
    const auto [sine, cosine] = sineAndCosine(angle);
    const double sineError = static_cast<double>(std::abs(sine - std::sin(static_cast<long double>(angle))));
    const double cosineError = static_cast<double>(std::abs(cosine - std::cos(static_cast<long double>(angle))));
    if (sineError <= kPromised && cosineError <= kPromised) return;
    CAPTURE(angle, sine, cosine, sineError, cosineError);
    CHECK(sineError <= kPromised);
    CHECK(cosineError <= kPromised);
}

}  // namespace

TEST_CASE("sine and cosine are within their promised error") {
    for (std::uint64_t index = 0; index < 200000; ++index) checkAt(angleOf(index));
    for (std::uint64_t index = 0; index < 200000; ++index)
        checkAt(kMost * engine::symmetricUnit(engine::randomBits(1, 4, index)));
    checkAt(kMost);
    checkAt(-kMost);
    SUCCEED();
}

TEST_CASE("sine and cosine are right on both sides of every eighth of a turn") {
    for (int eighth = -4000; eighth <= 4000; ++eighth) {
        const double angle = eighth * (0.25 * std::numbers::pi);
        for (const double near : {std::nextafter(angle, -kMost), angle, std::nextafter(angle, kMost)}) checkAt(near);
    }
    // The multiples of a quarter turn that lie closest to a double below a million are the hardest to reduce.
    for (int quarter = 600000; quarter < 636000; ++quarter) checkAt(quarter * (0.5 * std::numbers::pi));
    SUCCEED();
}

TEST_CASE("nothing turns by no angle") {
    CHECK(sineAndCosine(0.0).sine == 0.0);
    CHECK(sineAndCosine(0.0).cosine == 1.0);
    CHECK(std::signbit(sineAndCosine(-0.0).sine));
    CHECK(sineAndCosine(1e-300).sine == 1e-300);
    CHECK(sineAndCosine(1e-300).cosine == 1.0);
}

TEST_CASE("the sine is odd and the cosine even, to the last bit") {
    for (std::uint64_t index = 0; index < 10000; ++index) {
        const double angle = angleOf(index);
        const auto [sine, cosine] = sineAndCosine(angle);
        const auto [opposite, same] = sineAndCosine(-angle);
        if (opposite == -sine && same == cosine) continue;
        CAPTURE(angle);
        CHECK(opposite == -sine);
        CHECK(same == cosine);
    }
    SUCCEED();
}

TEST_CASE("sine and cosine have the same bits on every machine") {
    std::uint64_t hash = engine::fnv1a({});
    for (int step = -5000; step <= 5000; ++step) {
        // Angles that are exact, so that they do not depend on the machine either.
        const auto [sine, cosine] = sineAndCosine(step * 0.37109375);
        hash = engine::fnv1a(std::bit_cast<std::uint64_t>(sine), hash);
        hash = engine::fnv1a(std::bit_cast<std::uint64_t>(cosine), hash);
    }
    CHECK(engine::hexadecimal(hash) == "7ff26c2f43e1299c");
}
