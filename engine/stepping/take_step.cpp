// Calls the function of the stepper in use, and has the tables of names and orders.
#include "engine/stepping/take_step.h"

#include <cmath>

#include "engine/stepping/field_kicks.h"
#include "engine/stepping/implicit_step.h"
#include "engine/stepping/symplectic_euler.h"
#include "engine/stepping/velocity_verlet.h"

namespace engine {
namespace {

struct NameAndOrder {
    std::string_view name;
    int order;
};

/// Names and orders of convergence of the steppers, by StepperKind.
constexpr std::array<NameAndOrder, kSteppers.size()> kNamesAndOrders = {{
    {"symplectic-euler", 1},
    {"velocity-verlet", 2},
    {"leapfrog", 1},
    {"implicit-damping", 2},
    {"linearly-implicit", 2},
    {"auto", 2},
}};

/// Names of what limits a step, by StepLimit.
constexpr std::array<std::string_view, kStepLimits> kLimitNames = {"given step", "wanted error", "displacement limit",
                                                                   "energy audit", "frame"};

/// A step without the fields.
void takeInnerStep(Simulation& simulation, double h) {
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
            break;  // the automatic stepper chooses one of the others for each step
    }
}

}  // namespace

void takeStep(Simulation& simulation, double h) {
    kickBefore(simulation, h);
    takeInnerStep(simulation, h);
    kickAfter(simulation, h);
}

std::string_view nameOf(StepperKind stepper) {
    return kNamesAndOrders[static_cast<std::size_t>(stepper)].name;
}

std::string_view nameOf(StepLimit limit) {
    return kLimitNames[static_cast<std::size_t>(limit)];
}

int orderOf(StepperKind stepper) {
    return kNamesAndOrders[static_cast<std::size_t>(stepper)].order;
}

double errorRatio(StepperKind stepper, double stepRatio) {
    return orderOf(stepper) == 1 ? stepRatio : stepRatio * stepRatio;
}

double stepRatio(StepperKind stepper, double errorRatio) {
    return orderOf(stepper) == 1 ? errorRatio : std::sqrt(errorRatio);
}

}  // namespace engine
