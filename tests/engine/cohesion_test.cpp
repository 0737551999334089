// Surface tension: the pull of two particles against its closed form, the lattice that keeps its density, kernels
// against the reference, and what is conserved.
#include "tests/catch.h"

#include <array>
#include <cmath>

#include "engine/force_law/cohesion.h"
#include "engine/force_law/compression.h"
#include "engine/force_law/pair_law.h"
#include "engine/forces/forces.h"
#include "engine/obstacles/contact.h"
#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "tests/engine/clouds.h"
#include "tests/engine/rounding.h"
#include "tests/engine/runs.h"
#include "tests/engine/same_bits.h"

using namespace engine;

namespace {

Material cohesive(const char* preset, double cohesion) {
    return *withCohesion(*materialPreset(preset), cohesion);
}

/// The pull of two particles in newtons as the header has it: kappa D (1 - v) v^2 between D0 and S.
double pullOf(double kappa, double rest, double distance) {
    const double reach = kPullReach * rest;
    if (distance <= rest || distance >= reach) return 0.0;
    const double v = (reach * reach - distance * distance) / (reach * reach - rest * rest);
    return kappa * distance * (1.0 - v) * v * v;
}

}  // namespace

TEST_CASE("the pull of a pair has its closed form", "[cohesion]") {
    const Material with = cohesive("oil", 10.0);
    Material without = with;
    without.pull = 0.0;
    const double rest = 2.0 * with.radius;
    const auto c = pairConstants<double>(with, rest);
    const auto bare = pairConstants<double>(without, rest);
    for (const double ratio : {0.1, 0.5, 0.9, 1.0, 1.2, 1.7, 2.2, 2.9, 2.999, 3.0, 3.5}) {
        const double distance = ratio * rest;
        const double force = distance * pairCoefficient<kConservative>(distance * distance, 0.0, c);
        const double repulsion = distance * pairCoefficient<kConservative>(distance * distance, 0.0, bare);
        // The rounding of D^2/D0^2, up to 9, against 1 - v.
        const double tolerance = 64.0 * kEps * (std::abs(repulsion) + with.pull * rest);
        INFO("D = " << ratio << " D0");
        CHECK(std::abs(force - repulsion + pullOf(with.pull, rest, distance)) <= tolerance);
    }
}

TEST_CASE("force and stiffness with cohesion are derivatives of the energy", "[cohesion]") {
    const Material material = cohesive("honey", 20.0);
    const double rest = 2.0 * material.radius;
    const auto c = pairConstants<double>(material, rest);
    const double h = 1e-6 * rest;
    for (const double ratio : {0.15, 0.3, 0.7, 0.95, 1.05, 1.3, 1.59, 1.7, 2.0, 2.5, 2.9, 3.2}) {
        const double d = ratio * rest;
        const auto forceAt = [&](double at) { return at * pairCoefficient<kConservative>(at * at, 0.0, c); };
        const double scale = material.pull * rest + std::abs(forceAt(d));
        INFO("D = " << ratio << " D0");
        // Central differences err by h^2 f'''/6, where f''' < 1e3 f / D0^3 except at the core, and by rounding / h.
        CHECK(std::abs(forceAt(d) + (pairEnergy(d + h, c) - pairEnergy(d - h, c)) / (2 * h)) <= 1e-7 * scale);
        CHECK(std::abs(pairStiffness(d, c) + (forceAt(d + h) - forceAt(d - h)) / (2 * h)) <= 1e-6 * scale / rest);
    }
}

TEST_CASE("no pair acts at or beyond the reach of the pull", "[cohesion]") {
    const Material material = cohesive("oil", 5.0);
    for (const double restLength : {0.1, 0.16, 0.333, 1.7}) {
        const auto exact = pairConstants<double>(material, restLength);
        const auto perRestLength = atRestLength<true>(constantsPerRestLength<double>(material), restLength);
        const auto perRestLengthFloat =
            atRestLength<true>(constantsPerRestLength<float>(material), static_cast<float>(restLength));
        const double reach = kPullReach * restLength;
        CHECK(pairCoefficient<kAlongLine>(exact.cutoffSq, 0.3, exact) == 0.0);
        CHECK(pairCoefficient<kAlongLine>(reach * reach, 0.3, perRestLength) == 0.0);
        const float reachFloat = static_cast<float>(kPullReach) * static_cast<float>(restLength);
        CHECK(pairCoefficient<kAlongLine>(reachFloat * reachFloat, 0.3F, perRestLengthFloat) == 0.0F);
        CHECK(pairEnergy(reach * 1.0001, exact) == 0.0);
    }
}

