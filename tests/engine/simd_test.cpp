// The SIMD kernels: their results have the same bits on every instruction set, and float loses no more than its
// roundings.
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/catch.h"

#include "engine/forces/external_forces.h"
#include "engine/forces/packed_particles.h"
#include "engine/forces/pair_sums.h"
#include "engine/forces/simd_forces.h"
#include "engine/run/diagnostics.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/kick_drift.h"
#include "engine/stepping/take_step.h"
#include "tests/engine/on_instruction_set.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// A packing of 378 particles, a multiple of neither the cluster size nor any number of lanes.
Particles block(const Material& material, const Vec3& center) {
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 0.01);
    runs::addPacking(setup, {7, 6, 9});
    for (Vec3& position : setup.initial.position) position += center;
    return setup.initial;
}

std::vector<Vec3> pairForces(const Material& material, const Particles& particles, Precision precision) {
    ForceEvaluator evaluator(clouds::forceFieldOf(material), ForceMethod::grid, precision);
    std::vector<Vec3> forces;
    evaluator.evaluatePairs(particles, particles.velocity, forces);
    return forces;
}

/// RMS of the differences between a and b over the RMS length of b.
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
    setup.obstacles.shapes = {Plane{Vec3(0, -1, 0), Vec3::UnitY()}};
    setup.precision = precision;
    runs::addPacking(setup, {7, 6, 9});
    Simulation simulation = start(setup);
    advance(simulation, 0.06);
    return stateHash(simulation.particles);
}

}  // namespace

TEST_CASE("A run has the same bits on every instruction set", "[simd]") {
    CHECK(instructionSets().size() > 1);  // that of this machine and at least one narrower one
    for (const char* preset : {"liquid", "solid", "powder", "sand"})
        for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::linearlyImplicit})
            for (const Precision precision : {Precision::doubles, Precision::singles}) {
                const std::string expected = hashOfRun(preset, stepper, precision);
                for (const std::string& name : instructionSets()) {
                    const OnInstructionSet only(name);
                    INFO(preset << ", " << nameOf(stepper) << " with " << name);
                    CHECK(simdInstructionSet() == name);
                    CHECK(hashOfRun(preset, stepper, precision) == expected);
                }
            }
}

TEST_CASE("Coordinates in fixed point differ exactly, wherever they are", "[simd]") {
    // Coordinates that fit 32 bits, and some that wrap around many times.
    for (const double size : {1.0, 1e4, 1e8}) {
        const Particles particles = clouds::strewnUnequal(1003, size);
        constexpr double kPerMeter = 8388608.0 / 0.66;
        for (std::size_t p = 0; p + 1 < particles.count(); ++p) {
            const double units = particles.position[p].x() * kPerMeter;
            const double near = units + 1e6 * particles.velocity[p].x();
            const auto difference = static_cast<std::int32_t>(static_cast<std::uint32_t>(toFixedPoint(near)) -
                                                              static_cast<std::uint32_t>(toFixedPoint(units)));
            INFO(size << " m, particle " << p);
            CHECK(difference == std::nearbyint(near) - std::nearbyint(units));  // integers below 2^53
        }
    }
}

