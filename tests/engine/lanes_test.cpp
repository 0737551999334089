// The kernels on vector units: the same bits whatever vectors the machine has, and what float loses.
#include <cmath>

#include "tests/catch.h"

#include "engine/diagnostics.h"
#include "engine/instruction_sets.h"
#include "engine/lane_forces.h"
#include "engine/pair_sums.h"
#include "engine/steppers.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// A block of a few hundred particles: neither a multiple of a group nor of a vector.
Particles block(const Material& material, const Vec3& center) {
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 0.01);
    runs::addPacking(setup, {7, 6, 9});
    for (Vec3& position : setup.initial.position) position += center;
    return setup.initial;
}

std::vector<Vec3> pairForces(const Material& material, const Particles& particles, Precision precision) {
    ForceEvaluator evaluator(clouds::lawOf(material), ForceMethod::grid, precision);
    std::vector<Vec3> forces;
    evaluator.pairForcesGrid(particles, particles.velocity, forces);
    return forces;
}

/// rms difference over rms size.
double relativeDifference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double differenceSq = 0.0;
    double sizeSq = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p) {
        differenceSq += squaredLength(a[p] - b[p]);
        sizeSq += squaredLength(b[p]);
    }
    return std::sqrt(differenceSq / sizeSq);
}

std::string hashOfRun(const char* preset, StepperKind stepper, Precision precision) {
    Setup setup = runs::freeSetup(*materialPreset(preset), stepper, 0.002);
    setup.gravity = Vec3(0, -9.8, 0);
    setup.scenery.colliders = {Plane{Vec3(0, -1, 0), Vec3::UnitY()}};
    setup.precision = precision;
    runs::addPacking(setup, {7, 6, 9});
    Simulation simulation = start(setup);
    advance(simulation, 0.06);
    return stateHash(simulation.particles);
}

}  // namespace

TEST_CASE("A run has the same bits with every kind of vectors", "[lanes]") {
    CHECK(instructionSets().size() > 1);  // what this machine has and at least one narrower kind
    for (const char* preset : {"liquid", "solid", "powder", "sand"})
        for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::linearlyImplicit})
            for (const Precision precision : {Precision::doubles, Precision::singles}) {
                const std::string expected = hashOfRun(preset, stepper, precision);
                for (const std::string& name : instructionSets()) {
                    const OnInstructionSet only(name);
                    INFO(preset << ", " << nameOf(stepper) << " with " << name);
                    CHECK(laneInstructionSet() == name);
                    CHECK(hashOfRun(preset, stepper, precision) == expected);
                }
            }
}

TEST_CASE("In double, forces have the bits of the scalar kernel", "[lanes]") {
    for (const std::string& preset : materialPresetNames()) {
        Material material = *materialPreset(preset);
        ForceLaw law = clouds::lawOf(material);
        ForceEvaluator lanes(law, ForceMethod::grid);
        const Particles particles = block(material, Vec3(1.0, 2.0, 3.0));
        REQUIRE(termsFor(law, particles).uniform);
        // A second material, of which there is no particle, keeps vectors from being used.
        material.repulsion *= 2.0;
        law.materials.push_back(material);
        ForceEvaluator scalar(law, ForceMethod::grid);
        REQUIRE_FALSE(termsFor(law, particles).uniform);
        std::vector<Vec3> actual;
        std::vector<Vec3> expected;
        lanes.pairForcesGrid(particles, particles.velocity, actual);
        scalar.pairForcesGrid(particles, particles.velocity, expected);
        INFO(preset);
        CHECK(actual == expected);
        const double energy = lanes.evaluateFree(particles, particles.velocity, actual);
        CHECK(energy != 0.0);
        CHECK_THAT(energy,
                   Catch::Matchers::WithinRel(scalar.evaluateFree(particles, particles.velocity, expected), 1e-13));
    }
}

TEST_CASE("In float, forces err by its roundings, near the origin and far from it", "[lanes]") {
    for (const char* preset : {"liquid", "solid", "powder", "sand"})
        for (const double far : {0.0, 1e3, 1e6}) {
            const Material material = *materialPreset(preset);
            const Particles particles = block(material, Vec3(far, -far, 0.5 * far));
            const double error = relativeDifference(pairForces(material, particles, Precision::singles),
                                                    pairForces(material, particles, Precision::doubles));
            INFO(preset << ", " << far << " m from the origin: " << error);
            CHECK(error > 0.0);
            CHECK(error < 2e-6);  // about ten roundings of 6e-8 a pair, larger where terms cancel at contact
        }
}

TEST_CASE("Coincident particles are parted in float as in double, and near ones are not", "[lanes]") {
    // Float tells 2^-23 of the list's reach apart, 8e-8 m at most.
    const double apart = GENERATE(0.0, 1e-13, 1e-10, 1e-6);
    for (const char* preset : {"powder", "solid", "sand"}) {
        const Material material = *materialPreset(preset);
        Particles particles = block(material, Vec3::Zero());
        particles.position[17] = particles.position[16] + Vec3(0, apart, 0);
        const std::vector<Vec3> doubles = pairForces(material, particles, Precision::doubles);
        const std::vector<Vec3> singles = pairForces(material, particles, Precision::singles);
        INFO(preset << ", " << apart << " m apart");
        CHECK(doubles[17].norm() > 0.0);
        const double slope = pairCoefficient<PairTerms{true, false}>(0.0, 0.0, pairConstants<double>(material, 0.3));
        // Both positions are rounded to half a unit, which may turn friction round; the stand-in's push would be
        // kCoincidentShare 0.3 m slope.
        const double rounding = apart > 0.0 ? slope * (8e-8 + 2.0 * material.friction * apart) : 0.0;
        const double tolerance = 1e-5 * doubles[17].norm() + rounding;
        CHECK((singles[17] - doubles[17]).norm() < tolerance);
        CHECK((singles[16] - doubles[16]).norm() < tolerance);
    }
}

TEST_CASE("In float, forces and energies need no records in double", "[lanes]") {
    const Material material = *materialPreset("solid");
    Particles particles = block(material, Vec3::Zero());
    particles.position[17] = particles.position[16];
    const ForceLaw law = clouds::lawOf(material);
    PairTraversal pairs(law, Precision::singles);
    std::vector<Vec3> forces(particles.count());
    double energy = 0.0;
    pairs.prepare(law, particles, particles.velocity);
    addUpPairs(pairs, {.forces = forces, .energy = &energy});
    CHECK(!pairs.hasRecords);
    CHECK_THAT(energy,
               Catch::Matchers::WithinRel(pairEnergyReference(law, particles), 1e-5));  // some roundings of float
    std::vector<Vec3> alone(particles.count());
    addUpPairs(pairs, {.forces = alone});
    CHECK(alone == forces);
}
