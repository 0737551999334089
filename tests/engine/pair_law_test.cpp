// The pair law against closed forms, the printed equation and central differences.
#include "engine/force_law/pair_law.h"

#include <cmath>
#include "tests/catch.h"

#include "tests/engine/clouds.h"
#include "tests/engine/rounding.h"

using namespace engine;

namespace {

constexpr PairTerms kAll{};
constexpr PairTerms kEqualReach{.equalReach = true};

/// Coefficient of P in equation 2 as printed, without the guard near D = 0.
double printedCoefficient(double d, double approach, const Material& m, double restLength) {
    const double b2 = m.repulsion / (restLength * restLength);
    const double sr = std::max(0.0, 1.0 - d * d / std::pow(m.repulsionReach * restLength, 2));
    const double sd = std::max(0.0, 1.0 - d * d / std::pow(m.dampingReach * restLength, 2));
    return sr * (m.repulsion / std::pow(d, 5) - b2 / std::pow(d, 3)) - sd * m.damping * approach / (d * d);
}

double radialForce(double d, const PairConstants<double>& c) {
    return d * pairCoefficient<kAll>(d * d, 0.0, c);
}

}  // namespace

TEST_CASE("The factored coefficient is equation 2 as printed", "[pair_law]") {
    for (const Material& material : materialPresets()) {
        const auto c = pairConstants<double>(material, 0.3);
        for (double d = 0.08; d < 0.7; d += 0.0137) {
            const double approach = 0.3 * d;
            const double printed = printedCoefficient(d, approach, material, 0.3);
            // Largest term of the unfactored form times a dozen roundings: cancellation happens among its terms.
            const double largest = material.repulsion / std::pow(d, 5) + material.damping;
            INFO(material.name << " D = " << d);
            CHECK(std::abs(pairCoefficient<kAll>(d * d, approach, c) - printed) <= 12 * kEps * largest);
            if (material.repulsionReach == material.dampingReach)
                CHECK(std::abs(pairCoefficient<kEqualReach>(d * d, approach, c) - printed) <= 12 * kEps * largest);
        }
    }
}

TEST_CASE("Leaving out a term that a material does not have changes no bit", "[pair_law]") {
    const auto liquid = pairConstants<double>(*materialPreset("liquid"), 0.3);
    for (double d = 0.05; d < 0.7; d += 0.0071)
        CHECK(pairCoefficient<PairTerms{false, true}>(d * d, 0.2, liquid) == pairCoefficient<kAll>(d * d, 0.2, liquid));
    Material undamped = *materialPreset("solid");
    undamped.damping = 0.0;
    const auto c = pairConstants<double>(undamped, 0.3);
    for (double d = 0.05; d < 0.7; d += 0.0071)
        CHECK(pairCoefficient<PairTerms{true, false}>(d * d, 0.2, c) == pairCoefficient<kAll>(d * d, 0.2, c));
}

TEST_CASE("The force on a pair is antisymmetric bit for bit", "[pair_law]") {
    const auto c = pairConstants<double>(*materialPreset("solid"), 0.31);
    for (std::uint64_t k = 0; k < 200; ++k) {
        const Vec3 separation = 0.4 * clouds::randomVector(3, k);
        const Vec3 velocity = clouds::randomVector(4, k);
        const Vec3 there = pairCoefficient<kAll>(squaredLength(separation), dot(velocity, separation), c) * separation;
        const Vec3 back = -separation;
        const Vec3 here = pairCoefficient<kAll>(squaredLength(back), dot(Vec3(-velocity), back), c) * back;
        CHECK(there == -here);
    }
}