TEST_CASE("Packed particles are those of the list's order", "[simd]") {
    Particles particles = clouds::strewnUnequal(1003, 1.0);
    for (std::uint32_t p = 0; p < 1003; ++p) particles.material[p] = p % 5;
    NeighborList list;
    for (std::uint32_t k = 0; k < 1003; ++k) list.order.push_back(k * 7 % 1003);
    constexpr double kUnit = 0x1p-20;  // a power of two, so that no coordinate below is rounded on the way
    std::vector<PackedParticle> packed;
    PackedFloats packedFloat;
    packDoubles(list, particles, particles.velocity, packed);
    packFloats(list, particles, particles.velocity, kUnit, packedFloat);
    REQUIRE(packed.size() == 1003);
    REQUIRE(packedFloat.particles.size() == 1003);
    for (std::size_t k = 0; k < 1003; ++k) {
        const std::size_t p = list.order[k];
        const Vec3& x = particles.position[p];
        const Vec3& v = particles.velocity[p];
        CHECK(Vec3(packed[k].x, packed[k].y, packed[k].z) == x);
        CHECK(Vec3(packed[k].vx, packed[k].vy, packed[k].vz) == v);
        CHECK(packed[k].radius == particles.radius[p]);
        CHECK(packed[k].material == particles.material[p]);
        CHECK(packed[k].id == particles.id[p]);
        CHECK(packedFloat.particles[k].x == std::nearbyint(x.x() / kUnit));
        CHECK(packedFloat.particles[k].y == std::nearbyint(x.y() / kUnit));
        CHECK(packedFloat.particles[k].z == std::nearbyint(x.z() / kUnit));
        CHECK(packedFloat.particles[k].vx == static_cast<float>(v.x()));
        CHECK(packedFloat.particles[k].vy == static_cast<float>(v.y()));
        CHECK(packedFloat.particles[k].vz == static_cast<float>(v.z()));
        CHECK(packedFloat.particles[k].radius == static_cast<float>(particles.radius[p]));
        CHECK(packedFloat.particles[k].material == particles.material[p]);
        CHECK(packedFloat.id(k) == particles.id[p]);
    }
}

TEST_CASE("Kick and drift have the bits of a plain loop on every instruction set", "[simd]") {
    const Particles before = clouds::strewnUnequal(103, 2.0);
    std::vector<Vec3> forces;
    for (std::uint64_t p = 0; p < before.count(); ++p) forces.push_back(10.0 * clouds::randomVector(51, p));
    for (const bool hasWeight : {false, true}) {
        const KickDrift step{
            .h = 0.003, .decay = 0.97, .gravity = Vec3(0.1, -9.8, 0.2), .forces = forces, .hasWeight = hasWeight};
        Particles expected = before;
        for (std::size_t p = 0; p < before.count(); ++p) {
            Vec3 force = forces[p];
            if (!hasWeight) force += before.mass[p] * step.gravity;
            expected.velocity[p] = step.decay * (before.velocity[p] + step.h / before.mass[p] * force);
            expected.position[p] = before.position[p] + step.h * expected.velocity[p];
        }
        for (const std::string& name : instructionSets()) {
            const OnInstructionSet only(name);
            for (const std::size_t split : {0U, 1U, 50U, 102U}) {
                Particles actual = before;
                const bool isFirstValid = kickAndDrift(step, 0, split, actual);
                const bool isSecondValid = kickAndDrift(step, split, before.count(), actual);
                INFO(name << ", split at " << split);
                CHECK((isFirstValid && isSecondValid));
                CHECK(actual.velocity == expected.velocity);
                CHECK(actual.position == expected.position);
            }
        }
    }
}

TEST_CASE("Kick and drift report particles that are not valid", "[simd]") {
    constexpr std::size_t kCount = 11;  // some in full vectors, some in the remainder
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec3> none(kCount, Vec3::Zero());
    const auto areValid = [&](double h, const std::vector<Vec3>& forces, Particles particles) {
        return kickAndDrift({.h = h, .forces = forces}, 0, kCount, particles);
    };
    const Particles sound = clouds::strewn(kCount, 1.0);
    for (const std::string& name : instructionSets()) {
        const OnInstructionSet only(name);
        CHECK(areValid(1e-3, none, sound));
        for (std::size_t p = 0; p < kCount; ++p)
            for (Eigen::Index axis = 0; axis < 3; ++axis) {
                INFO(name << ", particle " << p << ", axis " << axis);
                std::vector<Vec3> forces = none;
                forces[p][axis] = kNan;
                CHECK_FALSE(areValid(1e-3, forces, sound));
                Particles far = sound;
                far.position[p][axis] = -1.1 * kWorldLimit;
                CHECK_FALSE(areValid(1e-3, none, far));
                Particles fast = sound;
                fast.velocity[p][axis] = 2.0 * kFastest;
                CHECK_FALSE(areValid(1e-160, none, fast));  // so short a step that its position stays valid
            }
    }
}