TEST_CASE("a material with cohesion keeps its density", "[cohesion]") {
    for (const char* preset : {"oil", "honey", "lava", "mud", "molten-metal", "liquid", "sand"})
        for (const double cohesion : {0.01, 1.0, 50.0})
            for (const double factor : {1.0, 0.5}) {
                const Material plain = withRadius(*materialPreset(preset), factor * materialPreset(preset)->radius);
                const Material material = *withCohesion(plain, cohesion);
                INFO(preset << ", " << cohesion << " N/m, radius " << material.radius);
                // Intervals are halved to rounding, and a spacing of the balance is as exact as the balance.
                CHECK(restSpacing(material) == Approx(2.0 * material.radius).epsilon(1e-9));
                CHECK(material.repulsion >= plain.repulsion);
                CHECK((material.restRatio > 1.0) == (material.pull > 0.0));
                CHECK(material.mass == plain.mass);
                // The attraction of c_r alone makes a tension, too.
                CHECK(surfaceTension(material) == Approx(std::max(cohesion, surfaceTension(plain))).epsilon(1e-6));
            }
}

TEST_CASE("without cohesion a material stays as it is", "[cohesion]") {
    for (const Material& preset : materialPresets()) {
        const Material material = *withCohesion(preset, 0.0);
        CHECK(material.repulsion == preset.repulsion);
        CHECK(material.restRatio == 1.0);
        CHECK(material.pull == 0.0);
    }
    CHECK_FALSE(withCohesion(*materialPreset("solid"), 1.0).has_value());  // c_r = 2
}

TEST_CASE("b1 is chosen for a compression with cohesion", "[cohesion]") {
    Material material = cohesive("oil", 10.0);
    const Column column{.height = 1.5, .spacing = 2.0 * material.radius, .gravity = 9.8};
    const double share = 0.95;
    const auto repulsion = repulsionForShare(material, column, share);
    REQUIRE(repulsion);
    material.repulsion = *repulsion;
    const Material chosen = *withCohesion(material, 10.0);
    CHECK(settledShare(chosen, column) == Approx(share).margin(1e-4));  // b1 is right to a millionth
}

TEST_CASE("kernels with cohesion agree with the reference", "[cohesion]") {
    // One law and one radius, several laws, several radii, with and without friction, in both precisions.
    for (const bool hasFriction : {false, true})
        for (const bool hasLaws : {false, true})
            for (const bool hasRadii : {false, true})
                for (const Precision precision : {Precision::doubles, Precision::singles}) {
                    ForceField field;
                    field.materials = {cohesive("oil", 10.0)};
                    if (hasLaws) field.materials.push_back(*materialPreset("honey"));
                    if (hasLaws) field.materials.push_back(cohesive("molten-metal", 25.0));
                    for (Material& material : field.materials) material.friction = hasFriction ? 0.2 : 0.0;
                    Particles particles;
                    for (std::uint32_t k = 0; k < 400; ++k) {
                        const double radius = hasRadii ? 0.08 * (1.0 + 0.3 * clouds::randomVector(3, k).x()) : 0.08;
                        append(particles, {.position = 0.6 * clouds::randomVector(1, k),
                                           .velocity = clouds::randomVector(2, k),
                                           .radius = radius,
                                           .mass = 0.05,
                                           .material = static_cast<std::uint32_t>(k % field.materials.size())});
                    }
                    ForceEvaluator exact(field, ForceMethod::reference);
                    ForceEvaluator fast(field, ForceMethod::grid, precision);
                    std::vector<Vec3> expected, forces;
                    const double energy = exact.evaluateFree(particles, particles.velocity, expected);
                    const double fastEnergy = fast.evaluateFree(particles, particles.velocity, forces);
                    double largest = 0.0;
                    for (const Vec3& force : expected) largest = std::max(largest, force.norm());
                    // Hundreds of neighbors, each rounded a few tens of times.
                    const double rounding = precision == Precision::doubles ? 1e-12 : 2e-5;
                    INFO("friction " << hasFriction << " laws " << hasLaws << " radii " << hasRadii);
                    for (std::size_t p = 0; p < forces.size(); ++p)
                        REQUIRE((forces[p] - expected[p]).norm() <= rounding * largest);
                    CHECK(fastEnergy == Approx(energy).epsilon(rounding));
                }
}

TEST_CASE("cohesion keeps momentum and angular momentum", "[cohesion]") {
    ForceField field;
    field.materials = {cohesive("oil", 10.0)};
    field.materials.front().damping = 0.0;
    Particles particles;
    for (std::uint32_t k = 0; k < 300; ++k)
        append(particles, {.position = clouds::randomVector(1, k), .radius = 0.08, .mass = 0.05});
    ForceEvaluator evaluator(field, ForceMethod::grid);
    std::vector<Vec3> forces;
    evaluator.evaluateFree(particles, particles.velocity, forces);
    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
    double size = 0.0;
    for (std::size_t p = 0; p < forces.size(); ++p) {
        force += forces[p];
        torque += particles.position[p].cross(forces[p]);
        size += forces[p].norm();
    }
    CHECK(force.norm() <= 1e3 * kEps * size);   // 300 particles, some roundings each
    CHECK(torque.norm() <= 1e3 * kEps * size);  // positions are up to 1.7 m from the origin
}

