// The steppers by name, and the paper's own.
#include "engine/stepping/steppers.h"

#include <cmath>
#include <mutex>

#include "engine/core/exp_negative.h"
#include "engine/core/parallel.h"
#include "engine/forces/external_forces.h"
#include "engine/stepping/implicit_step.h"
#include "engine/stepping/kick_drift.h"
#include "engine/stepping/velocity_verlet.h"

namespace engine {

bool symplecticEulerStep(Simulation& simulation, double h) {
    Particles& particles = simulation.particles;
    ForceEvaluator& evaluator = simulation.evaluator;
    evaluator.evaluatePairs(particles, particles.velocity, simulation.forces, h);
    ++simulation.steps.forceEvaluations;
    const double decay = expNegative(simulation.setup.drag * h);
    simulation.clearance.clear();
    const bool hasObstacles = !evaluator.law().scenery.colliders.empty();
    const KickDrift step{.h = h,
                         .decay = decay,
                         .gravity = evaluator.law().gravity,
                         .forces = simulation.forces,
                         .hasWeight = hasObstacles};
    Moved moved;
    std::mutex merging;
    inRanges(particles.count(), grainAmong(evaluator.law().scenery), [&](std::size_t begin, std::size_t end) {
        // Pairs, weight, obstacles: the order is part of the bits.
        if (hasObstacles) addOuterForces(evaluator.law(), particles, particles.velocity, begin, end, simulation.forces);
        const Moved range = kickAndDrift(step, begin, end, particles);
        const std::scoped_lock lock(merging);
        moved.include(range);
    });
    if (!moved.areSound) {
        evaluator.forgetMoves();
        return false;
    }
    const Vec3 margin = Vec3::Constant(kDisplacementMargin);
    evaluator.noteMoves({h * moved.velocities.low - margin, h * moved.velocities.high + margin});
    return true;
}

void takeStep(Simulation& simulation, double h) {
    switch (simulation.stepper) {
        case StepperKind::symplecticEuler:
            symplecticEulerStep(simulation, h);
            return;
        case StepperKind::velocityVerlet:
            return velocityVerletStep(simulation, h, kWholeStep);
        case StepperKind::leapfrog:
            return velocityVerletStep(simulation, h, kHalfStep);
        case StepperKind::implicitDamping:
            return implicitStep(simulation, h, {.damping = 0.5 * h, .stiffness = 0.0});
        case StepperKind::linearlyImplicit:
            return implicitStep(simulation, h, {.damping = 0.5 * h, .stiffness = 0.25 * h * h});
        case StepperKind::automatic:
            break;  // a simulation always has one of the others in use
    }
}

std::string_view nameOf(StepperKind stepper) {
    switch (stepper) {
        case StepperKind::symplecticEuler:
            return "symplectic-euler";
        case StepperKind::velocityVerlet:
            return "velocity-verlet";
        case StepperKind::leapfrog:
            return "leapfrog";
        case StepperKind::implicitDamping:
            return "implicit-damping";
        case StepperKind::linearlyImplicit:
            return "linearly-implicit";
        case StepperKind::automatic:
            return "auto";
    }
    return {};
}

std::string_view nameOf(StepLimit limit) {
    switch (limit) {
        case StepLimit::given:
            return "given step";
        case StepLimit::error:
            return "wanted error";
        case StepLimit::displacement:
            return "displacement limit";
        case StepLimit::audit:
            return "energy audit";
        case StepLimit::frame:
            return "frame";
    }
    return {};
}

int orderOf(StepperKind stepper) {
    return stepper == StepperKind::symplecticEuler || stepper == StepperKind::leapfrog ? 1 : 2;
}

double errorShare(StepperKind stepper, double ofLength) {
    return orderOf(stepper) == 1 ? ofLength : ofLength * ofLength;
}

double stepShare(StepperKind stepper, double ofError) {
    return orderOf(stepper) == 1 ? ofError : std::sqrt(ofError);
}

}  // namespace engine