TEST_CASE("External forces have the bits of weight and contacts one by one on every instruction set", "[simd]") {
    Particles particles = clouds::strewnUnequal(1003, 1.0);
    ForceField field;
    field.gravity = Vec3(0.3, -9.8, 0.1);
    field.obstacles.law = {.radius = 0.4, .repulsion = 9.0, .dampingFactor = 4.0, .coreFraction = 0.3};
    const Sphere sphere{Vec3(0.1, -0.2, 0.3), 0.4};
    particles.position[4] = sphere.center;
    // One wall at a distance of exactly the first particle's radius, and one an ulp nearer: both differences are exact.
    particles.position[0].x() = 0.25;
    particles.radius[0] = 0.125;
    constexpr double away = 0.125;
    const std::vector<Obstacle> shapes = {Plane{Vec3(0.2, -0.5, 0), Vec3(1, 2, -3).normalized()},
                                          Plane{Vec3(away, 0, 0), Vec3::UnitX()},
                                          Plane{Vec3(std::nextafter(away, 1.0), 0, 0), Vec3::UnitX()},
                                          Container{Vec3(-0.9, -0.8, -0.7), Vec3(0.9, 1.1, 0.6)},
                                          Box{Vec3(-0.6, -0.5, -0.4), Vec3(-0.1, 0.3, 0.5)},
                                          sphere,
                                          Sphere{Vec3(-0.7, 0.7, 0), 0.3, true},
                                          Sphere{Vec3(50, 0, 0), 1.0}};
    const std::size_t far = shapes.size() - 1;
    for (const char* second : {"powder", "sand"}) {  // without friction, and with
        field.materials = {*materialPreset("liquid"), *materialPreset(second)};
        for (std::uint32_t p = 0; p < particles.count(); ++p) particles.material[p] = p % 3 == 0 ? 1 : 0;
        for (std::size_t shape = 0; shape <= shapes.size(); ++shape) {  // each alone, then all
            field.obstacles.shapes = shape < shapes.size() ? std::vector{shapes[shape]} : shapes;
            std::vector<Vec3> before;
            for (std::uint64_t p = 0; p < particles.count(); ++p) before.push_back(clouds::randomVector(53, p));
            std::vector<Vec3> expected = before;
            std::size_t touched = 0;
            for (std::size_t p = 0; p < particles.count(); ++p) {
                const Material& material = field.materials[particles.material[p]];
                const Vec3 contact =
                    sumContacts(field.obstacles, {particles.position[p], particles.velocity[p], particles.radius[p],
                                                  material.dampingReach, material.friction})
                        .force;
                expected[p] += particles.mass[p] * field.gravity;
                expected[p] += contact;
                if (contact != Vec3::Zero()) ++touched;
            }
            CHECK((shape == far ? touched == 0 : touched > 20));
            for (const std::string& name : instructionSets()) {
                const OnInstructionSet only(name);
                for (const std::size_t split : {0U, 501U}) {
                    std::vector<Vec3> actual = before;
                    addExternalForces(field, particles, particles.velocity, 0, split, actual);
                    addExternalForces(field, particles, particles.velocity, split, particles.count(), actual);
                    INFO(second << ", shape " << shape << ", " << name << ", split at " << split);
                    CHECK(std::memcmp(actual.data(), expected.data(), actual.size() * sizeof(Vec3)) == 0);
                }
            }
        }
    }
}

TEST_CASE("A step has the same bits with an obstacle out of reach as without obstacles", "[simd]") {
    for (const char* preset : {"liquid", "solid"}) {
        std::string hashes[2];
        for (const bool hasPlane : {false, true}) {
            Setup setup = runs::freeSetup(*materialPreset(preset), StepperKind::symplecticEuler, 0.002);
            setup.gravity = Vec3(0.3, -9.8, 0);
            setup.drag = 0.5;
            if (hasPlane) setup.obstacles.shapes = {Plane{Vec3(0, -1000, 0), Vec3::UnitY()}};
            runs::addPacking(setup, {7, 6, 9});
            Simulation simulation = start(setup);
            advance(simulation, 0.06);
            hashes[hasPlane ? 1 : 0] = stateHash(simulation.particles);
        }
        CHECK(hashes[0] == hashes[1]);
    }
}