TEST_CASE("The force is minus the derivative of the energy", "[pair_law]") {
    for (const double reach : {1.0, 2.0, 2.5}) {
        Material material = *materialPreset("solid");
        material.repulsionReach = reach;
        const auto c = pairConstants<double>(material, 0.3);
        for (double d = 0.03; d < 0.3 * reach; d += 0.0113) {
            const double h = 1e-5 * d;
            const double slope = (pairEnergy(d + h, c) - pairEnergy(d - h, c)) / (2 * h);
            const double scale = material.repulsion / std::pow(std::max(d, 0.075), 4);
            // Truncation h^2 F''/6 < 20 (h/d)^2 scale = 2e-9 scale, rounding eps U/h < 2e-11 scale; the kink at the
            // core distance adds little.
            INFO("c_r = " << reach << ", D = " << d);
            CHECK(std::abs(radialForce(d, c) + slope) <= 4e-9 * scale);
        }
    }
}

TEST_CASE("The stiffness is minus the derivative of the force", "[pair_law]") {
    const auto c = pairConstants<double>(*materialPreset("solid"), 0.3);
    for (const double d : {0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.59}) {
        const double h = 1e-5 * d;
        const double slope = (radialForce(d + h, c) - radialForce(d - h, c)) / (2 * h);
        // Truncation h^2 F'''/6 < 100 (h/d)^2 b1/d^5 = 1e-8 b1/d^5 with d at least the core.
        CHECK(std::abs(pairStiffness(d, c) + slope) <= 1e-8 * 0.8 / std::pow(std::max(d, 0.075), 5));
    }
}

TEST_CASE("Known values of Table 1", "[pair_law]") {
    const auto solid = pairConstants<double>(*materialPreset("solid"), 0.3);
    const double closed = 2.0 * (1.0 - 0.25) * 0.8 / std::pow(0.3, 5);      // 2 (1 - 1/c_r^2) b1 / D0^5
    CHECK(pairStiffness(0.3, solid) == Approx(closed).epsilon(16 * kEps));  // a handful of roundings
    CHECK(closed == Approx(493.8).epsilon(1e-4));                           // the quoted value, to its digits
    // Depth of the well at D0: b1 / (12 D0^3) for c_r = 2.
    CHECK(pairEnergy(0.3, solid) == Approx(-0.8 / (12.0 * 0.027)).epsilon(64 * kEps));  // cancellation among four terms
    // Largest attraction 9/64 b1/D0^4 at 1.265 D0 = sqrt(8/5) D0.
    const double widest = std::sqrt(1.6) * 0.3;
    CHECK(radialForce(widest, solid) == Approx(-9.0 / 64.0 * 0.8 / std::pow(0.3, 4)).epsilon(64 * kEps));  // same
}

TEST_CASE("A pair at rest length and beyond the cutoff", "[pair_law]") {
    for (const Material& material : materialPresets()) {
        const auto c = pairConstants<double>(material, 0.3);
        const double cutoff = std::sqrt(c.cutoffSq);
        CHECK(std::abs(radialForce(0.3, c)) <= 32 * kEps * c.b1 / std::pow(0.3, 4));  // zero to rounding at D0
        for (const double beyond : {c.cutoffSq, c.cutoffSq * 1.0001, 4.0 * c.cutoffSq})
            CHECK(pairCoefficient<kAll>(beyond, 1.0, c) == 0.0);
        for (const double reachSq = c.reachSq; const double beyond : {reachSq, std::nextafter(reachSq, 1.0)})
            CHECK(pairCoefficient<kEqualReach>(beyond, 1.0, c) == 0.0);
        CHECK(pairEnergy(cutoff * 1.0001, c) == 0.0);
    }
}

TEST_CASE("Materials with c_r = 1 never attract, damping always brakes", "[pair_law]") {
    const auto liquid = pairConstants<double>(*materialPreset("liquid"), 0.3);
    for (double d = 0.001; d < 0.7; d += 0.001) {
        CHECK(radialForce(d, liquid) >= 0.0);
        const double receding = pairCoefficient<kAll>(d * d, 1.0, liquid) - pairCoefficient<kAll>(d * d, 0.0, liquid);
        CHECK(receding <= 0.0);
    }
}

