// Pair forces of several materials with different laws and of unequal radii: the SIMD kernels against the reference and
// the scalar kernel, on every instruction set, in both precisions.
#include "engine/forces/pair_sums.h"

#include <cmath>
#include <string>
#include "tests/catch.h"

#include "engine/run/diagnostics.h"
#include "engine/stepping/take_step.h"
#include "tests/engine/on_instruction_set.h"
#include "tests/engine/rounding.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// Materials between two presets, all with different laws.
std::vector<Material> materialsBetween(const char* first, const char* last, std::size_t count) {
    const Material a = *materialPreset(first);
    const Material b = *materialPreset(last);
    std::vector<Material> materials(count, a);
    for (std::size_t k = 0; k < count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count - 1);
        const auto between = [&](double from, double to) { return from + share * (to - from); };
        materials[k].repulsion = between(a.repulsion, b.repulsion) * (1.0 + 0.1 * share);
        materials[k].damping = between(a.damping, b.damping);
        materials[k].repulsionReach = between(a.repulsionReach, b.repulsionReach);
        materials[k].dampingReach = between(a.dampingReach, b.dampingReach);
        materials[k].friction = between(a.friction, b.friction);
        materials[k].coreFraction = between(0.25, 0.4);
    }
    return materials;
}

struct Mixture {
    std::string name;
    ForceField field;
    Particles particles;
};

/// Mixtures that need every combination of terms, of 1, 2, 16 and more materials than are tabulated, of equal and of
/// unequal radii.
std::vector<Mixture> mixtures() {
    const std::pair<const char*, const char*> ends[] = {{"powder", "powder"}, {"liquid", "powder"}, {"liquid", "solid"},
                                                        {"solid", "powder"},  {"sand", "mud"},      {"sand", "liquid"}};
    std::vector<Mixture> all;
    for (const auto& [first, last] : ends)
        for (const bool isDamped : {true, false})
            for (const bool isUnequal : {true, false})
                for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{16}, kMostTabulated + 1}) {
                    if (count == 1 && !isUnequal) continue;
                    Mixture m;
                    m.name = std::to_string(count) + " materials from " + first + " to " + last +
                             (isDamped ? ", damped" : "") + (isUnequal ? ", unequal radii" : "");
                    m.field.materials =
                        count > 1 ? materialsBetween(first, last, count) : std::vector{*materialPreset(last)};
                    for (Material& material : m.field.materials)
                        if (!isDamped) material.damping = 0.0;
                    m.particles = isUnequal ? clouds::strewnUnequal(203, 0.8) : clouds::strewn(203, 0.8);
                    for (std::uint32_t p = 0; p < m.particles.count(); ++p)
                        m.particles.material[p] = p * 7 % static_cast<std::uint32_t>(count);
                    all.push_back(m);
                }
    return all;
}

struct Sums {
    std::vector<Vec3> forces;
    double energy = 0.0;
};

Sums sumsOf(const ForceField& field, const Particles& particles, Precision precision = Precision::doubles) {
    ForceEvaluator evaluator(field, ForceMethod::grid, precision);
    Sums sums;
    sums.energy = evaluator.evaluateFree(particles, particles.velocity, sums.forces);
    return sums;
}

/// The same particles and laws with so many materials that the scalar kernel sums their forces.
ForceField withoutTable(ForceField field) {
    if (field.materials.size() > kMostTabulated) return field;
    field.materials.resize(kMostTabulated + 1, field.materials.front());
    Material other = field.materials.front();  // a law that no particle has and that needs no other terms
    other.repulsion *= 2.0;
    field.materials.back() = other;
    return field;
}

double rms(const std::vector<Vec3>& vectors) {
    double sum = 0.0;
    for (const Vec3& v : vectors) sum += squaredLength(v);
    return std::sqrt(sum / static_cast<double>(vectors.size()));
}

double rmsDifference(std::vector<Vec3> a, const std::vector<Vec3>& b) {
    for (std::size_t p = 0; p < a.size(); ++p) a[p] -= b[p];
    return rms(a);
}