TEST_CASE("In double, forces have the bits of the scalar kernel", "[simd]") {
    for (Material material : materialPresets()) {
        ForceField field = clouds::forceFieldOf(material);
        ForceEvaluator lanes(field, ForceMethod::grid);
        const Particles particles = block(material, Vec3(1.0, 2.0, 3.0));
        REQUIRE(termsFor(field, particles).uniform());
        // A second material, which no particle has, rules out the SIMD kernel.
        material.repulsion *= 2.0;
        field.materials.push_back(material);
        ForceEvaluator scalar(field, ForceMethod::grid);
        REQUIRE_FALSE(termsFor(field, particles).uniform());
        std::vector<Vec3> actual;
        std::vector<Vec3> expected;
        lanes.evaluatePairs(particles, particles.velocity, actual);
        scalar.evaluatePairs(particles, particles.velocity, expected);
        INFO(material.name);
        CHECK(actual == expected);
        const double energy = lanes.evaluateFree(particles, particles.velocity, actual);
        CHECK(energy != 0.0);
        CHECK_THAT(energy,
                   Catch::Matchers::WithinRel(scalar.evaluateFree(particles, particles.velocity, expected), 1e-13));
    }
}

TEST_CASE("In float, forces differ by float roundings, near the origin and far from it", "[simd]") {
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

TEST_CASE("Coincident particles are separated in float as in double, and near ones are not", "[simd]") {
    // The unit of float coordinates is 2^-23 of the list's reach, at most 8e-8 m.
    const double apart = GENERATE(0.0, 1e-13, 1e-10, 1e-6);
    for (const char* preset : {"powder", "solid", "sand"}) {
        const Material material = *materialPreset(preset);
        Particles particles = block(material, Vec3::Zero());
        particles.position[17] = particles.position[16] + Vec3(0, apart, 0);
        const std::vector<Vec3> doubles = pairForces(material, particles, Precision::doubles);
        const std::vector<Vec3> packedFloat = pairForces(material, particles, Precision::singles);
        INFO(preset << ", " << apart << " m apart");
        CHECK(doubles[17].norm() > 0.0);
        const double slope = pairCoefficient<PairTerms{true, false}>(0.0, 0.0, pairConstants<double>(material, 0.3));
        // Both positions are rounded to half a unit, which may reverse the friction; the force along the stand-in for P
        // would be kCoincidentShare 0.3 m slope.
        const double rounding = apart > 0.0 ? slope * (8e-8 + 2.0 * material.friction * apart) : 0.0;
        const double tolerance = 1e-5 * doubles[17].norm() + rounding;
        CHECK((packedFloat[17] - doubles[17]).norm() < tolerance);
        CHECK((packedFloat[16] - doubles[16]).norm() < tolerance);
    }
}

TEST_CASE("In float, forces and energies need no particles packed in double", "[simd]") {
    const Material material = *materialPreset("solid");
    Particles particles = block(material, Vec3::Zero());
    particles.position[17] = particles.position[16];
    const ForceField field = clouds::forceFieldOf(material);
    PairTraversal pairs(field, Precision::singles);
    std::vector<Vec3> forces(particles.count());
    double energy = 0.0;
    pairs.prepare(field, particles, particles.velocity);
    sumPairs(pairs, {.forces = forces, .energy = &energy});
    CHECK(!pairs.isPacked);
    CHECK_THAT(energy,
               Catch::Matchers::WithinRel(pairEnergyReference(field, particles), 1e-5));  // some roundings of float
    std::vector<Vec3> alone(particles.count());
    sumPairs(pairs, {.forces = alone});
    CHECK(alone == forces);
}