TEST_CASE("Below the core distance the force is linear and the energy finite", "[pair_law]") {
    const auto c = pairConstants<double>(*materialPreset("powder"), 0.3);
    const double core = std::sqrt(c.coreSq);
    const double atCore = radialForce(core, c);
    for (const double share : {0.0, 1e-300, 1e-9, 0.25, 0.5, 0.9}) {
        CHECK(radialForce(share * core, c) == Approx(share * atCore).epsilon(16 * kEps));  // the product's roundings
        CHECK(std::isfinite(pairEnergy(share * core, c)));
    }
    CHECK(pairEnergy(core * (1 - 1e-9), c) == Approx(pairEnergy(core, c)).epsilon(1e-7));  // relative slope F D/U < 30
    CHECK(pairEnergy(0.0, c) > pairEnergy(core, c));
}

TEST_CASE("Coincident particles separate along a direction drawn from their ids", "[pair_law]") {
    const Vec3 there = coincidentSeparation(3, 8, 0.3);
    CHECK(there == -coincidentSeparation(8, 3, 0.3));
    CHECK(there.norm() == Approx(kCoincidentShare * 0.3).epsilon(8 * kEps));  // a normalization's roundings
    CHECK(coincidentSeparation(3, 9, 0.3) != there);
}

TEST_CASE("The law serves float as it serves double", "[pair_law]") {
    const Material material = *materialPreset("solid");
    const auto inDouble = pairConstants<double>(material, 0.3);
    const auto inFloat = pairConstants<float>(material, 0.3);
    for (double d = 0.1; d < 0.7; d += 0.013) {
        const double exact = pairCoefficient<kAll>(d * d, 0.1, inDouble);
        const float rounded = pairCoefficient<kAll>(static_cast<float>(d * d), 0.1F, inFloat);
        // A dozen float roundings of 1/D^2 - 1/D0^2 before the product: relative to b1/D^5 and b_d/D^2.
        const double largest = material.repulsion / std::pow(d, 5) + material.damping / (d * d);
        CHECK(std::abs(rounded - exact) <= 12 * 1.2e-7 * largest);
    }
}

TEST_CASE("Two materials mix by means of every constant, in either order", "[pair_law]") {
    Material a;
    a.repulsion = 0.02;
    a.damping = 3.0;
    a.repulsionReach = 1.2;
    a.dampingReach = 1.8;
    a.friction = 0.2;
    a.coreFraction = 0.2;
    Material b;
    b.repulsion = 0.08;
    b.damping = 12.0;
    b.repulsionReach = 1.6;
    b.dampingReach = 2.6;
    b.friction = 0.8;
    b.coreFraction = 0.4;
    for (const Material& mix : {mixed(a, b), mixed(b, a)}) {
        // Two roundings each. Every value differs from that of the other kind of mean and from both parts.
        CHECK(mix.repulsion == Approx(0.04).epsilon(4 * kEps));      // sqrt(0.02 * 0.08)
        CHECK(mix.damping == Approx(6.0).epsilon(4 * kEps));         // sqrt(3 * 12)
        CHECK(mix.repulsionReach == Approx(1.4).epsilon(4 * kEps));  // (1.2 + 1.6) / 2
        CHECK(mix.dampingReach == Approx(2.2).epsilon(4 * kEps));    // (1.8 + 2.6) / 2
        CHECK(mix.friction == Approx(0.4).epsilon(4 * kEps));        // sqrt(0.2 * 0.8)
        CHECK(mix.coreFraction == Approx(0.3).epsilon(4 * kEps));    // (0.2 + 0.4) / 2
    }
    CHECK(mixed(a, b).repulsion == mixed(b, a).repulsion);  // bit for bit, as momentum needs
    CHECK(mixed(a, b).damping == mixed(b, a).damping);
    CHECK(mixed(a, b).repulsionReach == mixed(b, a).repulsionReach);
    CHECK(mixed(a, b).dampingReach == mixed(b, a).dampingReach);
    CHECK(mixed(a, b).friction == mixed(b, a).friction);
    CHECK(mixed(a, b).coreFraction == mixed(b, a).coreFraction);
}