/// Pairs of particles far from all other pairs, of all materials and of unequal radii.
Particles lonePairs(std::size_t materialCount, double distanceInRadii) {
    Particles particles = clouds::strewnUnequal(400, 0.1);
    for (std::size_t p = 0; p < particles.count(); p += 2) {
        const Vec3 direction = clouds::randomVector(33, p).normalized();
        particles.position[p] += Vec3(5.0 * static_cast<double>(p), 0.0, 0.0);
        particles.position[p + 1] =
            particles.position[p] + direction * distanceInRadii * (particles.radius[p] + particles.radius[p + 1]);
        particles.material[p] = static_cast<std::uint32_t>(p / 2 % materialCount);
        particles.material[p + 1] = static_cast<std::uint32_t>(p / 3 % materialCount);
    }
    return particles;
}

}  // namespace

TEST_CASE("Forces of mixtures agree with the reference, and have the bits of the scalar kernel everywhere",
          "[mixtures][threads]") {
    for (const Mixture& m : mixtures()) {
        INFO(m.name);
        REQUIRE_FALSE(termsFor(m.field, m.particles).uniform());
        std::vector<Vec3> expected;
        pairForcesReference(m.field, m.particles, m.particles.velocity, expected);
        const double energy = pairEnergyReference(m.field, m.particles);
        const Sums scalar = sumsOf(withoutTable(m.field), m.particles);
        // 203 terms in two orders, and the constants of a pair within 8 units in the last place, where terms cancel.
        CHECK(rmsDifference(scalar.forces, expected) <= 1000 * kEps * rms(expected));
        for (const std::string& name : instructionSets()) {
            const OnInstructionSet only(name);
            INFO(name);
            const Sums sums = sumsOf(m.field, m.particles);
            CHECK(sums.forces == scalar.forces);
            CHECK_THAT(sums.energy, Catch::Matchers::WithinRel(energy, 1e-12));
            CHECK_THAT(sums.energy, Catch::Matchers::WithinRel(scalar.energy, 1e-12));
        }
    }
}

TEST_CASE("In float, forces of mixtures differ by float roundings", "[mixtures]") {
    for (const Mixture& m : mixtures()) {
        if (m.field.materials.size() > kMostTabulated) continue;
        INFO(m.name);
        const Sums doubles = sumsOf(m.field, m.particles);
        const Sums floats = sumsOf(m.field, m.particles, Precision::singles);
        const double error = rmsDifference(floats.forces, doubles.forces) / rms(doubles.forces);
        CHECK(error > 0.0);
        CHECK(error < 4e-6);  // some tens of roundings of 6e-8 a pair
        CHECK_THAT(floats.energy, Catch::Matchers::WithinRel(doubles.energy, 1e-5));
        for (const std::string& name : instructionSets()) {
            const OnInstructionSet only(name);
            CHECK(sumsOf(m.field, m.particles, Precision::singles).forces == floats.forces);
        }
    }
}

TEST_CASE("The forces of unlike particles on each other are opposite bit for bit", "[mixtures]") {
    for (const char* last : {"solid", "mud"})
        for (const std::size_t count : {std::size_t{2}, std::size_t{16}, kMostTabulated + 1})
            for (const double distance : {0.2, 0.7, 0.99}) {
                ForceField field;
                field.materials = materialsBetween("liquid", last, count);
                const Particles particles = lonePairs(count, distance);
                for (const Precision precision : {Precision::doubles, Precision::singles})
                    for (const std::string& name : instructionSets()) {
                        const OnInstructionSet only(name);
                        const std::vector<Vec3> forces = sumsOf(field, particles, precision).forces;
                        INFO(count << " materials to " << last << " on " << name);
                        for (std::size_t p = 0; p < forces.size(); p += 2) {
                            CHECK(forces[p].norm() > 0.0);
                            CHECK(forces[p] == -forces[p + 1]);
                        }
                    }
            }
}

TEST_CASE("Unlike particles do not act at their cutoff or beyond", "[mixtures]") {
    // All reaches are equal, so that the cutoff is the same share of every rest length.
    for (const double reach : {1.0, 1.37, 2.0}) {
        ForceField field;
        field.materials = materialsBetween("liquid", "mud", 16);
        for (Material& material : field.materials) material.repulsionReach = material.dampingReach = reach;
        for (const double beyond : {1.0 + 1e-10, 1.01})  // positions of up to 2000 m are rounded to 2e-13 m
            for (const Precision precision : {Precision::doubles, Precision::singles}) {
                if (precision == Precision::singles && beyond < 1.01) continue;  // positions are rounded more coarsely
                for (const Vec3& force : sumsOf(field, lonePairs(16, reach * beyond), precision).forces)
                    CHECK(force == Vec3::Zero());
            }
        for (const Vec3& force : sumsOf(field, lonePairs(16, reach * (1.0 - 1e-6))).forces)
            CHECK(force != Vec3::Zero());
    }
}