TEST_CASE("the pull of a wetted surface is the derivative of its energy", "[cohesion]") {
    Obstacles obstacles;
    obstacles.wall = WallLaw::scaled;
    obstacles.shapes = {Plane{}};
    obstacles.surfaces = {{.wetting = 1.5}};
    const double radius = 0.08;
    const auto contactAt = [&](double height) {
        const Probe probe{
            .position = height * Vec3::UnitY(), .radius = radius, .mass = 0.05, .repulsion = 0.0015, .cohesion = 10.0};
        return sumContacts(obstacles, probe);
    };
    const double h = 1e-6 * radius;
    const double largest = std::abs(contactAt(1.001 * radius).force.y());
    CHECK(contactAt(1.001 * radius).force.y() < 0.0);
    for (const double ratio : {0.6, 0.95, 1.1, 2.0, 3.0, 4.0, 4.9, 5.5}) {
        const double height = ratio * radius;
        const double slope = (contactAt(height + h).energy - contactAt(height - h).energy) / (2.0 * h);
        INFO("height " << ratio << " radii");
        // Central differences err by 1e-12 of the force, and by the rounding of the energy over h.
        CHECK(std::abs(contactAt(height).force.y() + slope) <= 1e-7 * largest);
    }
    CHECK(contactAt(kWettingReach * radius).force.y() == 0.0);
    // Parting the first three layers of closest packing takes sigma (1 + cos theta) on a unit of area.
    double work = 0.0;
    for (int layer = 0; layer < 3; ++layer)
        work -= contactAt((1.0 + 2.0 * layer * std::sqrt(2.0 / 3.0)) * radius).energy;
    CHECK(work / (2.0 * std::sqrt(3.0) * radius * radius) == Approx(15.0).epsilon(1e-3));  // 0.652 has three digits
}

namespace {

/// A ball of oil that falls onto a plane that it wets, and another liquid, without cohesion, beside it.
Setup dropOnPlane(StepperKind stepper, Precision precision) {
    Setup setup;
    setup.materials = {cohesive("oil", 10.0), *materialPreset("oil")};
    setup.stepper = stepper;
    setup.precision = precision;
    setup.step = 0.002;
    setup.obstacles.wall = WallLaw::scaled;
    setup.obstacles.gravity = 9.8;
    setup.obstacles.shapes = {Plane{}};
    setup.obstacles.surfaces.resize(1);
    setup.obstacles.surfaces[0].wetting = 1.5;
    const Material& oil = setup.materials[0];
    for (const Vec3& position : ballPositions(Vec3(0, 0.65, 0), 0.5, {.spacing = 2.0 * oil.radius, .jitter = 0.05}))
        append(
            setup.initial,
            {.position = position, .radius = oil.radius, .mass = oil.mass, .material = position.x() > 0.2 ? 1U : 0U});
    return setup;
}

}  // namespace

TEST_CASE("a run with cohesion has the same bits on any instruction set, ranks and after a resume", "[cohesion]") {
    constexpr int kFrames = 6;
    for (const StepperKind stepper : {StepperKind::leapfrog, StepperKind::linearlyImplicit, StepperKind::automatic})
        for (const Precision precision : {Precision::doubles, Precision::singles}) {
            INFO(nameOf(stepper) << ", precision " << static_cast<int>(precision));
            const Setup setup = dropOnPlane(stepper, precision);
            same_bits::checkEverywhere(setup, kFrames);
        }
}

TEST_CASE("without damping, a drop with cohesion keeps its energy", "[cohesion]") {
    Setup setup = dropOnPlane(StepperKind::velocityVerlet, Precision::doubles);
    setup.gravity = Vec3::Zero();
    setup.obstacles = {};
    for (Material& material : setup.materials) material.damping = 0.0;
    for (std::size_t p = 0; p < setup.initial.count(); ++p)
        setup.initial.velocity[p] = 0.3 * clouds::randomVector(5, p);
    const auto largestDrift = [&](double step) {
        setup.step = step;
        Simulation simulation = start(setup);
        const double before = energy(simulation).total();
        double largest = 0.0;
        for (int frame = 1; frame <= 60; ++frame) {
            advance(simulation, frame * runs::kFrame);
            largest = std::max(largest, std::abs(energy(simulation).total() - before));
        }
        CHECK(simulation.steps.rejected == 0);
        return largest / energy(simulation).kinetic;
    };
    const double coarse = largestDrift(0.002);
    CHECK(coarse < 0.01);
    CHECK(largestDrift(0.001) < 0.4 * coarse);  // of second order
}
