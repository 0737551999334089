// The simulation: a set-up (what the scene says), a state, and the step between. Callers ask for a point in time and
// get there exactly; everything the step does can be read in simulation.cpp on one screen.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "engine/colliders.h"
#include "engine/emitters.h"
#include "engine/forces.h"
#include "engine/material.h"
#include "engine/particles.h"

namespace engine {

enum class StepperKind {
    symplecticEuler,   ///< equations 7 and 8 as printed
    velocityVerlet,    ///< second order; damping from the predicted velocity
    implicitDamping,   ///< second order; damping by the implicit midpoint rule
    linearlyImplicit,  ///< second order; damping and stiffness by the linearised implicit midpoint rule
    automatic          ///< whichever of the second-order ones is cheapest at the wanted error
};

/// Everything the scene says about the motion.
struct Setup {
    std::vector<Material> materials = {Material{}};
    Vec3 gravity = Vec3(0.0, -9.8, 0.0);  ///< m/s^2
    double drag = 0.0;                    ///< k, 1/s: free motion decays like exp(-k t)
    Scenery scenery;
    std::vector<Emitter> emitters;
    Particles initial;  ///< at time zero
    StepperKind stepper = StepperKind::velocityVerlet;
    double step = 0.01;             ///< longest step, s; a frame is divided evenly; not used by the automatic stepper
    double error = 1e-2;            ///< wanted position error of the automatic stepper, radii per second of motion
    double solverTolerance = 1e-4;  ///< of the implicit steppers: residual over right-hand side
    ForceMethod forces = ForceMethod::grid;
    std::uint64_t seed = 1;
};

/// What the steps of a run looked like.
struct StepStatistics {
    std::uint64_t count = 0;
    double shortest = 0.0;               ///< s
    double longest = 0.0;                ///< s
    std::uint64_t forceEvaluations = 0;  ///< passes over all pairs
    std::uint64_t products = 0;          ///< of the implicit steppers' matrix with a vector
    std::uint64_t rejected = 0;          ///< steps taken back and retried at half the length
};

struct Simulation {
    Setup setup;
    ForceEvaluator evaluator;
    Particles particles;
    std::vector<EmitterState> emitters;
    double time = 0.0;         ///< s
    std::vector<Vec3> forces;  ///< on each particle, N; while forcesCurrent those that the next step starts with
    bool forcesCurrent = false;
    std::vector<Vec3> predictedVelocities;  ///< scratch of velocity Verlet, m/s
    StepStatistics steps;
};

/// The run left the finite numbers. what() names time, step, particle, position, speed, step size and what to change.
class InstabilityError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A position further out than this counts as lost, m: beyond it the cell grid and float pictures lose their meaning.
inline constexpr double kWorldLimit = 1e8;

/// A simulation at time zero, with the births that are due then.
Simulation start(const Setup& setup);

/// Brings the simulation to the given time, which is hit exactly, in equal steps no longer than the set-up's.
/// Throws InstabilityError when a particle is no longer finite or has left the world.
void advance(Simulation& simulation, double time);

/// Births that have happened and births that had to wait, over all emitters.
std::uint64_t birthCount(const Simulation& simulation);
std::uint64_t refusalCount(const Simulation& simulation);

}  // namespace engine