TEST_CASE("No rounding lets a pair of any radii act at its cutoff", "[mixtures]") {
    const auto check = [](auto number, double restLength, const Material& material) {
        using Number = decltype(number);
        const auto rest = static_cast<Number>(restLength);
        const PairConstants<Number> c = atRestLength<false>(constantsPerRestLength<Number>(material), rest);
        const Number cutoff = static_cast<Number>(material.dampingReach) * rest;
        CHECK(pairCoefficient<PairTerms{}>(cutoff * cutoff, Number(0.1), c) == 0);
        CHECK(pairCoefficient<PairTerms{true, true, false, true}>(cutoff * cutoff, Number(0.1), c) == 0);
        const Number within = Number(0.999) * cutoff;
        CHECK(pairCoefficient<PairTerms{}>(within * within, Number(0.1), c) != 0);
    };
    for (std::uint64_t k = 0; k < 2000; ++k) {
        Material material = *materialPreset("solid");
        material.repulsionReach = material.dampingReach = 1.5 + 0.4 * clouds::randomVector(41, k).x();
        const double restLength = 0.3 + 0.2 * clouds::randomVector(41, k).y();
        check(0.0, restLength, material);
        check(0.0F, restLength, material);
    }
}

TEST_CASE("Mixtures have the same bits for any number of threads", "[mixtures][threads]") {
    ForceField field;
    field.materials = materialsBetween("liquid", "mud", 16);
    Particles particles = clouds::strewnUnequal(2000, 2.0);
    for (std::uint32_t p = 0; p < particles.count(); ++p) particles.material[p] = p % 16;
    for (const Precision precision : {Precision::doubles, Precision::singles}) {
        const Sums expected = sumsOf(field, particles, precision);
        for (const std::size_t threads : {1U, 3U, 8U}) {
            Sums sums;
            clouds::onThreads(threads, [&] { sums = sumsOf(field, particles, precision); });
            CHECK(sums.forces == expected.forces);
            CHECK(sums.energy == expected.energy);
        }
    }
}

TEST_CASE("Coincident particles of unlike kinds are separated in float as in double", "[mixtures][threads]") {
    for (const char* last : {"solid", "mud"}) {
        ForceField field;
        field.materials = materialsBetween("liquid", last, 3);
        Particles particles = clouds::strewnUnequal(200, 0.7);
        for (std::uint32_t p = 0; p < particles.count(); ++p) particles.material[p] = p % 3;
        particles.position[150] = particles.position[20];
        const Sums doubles = sumsOf(field, particles);
        const Sums floats = sumsOf(field, particles, Precision::singles);
        CHECK(doubles.forces == sumsOf(withoutTable(field), particles).forces);
        for (const std::size_t p : {20U, 150U})
            CHECK((floats.forces[p] - doubles.forces[p]).norm() < 1e-5 * doubles.forces[p].norm());
        CHECK_THAT(floats.energy, Catch::Matchers::WithinRel(doubles.energy, 1e-5));
        CHECK_THAT(doubles.energy, Catch::Matchers::WithinRel(pairEnergyReference(field, particles), 1e-12));
    }
}

TEST_CASE("A run of a mixture has the same bits on every instruction set", "[mixtures]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::linearlyImplicit})
        for (const Precision precision : {Precision::doubles, Precision::singles}) {
            const auto hash = [&] {
                Setup setup = runs::freeSetup(*materialPreset("solid"), stepper, 0.002);
                setup.materials = materialsBetween("liquid", "mud", 5);
                setup.precision = precision;
                runs::addPacking(setup, {7, 6, 9});
                for (std::uint32_t p = 0; p < setup.initial.count(); ++p) {
                    setup.initial.material[p] = p % 5;
                    setup.initial.radius[p] *= 1.0 - 0.1 * (p % 3);
                }
                Simulation simulation = start(setup);
                advance(simulation, 0.06);
                return stateHash(simulation.particles);
            };
            const std::string expected = hash();
            for (const std::string& name : instructionSets()) {
                const OnInstructionSet only(name);
                INFO(nameOf(stepper) << " with " << name);
                CHECK(hash() == expected);
            }
        }
}
