// Random motion: its energy, what the impulses keep, the audit, and the bits of a run that has it.
#include "tests/catch.h"

#include <cmath>

#include "engine/force_law/cohesion.h"
#include "engine/heat/agitation.h"
#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "tests/engine/clouds.h"
#include "tests/engine/runs.h"
#include "tests/engine/same_bits.h"

using namespace engine;

namespace {

Material agitated(double agitation) {
    Material material = *withCohesion(*materialPreset("oil"), 10.0);
    material.agitation = agitation;
    return material;
}

/// A drop without gravity, which starts as a grid.
Setup dropOf(const Material& material, std::uint32_t across, StepperKind stepper = StepperKind::velocityVerlet) {
    Setup setup = runs::freeSetup(material, stepper, 0.004);
    setup.agitationInterval = runs::kFrame / std::ceil(runs::kFrame / agitationInterval(material));
    const double spacing = 2.0 * material.radius / std::pow(2.0, 1.0 / 6.0);  // of the density at rest
    for (const Vec3& position :
         gridPositions(Vec3::Zero(), {across, across, across}, {.spacing = spacing, .jitter = 0.1}))
        append(setup.initial, {.position = position, .radius = material.radius, .mass = material.mass});
    return setup;
}

double kineticOf(const Particles& particles) {
    double sum = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p)
        sum += 0.5 * particles.mass[p] * squaredLength(particles.velocity[p]);
    return sum;
}

}  // namespace

TEST_CASE("particles keep the energy of their random motion, whatever their damping", "[agitation][long]") {
    for (const double damping : {0.1, 0.25, 1.0}) {
        Material material = agitated(0.05);
        material.damping = damping;
        const Setup setup = dropOf(material, 6);
        Simulation simulation = start(setup);
        double kinetic = 0.0;
        int samples = 0;
        const double step = setup.agitationInterval / 4.0;
        for (int k = 1; k <= 2400; ++k) {
            advance(simulation, k * step);
            if (k <= 800) continue;  // the grid has become a drop
            kinetic += kineticOf(simulation.particles);
            ++samples;
        }
        // No energy is in the motion of the center of mass, nor in rotation as a whole: six of 3 N degrees of freedom.
        const auto count = static_cast<double>(setup.initial.count());
        const double expected = 0.5 * (3.0 * count - 6.0) * agitationEnergy(material);
        INFO("bd = " << damping);
        // Four samples an interval take the mean of a decay from 1 to 0.61 to 3 %, as the last is before the impulses.
        CHECK(kinetic / samples == Approx(expected).epsilon(0.08));
    }
}

TEST_CASE("agitation keeps momentum and angular momentum", "[agitation][threads]") {
    const Setup setup = dropOf(agitated(0.1), 6);
    Simulation simulation = start(setup);
    simulation.time = setup.agitationInterval;
    agitateDue(simulation);
    Vec3 momentum = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
    double size = 0.0;
    const Particles& particles = simulation.particles;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        momentum += particles.mass[p] * particles.velocity[p];
        angular += particles.mass[p] * particles.position[p].cross(particles.velocity[p]);
        size += particles.mass[p] * particles.velocity[p].norm();
    }
    CHECK(size > 0.0);
    CHECK(momentum.norm() <= 1e-13 * size);  // some roundings of each of 216 particles
    CHECK(angular.norm() <= 1e-13 * size);   // about a point within 0.5 m
    CHECK(simulation.agitation.count == 1);
    CHECK(simulation.agitation.work == Approx(kineticOf(particles)).epsilon(1e-12));
}

TEST_CASE("random impulses have the variance that damping asks for", "[agitation]") {
    // Two particles at a distance D: the impulse along the line between them has the variance 2 b_d s_d E dt.
    Material material = agitated(0.05);
    const double distance = 1.3 * 2.0 * material.radius;
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 0.004);
    setup.agitationInterval = agitationInterval(material);
    runs::addPair(setup, distance, 0.0);
    Simulation simulation = start(setup);
    double squares = 0.0;
    double largest = 0.0;
    constexpr int kCount = 20000;
    for (int k = 1; k <= kCount; ++k) {
        simulation.time = k * setup.agitationInterval;
        agitateDue(simulation);
        const double impulse = material.mass * simulation.particles.velocity[0].x();
        squares += impulse * impulse;
        largest = std::max(largest, std::abs(impulse));
        CHECK(simulation.particles.velocity[0].y() == 0.0);
        for (Vec3& velocity : simulation.particles.velocity) velocity = Vec3::Zero();
    }
    const double ratio = 1.3 / material.dampingReach;
    const double variance =
        2.0 * material.damping * (1.0 - ratio * ratio) * agitationEnergy(material) * setup.agitationInterval;
    CHECK(squares / kCount == Approx(variance).epsilon(0.03));  // of 20,000 uniform numbers: 0.6 %
    CHECK(largest <= std::sqrt(3.0 * variance) * (1.0 + 1e-12));
    CHECK(largest > 1.7 * std::sqrt(variance));
}

TEST_CASE("a material without random motion gets no impulses from one that has it", "[agitation]") {
    Setup setup = dropOf(agitated(0.05), 5);
    setup.materials.push_back(agitated(0.0));
    for (std::size_t p = 0; p < setup.initial.count(); ++p) setup.initial.material[p] = p % 2;
    Simulation simulation = start(setup);
    simulation.time = setup.agitationInterval;
    agitateDue(simulation);
    for (std::size_t p = 0; p < setup.initial.count(); ++p)
        CHECK((simulation.particles.velocity[p].norm() > 0.0) == (p % 2 == 0));
}

TEST_CASE("the audit counts the work of agitation", "[agitation]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                                      StepperKind::linearlyImplicit}) {
        INFO(nameOf(stepper));
        Setup setup = dropOf(agitated(0.1), 6, stepper);
        setup.step = 0.002;
        Simulation simulation = start(setup);
        runs::advanceFrames(simulation, 0, 10);
        const double before = energy(simulation).total() - simulation.agitation.work;
        runs::advanceFrames(simulation, 10, 40);
        // Damping has taken about as much as the impulses have given.
        const double taken = before - (energy(simulation).total() - simulation.agitation.work);
        CHECK(taken > 0.0);
        CHECK(simulation.agitation.work > 10.0 * kineticOf(simulation.particles));
        CHECK(simulation.steps.rejected <= simulation.steps.count / 50);
    }
}

TEST_CASE("a run with agitation has the same bits on any instruction set, ranks and after a resume", "[agitation]") {
    constexpr int kFrames = 4;
    for (const StepperKind stepper : {StepperKind::leapfrog, StepperKind::automatic, StepperKind::symplecticEuler}) {
        INFO(nameOf(stepper));
        Setup setup = dropOf(agitated(0.05), 8, stepper);
        setup.materials.push_back(*materialPreset("honey"));
        for (std::size_t p = 0; p < setup.initial.count(); ++p) setup.initial.material[p] = p % 7 == 0 ? 1 : 0;
        same_bits::checkEverywhere(setup, kFrames);
    }
}

TEST_CASE("another seed gives other random impulses", "[agitation]") {
    Setup setup = dropOf(agitated(0.05), 4);
    const std::string first = same_bits::hashAfter(start(setup), 0, 1);
    CHECK(same_bits::hashAfter(start(setup), 0, 1) == first);
    setup.seed = 2;
    CHECK(same_bits::hashAfter(start(setup), 0, 1) != first);
}
