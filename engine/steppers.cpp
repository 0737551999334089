// Symplectic Euler, as the paper prints it, and velocity Verlet.
#include "engine/steppers.h"

#include "engine/decay.h"
#include "engine/soundness.h"

namespace engine {
namespace {

/// The cells of the grid need positions that are numbers, hence the check.
void evaluateForces(Simulation& simulation, const std::vector<Vec3>& velocities, double h) {
    requireSound(simulation, h);
    simulation.evaluator.evaluate(simulation.particles, velocities, simulation.forces);
    ++simulation.steps.forceEvaluations;
}

/// Equations 7 and 8: v += F/M dt, then x += v dt with the new velocity. The drag multiplies v in between, as
/// published.
void symplecticEulerStep(Simulation& simulation, double h) {
    Particles& particles = simulation.particles;
    evaluateForces(simulation, particles.velocity, h);
    const double decay = decayFactor(simulation.setup.drag, h);
    for (std::size_t p = 0; p < particles.count(); ++p) {
        particles.velocity[p] = decay * (particles.velocity[p] + h / particles.mass[p] * simulation.forces[p]);
        particles.position[p] += h * particles.velocity[p];
    }
}

/// Half kick, half drift, drag, half drift, half kick. The damping in the second kick needs a velocity that is not
/// known yet: it is predicted by letting the old force act for the whole step (lambda = 1 of Groot and Warren 1997),
/// which keeps the order at 2 with one evaluation a step. The drag in the middle keeps the step symmetric.
void velocityVerletStep(Simulation& simulation, double h) {
    Particles& particles = simulation.particles;
    if (!simulation.forcesCurrent) evaluateForces(simulation, particles.velocity, h);
    const double decay = decayFactor(simulation.setup.drag, h);
    std::vector<Vec3>& predicted = simulation.predictedVelocities;
    predicted.resize(particles.count());
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const Vec3 halfKick = 0.5 * h / particles.mass[p] * simulation.forces[p];
        const Vec3 early = particles.velocity[p] + halfKick;
        const Vec3 late = decay * early;
        particles.position[p] += 0.5 * h * (early + late);
        particles.velocity[p] = late;
        predicted[p] = late + halfKick;
    }
    evaluateForces(simulation, predicted, h);
    for (std::size_t p = 0; p < particles.count(); ++p)
        particles.velocity[p] += 0.5 * h / particles.mass[p] * simulation.forces[p];
    simulation.forcesCurrent = true;
}

}  // namespace

void takeStep(Simulation& simulation, double h) {
    switch (simulation.setup.stepper) {
        case StepperKind::symplecticEuler:
            symplecticEulerStep(simulation, h);
            break;
        case StepperKind::velocityVerlet:
        case StepperKind::implicitDamping:
        case StepperKind::linearlyImplicit:
        case StepperKind::automatic:
            velocityVerletStep(simulation, h);
            break;
    }
}

std::string_view nameOf(StepperKind stepper) {
    switch (stepper) {
        case StepperKind::symplecticEuler:
            return "symplectic-euler";
        case StepperKind::velocityVerlet:
            return "velocity-verlet";
        case StepperKind::implicitDamping:
            return "implicit-damping";
        case StepperKind::linearlyImplicit:
            return "linearly-implicit";
        case StepperKind::automatic:
            return "auto";
    }
    return {};
}

int orderOf(StepperKind stepper) {
    return stepper == StepperKind::symplecticEuler ? 1 : 2;
}

}  // namespace engine
