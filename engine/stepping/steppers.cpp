// The steppers by name and by order.
#include "engine/stepping/steppers.h"

#include <cmath>

#include "engine/stepping/implicit_step.h"
#include "engine/stepping/symplectic_euler.h"
#include "engine/stepping/velocity_verlet.h"

namespace engine {

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
        case StepLimit::fixed:
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

double errorRatio(StepperKind stepper, double stepRatio) {
    return orderOf(stepper) == 1 ? stepRatio : stepRatio * stepRatio;
}

double stepRatio(StepperKind stepper, double errorRatio) {
    return orderOf(stepper) == 1 ? errorRatio : std::sqrt(errorRatio);
}

}  // namespace engine
