// Whole runs that several suites of the engine start from, and the distance between two of them.
#pragma once

#include <cmath>

#include "engine/run/advance.h"
#include "engine/state/bodies.h"
#include "engine/state/emitter_sites.h"
#include "engine/stepping/take_step.h"
#include "tests/engine/clouds.h"

namespace runs {

inline constexpr double kFrame = 1.0 / 30.0;  // s

/// Advances the simulation frame by frame.
inline void advanceFrames(engine::Simulation& simulation, int from, int to) {
    for (int frame = from + 1; frame <= to; ++frame) engine::advance(simulation, frame * kFrame);
}

/// A set-up of one material without gravity, drag and obstacles; step in seconds.
inline engine::Setup freeSetup(const engine::Material& material, engine::StepperKind stepper, double step) {
    engine::Setup setup;
    setup.materials = {material};
    setup.gravity = engine::Vec3::Zero();
    setup.stepper = stepper;
    setup.step = step;
    return setup;
}

/// Liquid of 0.1 kg with a hundred times Table 1's damping.
inline engine::Material honey() {
    engine::Material material = *engine::materialPreset("liquid");
    material.mass = 0.1;
    material.damping = 100.0;
    return material;
}

/// Adds a jittered cubic block whose particles move at up to 1 m/s along each axis. No pair is as close as the core,
/// whose kink would hide the order of a stepper.
inline void addPacking(engine::Setup& setup, const std::array<std::uint32_t, 3>& counts) {
    for (const engine::Vec3& position : engine::gridPositions(
             engine::Vec3::Zero(), counts, {.spacing = 1.8 * setup.materials[0].radius, .jitter = 0.1}))
        append(setup.initial, {.position = position,
                               .velocity = clouds::randomVector(3, setup.initial.count()),
                               .radius = setup.materials[0].radius,
                               .mass = setup.materials[0].mass});
}

/// Two particles a distance apart (m) along x, about the origin, closing in at a speed (m/s).
inline void addPair(engine::Setup& setup, double distance, double closingSpeed) {
    for (const double side : {1.0, -1.0})
        append(setup.initial, {.position = engine::Vec3(side * 0.5 * distance, 0, 0),
                               .velocity = engine::Vec3(-side * 0.5 * closingSpeed, 0, 0),
                               .radius = setup.materials[0].radius,
                               .mass = setup.materials[0].mass});
}

/// A ball of liquid on a floor and a sphere under a nozzle: every part of the engine at once.
inline engine::Setup busyScene(engine::StepperKind stepper) {
    using namespace engine;
    Setup setup;
    Material liquid = *materialPreset("liquid");
    liquid.mass = 0.1;
    setup.materials = {liquid};
    setup.drag = 0.1;
    setup.stepper = stepper;
    setup.step = 0.002;
    for (const Vec3& position : ballPositions(Vec3(0, 1.5, 0), 0.9, {.spacing = 0.3, .jitter = 0.05}))
        append(setup.initial, {.position = position, .mass = liquid.mass});
    setup.obstacles.shapes = {Plane{}, Sphere{Vec3(0, 0.2, 0), 0.4, false}};
    Emitter emitter;
    emitter.sites = discSites(Vec3(2, 1, 0), Vec3(-3, 1, 0), 0.3, 0.3);
    emitter.velocity = Vec3(-3, 1, 0);
    emitter.interval = 0.1;
    setup.emitters = {emitter};
    return setup;
}

/// The state after `count` steps of the stepper in use, without audit, rejection or emission.
inline engine::Simulation afterSteps(const engine::Setup& setup, double duration, int count) {
    engine::Simulation simulation = engine::start(setup);
    for (int k = 0; k < count; ++k) takeStep(simulation, duration / count);
    return simulation;
}

/// Root of the mean squared distance between equal particles of two runs, m.
inline double rmsDistance(const engine::Particles& a, const engine::Particles& b) {
    double sumSq = 0.0;
    for (std::size_t p = 0; p < a.count(); ++p) sumSq += engine::squaredLength(a.position[p] - b.position[p]);
    return std::sqrt(sumSq / static_cast<double>(a.count()));
}

/// Distance of the two particles of addPair along x, m; negative once they have passed each other.
inline double gapOf(const engine::Simulation& simulation) {
    return simulation.particles.position[0].x() - simulation.particles.position[1].x();
}

}  // namespace runs
