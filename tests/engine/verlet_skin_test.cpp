// The skin of the neighbor list follows the motion, and the forces do not depend on it. What it gains is measured by
// `globular bench`.
#include "engine/neighbors/neighbor_list.h"

#include "tests/catch.h"

#include "engine/run/diagnostics.h"
#include "engine/stepping/step_cache.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// A packing of grains whose two halves move apart, each at a speed (m/s), after 0.1 s in steps of `step` (s).
Simulation parting(double speed, double step, ForceMethod method) {
    Setup setup = runs::freeSetup(*materialPreset("powder"), StepperKind::velocityVerlet, step);
    runs::addPacking(setup, {6, 6, 6});
    Vec3 sum = Vec3::Zero();
    for (const Vec3& position : setup.initial.position) sum += position;
    const double middle = sum.x() / static_cast<double>(setup.initial.count());
    for (std::size_t p = 0; p < setup.initial.count(); ++p)
        setup.initial.velocity[p].x() += setup.initial.position[p].x() < middle ? -speed : speed;
    setup.forces = method;
    Simulation simulation = start(setup);
    advance(simulation, 0.1);
    return simulation;
}

double skinOf(const Simulation& simulation) {
    const double cutoff = termsFor(simulation.cache->evaluator.forceField(), simulation.particles).cutoff;
    return simulation.cache->evaluator.list().reach() / cutoff - 1.0;
}

}  // namespace

TEST_CASE("The skin is narrow where a list serves for long and where no skin would help", "[verlet-skin]") {
    CHECK(optimalSkin(45.0, 0.0) < 0.05);
    CHECK(optimalSkin(45.0, 1e-4) < 0.05);
    CHECK(optimalSkin(45.0, 5.0) < 0.05);
}

TEST_CASE("The skin is wider for fast particles and for few neighbors", "[verlet-skin]") {
    double before = optimalSkin(45.0, 1e-5);
    for (const double way : {1e-3, 5e-3, 0.02, 0.03}) {
        const double skin = optimalSkin(45.0, way);
        CHECK(skin >= before);
        before = skin;
    }
    CHECK(before > 0.1);
    CHECK(optimalSkin(5.0, 0.03) > optimalSkin(45.0, 0.03));
}

TEST_CASE("A run's skins fit the displacements of its steps, and its forces are those of every pair", "[verlet-skin]") {
    CHECK(skinOf(parting(0.1, 1e-5, ForceMethod::grid)) < kDefaultSkin);
    const Simulation fast = parting(8.0, 0.002, ForceMethod::grid);
    CHECK(skinOf(fast) > 2.0 * kDefaultSkin);
    const Simulation expected = parting(8.0, 0.002, ForceMethod::reference);
    for (std::size_t p = 0; p < fast.particles.count(); ++p)  // some thousand roundings of positions of about 1 m
        CHECK((fast.particles.position[p] - expected.particles.position[p]).norm() < 1e-12);
}
