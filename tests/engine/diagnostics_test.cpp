// Energy, momenta, hash, and the exponential of the drag.
#include "engine/run/diagnostics.h"

#include <cmath>
#include <limits>
#include "tests/catch.h"

#include "engine/core/exp_negative.h"
#include "tests/engine/clouds.h"

using namespace engine;

TEST_CASE("Energy and momenta of two particles by hand", "[diagnostics]") {
    ForceField field = clouds::forceFieldOf("solid");
    field.gravity = Vec3(0, -10, 0);
    ForceEvaluator evaluator(field, ForceMethod::grid);
    Particles particles;
    append(particles, {.position = Vec3(0.3, 2, 0), .velocity = Vec3(0, 3, 0), .mass = 2.0});
    append(particles, {.position = Vec3(0, 2, 0), .velocity = Vec3(0, 0, 1), .mass = 1.0});
    const Energy sum = energy(evaluator, particles);
    CHECK(sum.kinetic == 9.5);
    CHECK(sum.gravity == 60.0);
    CHECK(sum.pairs == Approx(-0.8 / (12 * 0.027)).epsilon(1e-13));  // cancellation among four terms
    CHECK(sum.contacts == 0.0);
    CHECK(sum.total() == Approx(69.5 - 0.8 / (12 * 0.027)));
    CHECK(linearMomentum(particles) == Vec3(0, 6, 1));
    CHECK(angularMomentum(particles).isApprox(Vec3(2, 0, 1.8), 1e-14));  // rounding of 2 * 0.3 * 3
    CHECK(largestSpeed(particles) == 3.0);
}

TEST_CASE("Two states share a hash exactly when every bit agrees", "[diagnostics]") {
    Particles particles = clouds::strewn(50, 1.0);
    const std::string before = stateHash(particles);
    CHECK(before.size() == 16);
    CHECK(stateHash(clouds::strewn(50, 1.0)) == before);
    particles.velocity[49].z() = std::nextafter(particles.velocity[49].z(), 10.0);
    CHECK(stateHash(particles) != before);
    CHECK(stateHash(Particles{}) == "cbf29ce484222325");  // the offset basis of FNV-1a
}

TEST_CASE("The drag's exponential", "[diagnostics]") {
    CHECK(expNegative(0.0) == 1.0);
    for (double x = 1e-6; x < 700.0; x *= 1.37) {
        const double halvings = std::max(0.0, std::ceil(std::log2(x / 0.125)));
        // Ten roundings of the series, doubled by each squaring, which adds one of its own.
        const double tolerance = (10.0 + 2.0) * std::exp2(halvings) * std::numeric_limits<double>::epsilon();
        CHECK(expNegative(x) == Approx(std::exp(-x)).epsilon(tolerance));
    }
    CHECK(expNegative(1e6) == 0.0);
}
