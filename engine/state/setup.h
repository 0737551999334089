// What a scene says about a motion: everything that a run depends on but its state. Filled in by scenes/, read by all
// of the engine, changed by nothing once a run has started.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/law/material.h"
#include "engine/law/obstacles.h"
#include "engine/state/emitters.h"
#include "engine/state/particles.h"

namespace engine {

enum class StepperKind {
    symplecticEuler,   ///< equations 7 and 8 of the paper, as printed
    velocityVerlet,    ///< second order; damping from the predicted velocity
    leapfrog,          ///< Groot-Warren modified velocity Verlet with lambda = 1/2: first order, stable at longer steps
    implicitDamping,   ///< second order; damping by the implicit midpoint rule
    linearlyImplicit,  ///< second order; damping and stiffness by the linearized implicit midpoint rule
    automatic          ///< chooses the cheapest of the others, but for the paper's, at the wanted error
};

/// Number of steppers that can take a step: all but the automatic one, which is the last.
inline constexpr std::size_t kStepperKinds = static_cast<std::size_t>(StepperKind::automatic);

/// Whether the stepper is a form of velocity Verlet, which has no system to solve and knows the energy at a step's end.
constexpr bool isVerlet(StepperKind stepper) {
    return stepper == StepperKind::velocityVerlet || stepper == StepperKind::leapfrog;
}

enum class ForceMethod {
    reference,  ///< every pair, serial: the paper's way
    grid        ///< pairs of neighboring cells, threaded
};

/// Arithmetic of the pair forces; the state is always in double.
enum class Precision { doubles, singles };

/// Everything the scene says about the motion.
struct Setup {
    std::vector<Material> materials = {Material{}};
    Vec3 gravity = Vec3(0.0, -9.8, 0.0);  ///< m/s^2
    double drag = 0.0;                    ///< k, 1/s: free motion decays like exp(-k t)
    Obstacles obstacles;
    std::optional<BoundingBox> world;  ///< a particle outside is removed from the run
    std::vector<Emitter> emitters;
    Particles initial;  ///< at time zero
    StepperKind stepper = StepperKind::velocityVerlet;
    double step = 0.01;   ///< longest step, s; a frame is divided evenly; the automatic stepper does not use it
    double error = 1e-2;  ///< position error that the automatic stepper aims at, radii per second of motion
    double solverTolerance = 1e-4;  ///< the implicit steppers' solver stops at this residual over the right-hand side
    ForceMethod forces = ForceMethod::grid;
    Precision precision = Precision::doubles;  ///< of pair forces where all particles have one material and one radius
    std::uint64_t seed = 1;
};

}  // namespace engine
