// The simulation: a set-up (what the scene says), a state, and the step between. Callers ask for a point in time and
// get there exactly; how it gets there is advance() in simulation.cpp and, step by step, audited_steps.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/scratch.h"
#include "engine/forces/conjugate_gradient.h"
#include "engine/forces/forces.h"
#include "engine/law/material.h"
#include "engine/law/obstacles.h"
#include "engine/state/particles.h"
#include "engine/stepping/emitters.h"

namespace engine {

enum class StepperKind {
    symplecticEuler,   ///< equations 7 and 8 as printed
    velocityVerlet,    ///< second order; damping from the predicted velocity
    leapfrog,          ///< the same with damping from the velocity in the middle: order 1, for longer steps
    implicitDamping,   ///< second order; damping by the implicit midpoint rule
    linearlyImplicit,  ///< second order; damping and stiffness by the linearized implicit midpoint rule
    automatic          ///< whichever but the paper's is cheapest at the wanted error
};

/// The automatic one, the last, is never in use.
inline constexpr std::size_t kStepperKinds = static_cast<std::size_t>(StepperKind::automatic);

/// Whether it is a form of velocity Verlet: no system to solve, and the energy is known at a step's end.
constexpr bool isVerlet(StepperKind stepper) {
    return stepper == StepperKind::velocityVerlet || stepper == StepperKind::leapfrog;
}

/// A box with faces along the axes, m; infinite where it is open.
struct Bounds {
    Vec3 minimum = Vec3::Constant(-std::numeric_limits<double>::infinity());
    Vec3 maximum = Vec3::Constant(std::numeric_limits<double>::infinity());
};

/// A face belongs to the box.
inline bool contains(const Bounds& box, const Vec3& position) {
    return (position.array() >= box.minimum.array()).all() && (position.array() <= box.maximum.array()).all();
}

/// Everything the scene says about the motion.
struct Setup {
    std::vector<Material> materials = {Material{}};
    Vec3 gravity = Vec3(0.0, -9.8, 0.0);  ///< m/s^2
    double drag = 0.0;                    ///< k, 1/s: free motion decays like exp(-k t)
    Scenery scenery;
    std::optional<Bounds> world;  ///< a particle beyond leaves the run
    std::vector<Emitter> emitters;
    Particles initial;  ///< at time zero
    StepperKind stepper = StepperKind::velocityVerlet;
    double step = 0.01;             ///< longest step, s; a frame is divided evenly; not used by the automatic stepper
    double error = 1e-2;            ///< wanted position error of the automatic stepper, radii per second of motion
    double solverTolerance = 1e-4;  ///< of the implicit steppers: residual over right-hand side
    ForceMethod forces = ForceMethod::grid;
    Precision precision = Precision::doubles;  ///< of pair forces between particles of one material and radius
    std::uint64_t seed = 1;
};

/// What kept a step from being longer.
enum class StepLimit {
    given,         ///< the scene's fixed step
    error,         ///< the wanted error
    displacement,  ///< a particle may not move further than its radius in one step
    audit,         ///< a longer step gained energy
    frame          ///< the interval that was asked for, e.g. one frame
};
inline constexpr std::size_t kStepLimits = 5;

/// Whether a value read from outside is one of the limits.
constexpr bool isLimit(StepLimit limit) {
    return static_cast<std::size_t>(limit) < kStepLimits;
}

/// What the steps of a run looked like.
struct StepStatistics {
    std::uint64_t count = 0;
    double shortest = 0.0;                               ///< s
    double longest = 0.0;                                ///< s
    std::uint64_t forceEvaluations = 0;                  ///< passes over all pairs
    std::uint64_t products = 0;                          ///< of the implicit steppers' matrix with a vector
    std::uint64_t rejected = 0;                          ///< steps taken back and retried at half the length
    std::array<std::uint64_t, kStepLimits> limitedBy{};  ///< steps by StepLimit
    std::array<std::uint64_t, kStepperKinds> takenBy{};  ///< steps by StepperKind
};

/// A step length that the audit has taught the run to keep to for a while.
struct StepRestriction {
    double seconds = std::numeric_limits<double>::infinity();
    StepLimit reason = StepLimit::audit;
    std::uint32_t passed = 0;  ///< good steps since it was set
};

/// Memory of the implicit steppers.
struct ImplicitScratch {
    PairMatrix matrix;
    SolverScratch solver;
    std::vector<Vec3> rightHandSide;  ///< N s, in the matrix's order
    std::vector<Vec3> change;         ///< half the change of velocity, m/s, in the matrix's order
};

/// What the automatic stepper knows of one candidate.
struct AutoChoice {
    double step = 0.0;  ///< that just meets the wanted error, s; 0 before the first look
    double cost =
        std::numeric_limits<double>::infinity();  ///< at that step, passes over all pairs for a second of motion
    StepLimit reason = StepLimit::error;          ///< what keeps the step from being longer
    double growth = 1.0;    ///< of errors beyond one interval: what the measured rate is multiplied by
    bool followed = false;  ///< whether that has been measured; otherwise it is lent
};

struct AutoState {
    std::array<AutoChoice, kStepperKinds> choices;  ///< by StepperKind
    std::uint64_t intervals = 0;                    ///< so far
    std::uint64_t nextLook = 0;                     ///< interval that is to be measured
    std::uint64_t looks = 0;
    double errorSum = 0.0;      ///< over the looks, radii per second
    double largestError = 0.0;  ///< radii per second
    double agitation = 0.0;     ///< at the last look: rms of the acceleration beside gravity, m/s^2
    double trials = 0.0;        ///< passes over all pairs that looks have cost
};

struct Simulation {
    Setup setup;
    ForceEvaluator evaluator;
    Particles particles;
    std::vector<EmitterState> emitters;
    std::uint64_t deaths = 0;                           ///< particles that have left a bounded world
    std::uint64_t mostBeforeDeaths = 0;                 ///< particles that there were at most when some left
    double time = 0.0;                                  ///< s
    StepperKind stepper = StepperKind::velocityVerlet;  ///< in use; the automatic one is never
    std::vector<Vec3> forces;  ///< N; while forcesCurrent those of pairs and gravity that the next step starts with
    std::vector<std::uint8_t> swept;  ///< whether obstacles meet a particle along its way in this step, 0 or 1
    /// Scratch of the drift: no obstacle's surface is nearer to a particle's than this, m, as long as steps alone move
    /// it; empty where nothing is known.
    std::vector<double> clearance;
    Scratch<std::vector<Vec3>> startPositions;  ///< of the drift: at the step's start, m, while some have moved already
    double startCutoff = 0.0;                   ///< likewise: no pair acts at or beyond it, m
    bool startIsListed = false;                 ///< likewise: who is within it of whom stands in the list
    /// Of each particle near obstacles, who was found beside it last: whom isAlone() looks at first.
    Scratch<std::vector<std::uint32_t>> companions;
    bool forcesCurrent = false;
    std::optional<double> energy;  ///< after the last step as the audit counts it, J; see step_audit.h
    double kinetic = 0.0;          ///< the kinetic share of it, J
    StepRestriction restriction;
    AutoState automatic;
    Scratch<std::vector<Vec3>> predictedVelocities;  ///< of velocity Verlet, m/s
    /// rms over the mass of the acceleration that the implicit steppers' solver may leave out, m/s^2; set by the
    /// automatic stepper, whenever it runs one of them.
    double toleratedAcceleration = 0.0;
    Scratch<ImplicitScratch> implicit;
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

/// Brings the simulation to the given time, which is hit exactly. The paper's stepper takes equal steps no longer than
/// the set-up's; the others also take back and retry what the audit does not let pass. What is beyond the bounds of the
/// world now has left it before the first step.
/// Throws InstabilityError when a particle is no longer finite or has left the world.
void advance(Simulation& simulation, double time);

/// Particles that there have been at most when an interval began or now.
std::uint64_t largestCount(const Simulation& simulation);

/// Births that have happened and births that had to wait, over all emitters.
std::uint64_t birthCount(const Simulation& simulation);
std::uint64_t refusalCount(const Simulation& simulation);

}  // namespace engine
